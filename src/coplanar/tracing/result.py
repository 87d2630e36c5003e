"""What a trace answers: joints, the certificate of the branch, or where it fails and why."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms import Arm
from coplanar.curves import Curve
from coplanar.errors import NoSolution
from coplanar.run import Run


class Reason(Enum):
    """Why an arm cannot follow; the value is the sentence."""

    TOO_FAR = "the curve is beyond the outer ring"
    TOO_CLOSE = "the curve is inside the inner ring"
    JOINT_LIMIT = "a joint is beyond its limit"
    SINGULAR = "the branches meet at a singular point, and passing it was not asked for"
    NOT_FOUND = "the inverse found no joints near the last ones"


class TraceStatus(Enum):
    """How a trace went; the value is the sentence."""

    FOLLOWED = "the arm follows the whole curve on one branch"
    PASSED = "the arm follows the whole curve, through singular points"
    FAILED = "the arm cannot follow the whole curve"


@dataclass(frozen=True, slots=True)
class Failure:
    """An interval of the parameter in which the arm does not follow.

    Attributes:
        first: Where it begins, refined on the curve.
        last: Where it ends.
        reason: Why.
        amount: The largest gap in it [m], for a limit how far the joint is beyond it [rad or m].
        joint: Which joint is beyond its limit, counted from 0.
    """

    first: float
    last: float
    reason: Reason
    amount: float = 0.0
    joint: int | None = None

    def __str__(self) -> str:
        """The interval and the reason in one line."""
        which = "" if self.joint is None else f" (joint {self.joint})"
        return f"{self.first:.12g} to {self.last:.12g}: {self.reason.value}{which}, by {self.amount:.3g} at most"


@dataclass(frozen=True, slots=True)
class SingularPoint:
    """A place where the two branches of an arm meet.

    Attributes:
        parameter: Where on the curve.
        kind: "stretched", "folded", or "base" (folded onto its own base, the first joint free).
        turn: How far the first joint has to turn there while the tip rests on the base [rad]; 0 if it need not.
    """

    parameter: float
    kind: str
    turn: float = 0.0


@dataclass(frozen=True, slots=True)
class Certificate:
    """What a trace has shown of the part that it followed; between the parameters too, at the knots.

    Attributes:
        smallest_sine: Smallest |sin| at the elbow, 0 where branches meet; None for other than two revolute joints.
        smallest_sine_at: Parameter of it.
        smallest_conditioning: Smallest over largest singular value of the position Jacobian, at its smallest.
        largest_step: Largest change of a joint from one parameter to the next [rad or m].
        largest_step_at: Parameter before it.
        limits_kept: Whether every joint is within its limits.
        limit_margin: Smallest distance of a joint to a limit [rad or m]; infinite without limits.
        elbows: The signs of the sine at the elbow, one after the other; empty where there are no two branches.
        position_error: Largest distance of the tool from the curve [m].
    """

    smallest_sine: float | None
    smallest_sine_at: float | None
    smallest_conditioning: float
    largest_step: float
    largest_step_at: float
    limits_kept: bool
    limit_margin: float
    elbows: tuple[int, ...]
    position_error: float


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """An arm along a curve.

    Attributes:
        arm: The arm.
        curve: The curve.
        parameters: Where on the curve, shape (rows,).
        q: Joints, unwrapped, shape (rows, n). Where the curve is out of reach the arm points at it; after it
            stopped it rests.
        followed: In which rows the tool is on the curve with the joints within their limits, shape (rows,).
        elbow: Sign of the sine at the elbow, shape (rows,); 0 where there are no two branches.
        failures: The intervals in which it does not follow, in the order in which they are met.
        singular_points: Where the branches meet on the way.
        certificate: What has been shown.
    """

    arm: Arm
    curve: Curve
    parameters: np.ndarray
    q: np.ndarray
    followed: np.ndarray
    elbow: np.ndarray
    failures: tuple[Failure, ...]
    singular_points: tuple[SingularPoint, ...]
    certificate: Certificate

    @property
    def status(self) -> TraceStatus:
        """How it went."""
        if self.failures:
            return TraceStatus.FAILED
        return TraceStatus.PASSED if self.singular_points else TraceStatus.FOLLOWED

    @property
    def targets(self) -> np.ndarray:
        """The points of the curve, shape (rows, 2) [m]."""
        return self.curve.position(self.parameters)

    def position_error(self) -> np.ndarray:
        """Distance of the tool from the curve, computed anew, shape (rows,) [m]."""
        off = self.arm.forward(self.q).position - self.targets
        error: np.ndarray = np.hypot(off[:, 0], off[:, 1])
        return error

    def or_raise(self) -> Trace:
        """This trace if the arm follows the whole curve.

        Raises:
            NoSolution: With the sentences, if it does not.
        """
        if self.failures:
            raise NoSolution(str(self), self)
        return self

    def __str__(self) -> str:
        """The status, then every failure, one a line."""
        return "\n".join((self.status.value, *map(str, self.failures)))

    def as_run(self, duration: float) -> Run:
        """The trace as a run of ``duration`` [s], evenly in the parameter: t, phi, q1 ... qn, x, y, ex, ey.

        Raises:
            InvalidValue: If the duration is not positive.
        """
        phi = self.parameters
        t = checks.positive("duration", duration) * (phi - phi[0]) / (phi[-1] - phi[0])
        tool, targets = self.arm.forward(self.q).position, self.targets
        columns: dict[str, Any] = {"t": t, "phi": phi}
        columns |= {f"q{i}": self.q[:, i - 1] for i in range(1, self.q.shape[1] + 1)}
        columns |= {"x": tool[:, 0], "y": tool[:, 1]}
        columns |= {"ex": targets[:, 0] - tool[:, 0], "ey": targets[:, 1] - tool[:, 1]}
        warnings = (self.status.value, *map(str, self.failures)) if self.failures else ()
        return Run(columns, "arm", warnings=warnings)
