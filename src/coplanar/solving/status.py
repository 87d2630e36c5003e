"""How a search ended, in a sentence; one code a row where there are many."""

from __future__ import annotations

import functools
from enum import Enum
from typing import Any

import numpy as np


class Status(Enum):
    """How a root finder or a least-squares search ended."""

    CONVERGED = "the residual is within its tolerance"
    BRACKETED = "a sign change is bracketed to within the tolerance"
    NO_SIGN_CHANGE = "the function has one sign at both ends: no root is bracketed"
    STALLED = "no small step lowers the residual: a least-squares answer or a stationary point, not a root"
    SINGULAR = "the Jacobian is singular and an undamped step does not exist"
    BUDGET_SPENT = "the iterations are spent before the tolerance is met"
    NOT_FINITE = "the function is not a finite number where it was asked"


def code_of(member: Enum) -> int:
    """The number of a status: its place in the order of definition.

    Example:
        >>> code_of(Status.CONVERGED), code_of(Status.BRACKETED)
        (0, 1)
    """
    return _members(type(member)).index(member)


def status_of(kind: type[Enum], codes: Any) -> Any:
    """The statuses behind their numbers.

    Args:
        kind: The enum.
        codes: One code, or an array of them.

    Returns:
        One member for shape (), otherwise an object array of members.

    Example:
        >>> status_of(Status, 0).value
        'the residual is within its tolerance'
        >>> status_of(Status, np.array([0, 3]))[1].name
        'STALLED'
    """
    members = _members(kind)
    return members[codes] if type(codes) is int else np.array(members, dtype=object)[codes]


@functools.cache
def _members(kind: type[Enum]) -> tuple[Enum, ...]:
    return tuple(kind)


def count_by_status(kind: type[Enum], codes: Any) -> str:
    """How many rows ended how, as one line; for one row its sentence alone.

    Example:
        >>> count_by_status(Status, np.array([0, 0, 3]))
        '2 CONVERGED, 1 STALLED'
    """
    if np.ndim(codes) == 0:
        return str(status_of(kind, codes).value)
    numbers, counts = np.unique(codes, return_counts=True)
    return ", ".join(f"{c} {status_of(kind, n).name}" for n, c in zip(numbers, counts, strict=True))
