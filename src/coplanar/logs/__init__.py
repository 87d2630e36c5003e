"""Logs: what robots write, read back."""
