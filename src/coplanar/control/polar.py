"""Driving to a pose: position and heading, by the polar coordinates of the goal."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.control.controller import Timed, as_column
from coplanar.control.stability import StabilityReport, first_exit, judge, quadratic_roots
from coplanar.control.unicycle import ROWS, Command, State, lead_of
from coplanar.engine import Scan, evaluator
from coplanar.errors import InvalidValue
from coplanar.laws import polar as laws
from coplanar.se2 import Pose

_coordinates = evaluator(laws.polar_coordinates)


class _Form(NamedTuple):
    """The command, how it pulls near the goal, its usual gains, and the whole loop by steps or by arcs."""

    command: Callable[..., Any]
    pull: Callable[..., Any]
    usual: tuple[float, float, float]
    by_steps: Scan
    by_arcs: Scan


_FORMS = {
    "linear": _Form(
        evaluator(laws.drive_linear), evaluator(laws.polar_linear_pull), (3.0, 8.0, -1.5),
        Scan(laws.linear_step), Scan(laws.linear_arc),
    ),
    "smooth": _Form(
        evaluator(laws.drive_smooth), evaluator(laws.polar_smooth_pull), (3.0, 6.0, 1.0),
        Scan(laws.smooth_step), Scan(laws.smooth_arc),
    ),
}  # fmt: skip
_loop = evaluator(laws.polar_loop)
_margin = evaluator(laws.polar_margin)
_rates = evaluator(laws.polar_rates)
_strong = evaluator(laws.polar_strong)


@dataclass(frozen=True, slots=True, eq=False)
class PolarController:
    """Drive to a pose by rho, alpha, beta: distance, bearing of the goal, and goal heading less direction to it.

    A unicycle cannot be brought to a pose by a smooth law of (x, y, theta); in these coordinates, which are not
    smooth at the goal, it can. Within ``arrive_within`` only the heading is left to turn.

    Attributes:
        goal: The pose to reach.
        k_rho: [1/s].
        k_alpha: [1/s].
        k_beta: [1/s] in "linear" (negative), [1] in "smooth" (positive).
        form: "linear": v = k_rho rho, omega = k_alpha alpha + k_beta beta (Siegwart 2011), stable near the goal for
            k_rho > 0, k_beta < 0, k_alpha > k_rho. "smooth" (Aicardi 1995): v = k_rho rho cos alpha, from everywhere.
        direction: "forward", "backward", or "nearest": backward if the goal is behind at the start.
        arrive_within: [m].

    Example:
        >>> PolarController(Pose(1.0, 0.0, 0.0)).stability(0.01).status.name
        'STABLE'
    """

    goal: Pose
    k_rho: Real = None
    k_alpha: Real = None
    k_beta: Real = None
    form: str = "linear"
    direction: str = "forward"
    arrive_within: float = 1e-6
    error_names: ClassVar[tuple[str, ...]] = ("rho", "alpha", "beta")

    def __post_init__(self) -> None:
        checks.choice("form", self.form, _FORMS)
        checks.choice("direction", self.direction, ("forward", "backward", "nearest"))
        if not isinstance(self.goal, Pose):
            raise InvalidValue("goal", self.goal, "a Pose")
        for name, usual in zip(("k_rho", "k_alpha", "k_beta"), _FORMS[self.form].usual, strict=True):
            given = getattr(self, name)
            object.__setattr__(self, name, usual if given is None else checks.frozen(checks.real(name, given)))
        object.__setattr__(self, "arrive_within", checks.positive("arrive_within", self.arrive_within))
        checks.broadcast(goal=np.zeros(self.goal.shape), k_rho=self.k_rho, k_alpha=self.k_alpha, k_beta=self.k_beta)

    @property
    def _gains(self) -> tuple[Real, Real, Real]:
        return self.k_rho, self.k_alpha, self.k_beta

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of goal and gains, () for one robot."""
        return np.broadcast_shapes(self.goal.shape, *(np.shape(k) for k in self._gains))

    def stability(
        self, step: ArrayLike, *, method: str = "euler", speed: ArrayLike = 0.0, tolerance: float = 1e-9
    ) -> StabilityReport:
        """What the loop will do near the goal, for the sampled loop as it is; it needs h k_rho < 1.

        Args:
            step: h [s].
            method: How the plant is stepped.
            speed: Has no part in it.
            tolerance: How near 1 the largest pole counts as on the boundary [1].
        """
        lead = lead_of(method)
        h = checks.positive("step", step)
        pull = _FORMS[self.form].pull(*self._gains)
        damping, stiffness = _rates(self.k_rho, *pull)
        trace, det = _loop(h, self.k_rho, *pull, lead)
        along = np.broadcast_to(np.expand_dims(1.0 - h * self.k_rho, -1), (*np.shape(trace), 1))
        poles = np.concatenate([along, quadratic_roots(trace, det)], axis=-1)
        largest = np.where(np.less(h * self.k_rho, 1.0), np.abs(poles).max(-1), np.maximum(np.abs(along[..., 0]), 1.0))
        margin = 1.0 - largest if largest.ndim else float(1.0 - largest)
        conditions, warnings = self._conditions(damping, stiffness)
        highest = 1.0 / np.maximum(self.k_rho, np.finfo(np.float64).tiny)
        edge = first_exit(lambda h: _margin(h, self.k_rho, *pull, lead), highest)
        held = np.greater(self.k_rho, 0.0) & np.greater(damping, 0.0) & np.greater(stiffness, 0.0)
        edge = np.where(held, edge, 0.0) if np.ndim(held) else edge * bool(held)
        return StabilityReport(
            step=h, method=method, poles=poles, lateral_poles=None, speed=speed, margin=margin, largest_step=edge,
            status=judge(margin, tolerance), conditions=conditions | {"h k_rho < 1": np.less(h * self.k_rho, 1.0)},
            numbers={"damping": damping, "stiffness": stiffness}, warnings=warnings,
        )  # fmt: skip

    def _conditions(self, damping: Real, stiffness: Real) -> tuple[dict[str, Any], tuple[str, ...]]:
        named = ("k_alpha > k_rho", "k_rho k_beta < 0") if self.form == "linear" else ("k_alpha > 0", "k_beta > 0")
        held = {"k_rho > 0": np.greater(self.k_rho, 0.0)}
        held |= {named[0]: np.greater(damping, 0.0), named[1]: np.greater(stiffness, 0.0)}
        failed = [f"unstable near the goal: needs {name}" for name, holds in held.items() if not np.all(holds)]
        if self.form == "linear":
            strong = "k_alpha + 5/3 k_beta - 2/pi k_rho > 0"
            held[strong] = np.greater(_strong(*self._gains), 0.0)
            if not np.all(held[strong]):
                failed.append(f"the robot may turn away from the goal on its way: {strong} keeps it facing it")
        return held, tuple(failed)

    def start(self, reference: Timed | None, time: float) -> Pose:  # noqa: ARG002
        """There is no place to start from that follows from a goal.

        Raises:
            InvalidValue: Always.
        """
        raise InvalidValue("start", None, "the pose to start from")

    def targets(self, reference: Timed | None, times: np.ndarray, dimensions: int) -> tuple[np.ndarray, ...]:  # noqa: ARG002
        """The goal at every step: three arrays (steps, ...)."""
        column = np.zeros_like(as_column(times[:-1], dimensions))
        return tuple(np.add(part, column) for part in self.goal.parts)

    def memory(self, state: State) -> tuple[Any, ...]:
        """1 for driving forward, -1 for backward."""
        sign = {"forward": 1.0, "backward": -1.0}.get(self.direction)
        if sign is None:
            _, alpha, _ = _coordinates(*state, *self.goal.parts)
            behind = np.abs(alpha) > 0.5 * math.pi
            return (np.where(behind, -1.0, 1.0) if np.ndim(behind) else -1.0 if behind else 1.0,)
        return (sign,)

    def respond(self, state: State, target: Any, memory: Any, step: Real) -> tuple[Command, tuple[Real, ...], Any]:  # noqa: ARG002
        """The command for a measured state: (v, omega), the error (rho, alpha, beta), the direction."""
        v, omega, *error = _FORMS[self.form].command(*state, *target, *memory, *self._gains, self.arrive_within)
        return (v, omega), tuple(error), memory

    def roll(
        self, state: State, targets: Any, steps: np.ndarray, method: str, kept: Collection[int]  # noqa: ARG002
    ) -> tuple[np.ndarray, ...]:  # fmt: skip
        """The whole closed loop of a unicycle in one go: x, y, theta, v, omega, rho, alpha, beta.

        Each has shape (steps + 1, ...) where its place is among those kept, else that of the last row.
        """
        form, row = _FORMS[self.form], () if method == "exact" else ROWS[method]
        parameters = (*self.goal.parts, *self.memory(state), *self._gains, self.arrive_within, *row)
        scan = form.by_arcs if method == "exact" else form.by_steps
        columns: tuple[np.ndarray, ...] = scan((*state, *(0.0,) * 5), (steps,), parameters, keep=kept)
        return columns
