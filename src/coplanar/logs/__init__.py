"""Logs and files of other programs."""

from coplanar.logs.formats import FORMATS, read_log, write_log

__all__ = ["FORMATS", "read_log", "write_log"]
