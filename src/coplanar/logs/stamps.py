"""Times as the whole numbers that logs are stamped with."""

from __future__ import annotations

import numpy as np

from coplanar.errors import InvalidValue
from coplanar.run import Run


def stamps_of(run: Run, ticks: int, *, bits: int) -> np.ndarray:
    """The index of every row in whole ticks, not negative: a run that begins before 0 is shifted to begin at 0.

    Args:
        run: The run; its index is a time [s].
        ticks: How many make a second.
        bits: How many bits a stamp has.

    Returns:
        Shape (rows,), of 64-bit integers.

    Raises:
        InvalidValue: If a time is not finite, or beyond these bits.

    Example:
        >>> stamps_of(Run({"t": [-0.5, 0.0, 0.25]}), 1000, bits=63).tolist()
        [0, 500, 750]
    """
    times = run.t - min(0.0, float(run.t.min()))
    stamps = np.rint(times * ticks)
    if not np.isfinite(stamps).all() or stamps.max() >= 2.0**bits:
        needed = f"finite times over less than {2**bits / ticks:.3g} s"
        raise InvalidValue(run.index, run.t, needed, "CSV, JSON and Parquet have no stamps")
    whole: np.ndarray = stamps.astype(np.int64)
    return whole
