"""Where the laws of polar control are compared: steps and gains for which the way left does not vanish."""

from __future__ import annotations

from coplanar.laws import polar as laws


def _small(columns):
    return [0.3 * c for c in columns]


DOMAIN = {laws.polar_loop: _small, laws.polar_margin: _small}
