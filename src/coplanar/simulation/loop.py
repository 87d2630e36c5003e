"""Plant, controller and reference, step by step."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import Any, NamedTuple, Protocol

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.control import METHODS, Controller, Limits, Unicycle
from coplanar.control.controller import Timed
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.run import Run, RunStatus
from coplanar.se2 import Pose
from coplanar.simulation.noise import Noise

WHOLE_STEPS = 1e-9  # of a step: a duration this near a whole number of steps is that number


class Plant(Protocol):
    """What is driven: the state after a command held over a step."""

    def advance(self, state: Any, command: Any, step: Real, *, method: str) -> Any:
        """The state after the step."""
        ...


def simulate(
    plant: Plant, controller: Controller, reference: Timed | None = None, *, t: ArrayLike | None = None,
    duration: float | None = None, step: float | None = None, method: str = "euler", limits: Limits | None = None,
    start: Pose | None = None, noise: Noise | None = None, keep: str | Collection[str] = "all",
) -> Run:  # fmt: skip
    """Run a closed loop: measure, compare, command, hold the command over a step.

    Poses, gains, points and goals of any leading shape run as a batch of robots, in one loop over time.

    Args:
        plant: What is driven, a ``Unicycle``.
        controller: ``PointTracker`` or ``PolarController``.
        reference: What it follows in time.
        t: Increasing times [s]; or give ``duration`` and ``step``.
        duration: From 0 [s]; the reference's own unless given.
        step: h [s]; the last step is shorter where the duration is no whole number of steps.
        method: How the plant is stepped: "euler", "midpoint", "heun", "rk4" or "exact".
        limits: What the motors allow; the command recorded is the one after them.
        start: First pose, of any leading shape; the controller's own starting pose unless given.
        noise: Added to the measured pose and to the driven command.
        keep: "all" for every column at every time, "end" for the last row alone, or the names of the columns that are
            wanted at every time. What is kept is the same whatever else is; what is not takes neither memory nor time.

    Returns:
        A run with the columns t, x, y, theta, v, omega and the controller's errors, or those of them that are kept.
        Row 0 is the start with command and error 0; row i + 1 holds the command and the error that led to it. If a
        state stops being finite the run says DIVERGED; where that of every robot has, it ends.

    Raises:
        InvalidValue: If the times do not increase, or something that is needed is missing.
        UnknownName: If the method or a column to keep is not known.
        InvalidShape: If shapes do not broadcast.

    Example:
        >>> from coplanar.control import PointTracker, Unicycle
        >>> from coplanar.curves import Astroid
        >>> tracker = PointTracker((0.05, 0.0), kp=100.0, kd=0.5, error_against="next")
        >>> run = simulate(Unicycle(), tracker, Astroid(1.0).over(10.0), step=0.01)
        >>> len(run), float(run["ex"][1:].max()) < 0.01
        (1001, True)
        >>> end = simulate(Unicycle(), tracker, Astroid(1.0).over(10.0), step=0.01, keep="end")
        >>> len(end), float(end["x"][-1]) == float(run["x"][-1])
        (1, True)
    """
    checks.choice("method", method, METHODS)
    names = ("x", "y", "theta", "v", "omega", *controller.error_names)
    kept = _places(keep, names)
    times, steps = _times(reference, t, duration, step)
    first = controller.start(reference, float(times[0])) if start is None else start
    shape = _shape(start=first, controller=controller, noise=noise, limits=limits, reference=reference)
    targets = controller.targets(reference, times, len(shape))
    state = tuple(_over(shape, part) if shape else float(part) for part in first.parts)
    bare = limits is None and noise is None and type(plant) is Unicycle
    roll = getattr(controller, "roll", None) if shape and bare else None
    if roll:
        course = _rolled(partial(roll, state, targets, steps, method), kept)
    else:
        shaken = noise.draw(len(steps), shape) if noise else np.zeros((len(steps), 5) + (1,) * len(shape))
        each_step = zip(_rows(targets, shape), _rows(shaken.swapaxes(0, 1), shape), steps.tolist(), strict=True)
        rows = _loop((plant, controller, limits, method), state, each_step)
        course = _stepped(kept, (len(times), *shape), (*state, *(0.0,) * (len(names) - 3)), rows)
    return Run._of(
        _columns(course, kept, names, times) if keep != "end" else _last_row(course, names, times, shape),
        "unicycle",
        status=RunStatus.COMPLETE if np.all(np.isfinite(course.survival)) else RunStatus.DIVERGED,
        warnings=partial(_warnings, controller, reference, times, steps, method),
        info={"method": method, "step": float(steps[0]), "seed": noise.seed if noise else None},
    )


class _Course(NamedTuple):
    """What a run went through.

    Attributes:
        histories: For every place of a column that is kept its rows, as far as they go.
        end: The last row.
        last: Its number.
        survival: Finite for the robots whose pose was so all the way.
    """

    histories: dict[int, np.ndarray]
    end: tuple[Real, ...]
    last: int
    survival: Real


def _places(keep: str | Collection[str], names: tuple[str, ...]) -> tuple[int, ...]:
    """The places of the columns that are kept at every time."""
    if isinstance(keep, str):
        return tuple(range(len(names))) if checks.choice("keep", keep, ("all", "end")) == "all" else ()
    return tuple(sorted({names.index(checks.choice("keep", name, names)) for name in keep}))


def _rolled(roll: Callable[[Collection[int]], tuple[np.ndarray, ...]], kept: tuple[int, ...]) -> _Course:
    """All steps at once; a run that no robot survives ends at the first row where none does."""
    columns = roll(kept)
    end = tuple(column[-1] if place in kept else column for place, column in enumerate(columns))
    survival = end[0] + end[1] + end[2]  # what is no longer finite never is again
    histories = {place: columns[place] for place in kept}
    if _any_finite(survival):
        return _Course(histories, end, -1, survival)
    whole = roll(range(len(columns)))
    dead = ~np.isfinite(whole[0] + whole[1] + whole[2])
    last = int(dead.reshape(len(dead), -1).all(1).argmax())
    return _Course({k: whole[k][: last + 1] for k in kept}, tuple(c[last] for c in whole), last, survival)


def _stepped(kept: tuple[int, ...], size: tuple[int, ...], row: tuple[Real, ...], rows: Any) -> _Course:
    """Row after row, from the first one on."""
    table = {place: np.zeros(size) for place in kept}
    last, survival = 0, 0.0 * row[0]
    for place, column in table.items():
        column[0] = row[place]
    for last, row in enumerate(rows, 1):
        survival = survival + 0.0 * (row[0] + row[1] + row[2])
        for place, column in table.items():
            column[last] = row[place]
    return _Course({place: column[: last + 1] for place, column in table.items()}, row, last, survival)


def _columns(course: _Course, kept: tuple[int, ...], names: tuple[str, ...], times: np.ndarray) -> dict[str, Any]:
    """The time and what is kept of it all."""
    rows = len(times) if course.last < 0 else course.last + 1
    return {"t": times[:rows]} | {names[place]: course.histories[place] for place in kept}


def _last_row(course: _Course, names: tuple[str, ...], times: np.ndarray, shape: tuple[int, ...]) -> dict[str, Any]:
    """A table of one row."""
    ends = {name: _over(shape, value)[None].copy() for name, value in zip(names, course.end, strict=True)}
    return {"t": times[course.last :][:1]} | ends


def _loop(parts: tuple[Any, ...], state: Any, each_step: Any) -> Iterator[tuple[Real, ...]]:
    """Rows (x, y, theta, v, omega, errors ...) after each step, up to the first that no robot survives."""
    plant, controller, limits, method = parts
    memory, command = controller.memory(state), (0.0, 0.0)
    for target, (nx, ny, ntheta, nv, nomega), h in each_step:
        x, y, theta = state
        wanted, error, memory = controller.respond((x + nx, y + ny, theta + ntheta), target, memory, h)
        command = limits.apply(wanted, command, h) if limits else wanted
        v, omega = command
        state = plant.advance(state, (v + nv, omega + nomega), h, method=method)
        yield (*state, v, omega, *error)
        if not _any_finite(state[0] + state[1] + state[2]):
            return


def _any_finite(total: Real) -> bool:
    return math.isfinite(total) if type(total) is float else bool(np.isfinite(total).any())


def _times(
    reference: Any, t: ArrayLike | None, duration: float | None, step: float | None
) -> tuple[np.ndarray, np.ndarray]:
    """Times (rows,) and steps (rows - 1,)."""
    if t is not None:
        if duration is not None or step is not None:
            raise InvalidValue("t", "given with duration or step", "either t, or duration and step")
        times: np.ndarray = checks.frozen(checks.monotone("t", t))
        if times[0] > times[-1]:
            raise InvalidValue("t", t, "increasing times")
        return times, np.diff(times)
    duration = getattr(reference, "duration", None) if duration is None else duration
    if duration is None or step is None:
        raise InvalidValue("duration, step", (duration, step), "both, or t")
    length, h = checks.positive("duration", duration), checks.positive("step", step)
    if np.ndim(length) or np.ndim(h):
        raise InvalidShape("duration, step", f"shapes {np.shape(length)}, {np.shape(h)}", "one number each")
    return _even(float(getattr(reference, "start_time", 0.0)), length, h)


def _even(first: float, length: float, h: float) -> tuple[np.ndarray, np.ndarray]:
    """Times h apart; the last step is what is left."""
    count = max(1, math.ceil(length / h - WHOLE_STEPS))
    last = length - (count - 1) * h
    steps = np.full(count, h)
    steps[-1] = h if abs(last - h) <= WHOLE_STEPS * h else last
    times = first + h * np.arange(count + 1)
    times[-1] = first + length
    return times, steps


def _shape(*, reference: Any, **parts: Any) -> tuple[int, ...]:
    """The leading shape of everything that takes part: that of the batch of robots."""
    shapes = {name: part.shape for name, part in parts.items() if part is not None}
    shapes["reference"] = () if reference is None else reference.position(0.0).shape[:-1]
    if len({*shapes.values()} - {()}) <= 1:
        return max(shapes.values(), key=len)
    return checks.broadcast(**{name: np.broadcast_to(0.0, shape) for name, shape in shapes.items()})


def _over(shape: tuple[int, ...], value: Real) -> np.ndarray:
    """The value as an array of this shape."""
    fits = np.shape(value) == shape
    return np.asarray(value) if fits else np.broadcast_to(value, shape)


def _rows(columns: Any, shape: tuple[int, ...]) -> Iterator[tuple[Any, ...]]:
    """Step after step of columns (steps, ...), as floats for one robot."""
    return zip(*(c if shape else np.asarray(c).tolist() for c in columns), strict=True)


def _warnings(
    controller: Controller, reference: Any, times: np.ndarray, steps: np.ndarray, method: str
) -> tuple[str, ...]:
    """What the controller says of its largest step at the reference's highest speed."""
    speed = 0.0
    if reference is not None:
        velocity = reference.velocity(times.reshape(-1, *(1,) * (np.ndim(reference.position(times[0])) - 1)))
        speed = float(np.hypot(velocity[..., 0], velocity[..., 1]).max())
    report = controller.stability(float(steps.max()), method=method, speed=speed)
    return report.warnings if np.all(report.stable) else report.sentences
