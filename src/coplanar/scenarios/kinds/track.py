"""Closed loops: a robot follows a reference, or drives to a pose."""

from __future__ import annotations

from dataclasses import replace
from math import ceil
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.control import Limits, PointTracker, Stability, StabilityReport, Unicycle
from coplanar.errors import InvalidValue
from coplanar.run import Run, RunStatus
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.common import MOST_STEPS
from coplanar.scenarios.parts.control import AnyController, IntegratorPart, LimitsPart, NoisePart, RobotPart
from coplanar.scenarios.parts.curves import ReferencePart
from coplanar.scenarios.quantities import Duration
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose
from coplanar.simulation import Noise, simulate

ONE_STEP = 1e-9  # [m] that a step taken anew may be apart
REFUSED = "refused before it ran: {}"
_RUN_NUMBERS = (
    "distance",
    "largest_error",
    "rms_error",
    "largest_v",
    "largest_omega",
    "final_x",
    "final_y",
    "final_theta",
)


class Loop(NamedTuple):
    """What the library makes of it."""

    controller: Any
    reference: Any
    start: Pose | None
    limits: Limits | None
    noise: Noise | None
    report: StabilityReport


class Track(Scenario):
    """A robot, a reference, a controller, an integrator, a duration; noise and limits where wanted."""

    vectorised_keys: ClassVar[tuple[str, ...]] = (
        "controller.point.*", "controller.k*", "controller.goal.*", "robot.start.*", "noise.*", "limits.*",
        "reference.curve.radius", "reference.curve.a", "reference.curve.b", "reference.curve.center.*",
        "reference.curve.tilt", "reference.curve.point.*",
    )  # fmt: skip
    example: ClassVar[dict[str, Any]] = {
        "reference": {"curve": {"type": "lemniscate", "a": 1.0}},
        "controller": {"type": "point-tracker", "point": [0.1, 0.0], "kp": 3.0, "feedforward": True},
        "robot": {"start": {"x": 0.9, "y": -0.2, "theta": "90 deg"}},
    }

    type: Literal["track"] = Field(default="track", description="A robot follows a reference")
    robot: RobotPart = Field(default=RobotPart(), description="What is driven, and where it sets off")
    reference: ReferencePart | None = Field(
        default=None, description="What is followed in time; none to drive to a pose"
    )
    controller: AnyController = Field(description="From the error to the command")
    integrator: IntegratorPart = Field(default=IntegratorPart(), description="How time is stepped")
    duration: Duration = Field(default=10.0, description="How long it runs")
    limits: LimitsPart | None = Field(default=None, description="What the motors allow; everything unless given")
    noise: NoisePart | None = Field(default=None, description="What sensors and motors add; nothing unless given")
    unstable: Literal["refuse", "run"] = Field(default="refuse", description="What to do with gains whose errors grow")

    def build(self) -> Loop:
        """The parts of the loop, and what its poles say."""
        if ceil(self.duration / self.integrator.step) > MOST_STEPS:
            raise InvalidValue("duration", self.duration, f"at most {MOST_STEPS} steps of {self.integrator.step:g} s")
        controller = self.controller.build()
        reference = None if self.reference is None else self.reference.over(self.duration)
        if reference is None and isinstance(controller, PointTracker):
            raise InvalidValue("reference", None, "a curve to follow", "or a controller of type polar, with a goal")
        start = self._start(controller, reference)
        limits = None if self.limits is None else self.limits.build()
        noise = None if self.noise is None else self.noise.build()
        return Loop(controller, reference, start, limits, noise, self._report(controller, reference))

    @property
    def rows_at_once(self) -> int:
        """So many robots that their table holds about two million rows."""
        return max(1, int(2_000_000 * self.integrator.step / self.duration))

    def _start(self, controller: Any, reference: Any) -> Pose | None:
        start = self.robot.start
        if (start.x is None) != (start.y is None):
            raise InvalidValue("robot", (start.x, start.y), "x and y together, or neither", "set start.x and start.y")
        pose = start.pose(controller, reference)
        if pose is None and not isinstance(controller, PointTracker):
            raise InvalidValue("robot", None, "where it sets off", "give start.x and start.y")
        return pose

    def _report(self, controller: Any, reference: Any) -> StabilityReport:
        """The poles of the loop, at the reference's highest speed."""
        speed: Any = 0.0
        if reference is not None:
            t = np.linspace(0.0, self.duration, 2001)
            velocity = reference.velocity(t.reshape(-1, *(1,) * (np.ndim(reference.position(0.0)) - 1)))
            speed = np.hypot(velocity[..., 0], velocity[..., 1]).max(axis=0)
            speed = speed if np.ndim(speed) else float(speed)
        report: StabilityReport = controller.stability(self.integrator.step, method=self.integrator.method, speed=speed)
        return report

    def _simulated(self, loop: Loop) -> Run:
        noise = loop.noise
        if noise is not None:  # the robots of a batch draw from the seed as each of them would alone
            shapes = [part.shape for part in (loop.controller, loop.start, loop.limits, noise) if part is not None]
            shapes += [] if loop.reference is None else [loop.reference.position(0.0).shape[:-1]]
            shape = np.broadcast_shapes(*shapes)
            noise = replace(noise, seed=np.broadcast_to(noise.seed, shape)) if shape else noise
        return simulate(
            Unicycle(), loop.controller, loop.reference, duration=self.duration, step=self.integrator.step,
            method=self.integrator.method, start=loop.start, limits=loop.limits, noise=noise,
        )  # fmt: skip

    def _refused(self, loop: Loop) -> Any:
        unstable = loop.report.status == Stability.UNSTABLE
        return unstable if self.unstable == "refuse" else np.zeros(np.shape(unstable), dtype=bool)

    def _numbers(self, things: Loop) -> dict[str, Any]:
        return self._numbers_of(things, None if np.all(self._refused(things)) else self._simulated(things))

    def _numbers_of(self, loop: Loop, run: Run | None) -> dict[str, Any]:
        """Numbers of the loop and of its run; NaN where it was refused or diverged."""
        report, refused = loop.report, self._refused(loop)
        facts = {} if run is None else run.summary()
        gone: Any = refused
        if run is not None:
            last = run["x"][-1] + run["y"][-1] + run["theta"][-1]
            gone = refused | ~np.isfinite(last)
        shape = np.broadcast_shapes(np.shape(gone), *(np.shape(facts.get(n, 0.0)) for n in _RUN_NUMBERS))
        names = [n for n in _RUN_NUMBERS if run is None or n in facts]
        shown = {n: _where(gone, np.nan, facts.get(n, np.nan), shape) for n in names}
        if run is not None and "rho" in run.columns:
            shown["final_rho"] = _where(gone, np.nan, run["rho"][-1], shape)
        diverged = _where(gone & ~np.asarray(refused), True, False, shape)
        stable = _where(report.stable, True, False, shape)
        margins = {"margin": report.margin, "largest_step": report.largest_step}
        shown |= {n: _where(True, value, 0.0, shape) for n, value in margins.items()}
        return shown | {"stable": stable, "refused": _where(refused, True, False, shape), "diverged": diverged}

    def _findings(self, things: Loop) -> list[Finding]:
        report = things.report
        tone = {Stability.STABLE: "good", Stability.BOUNDARY: "warn"}.get(report.status, "warn")
        tone = "no" if self._refused(things) else tone
        first = Finding(f"{report.status.value}; stable for every step below {report.largest_step:.4g} s", tone)
        return [first, *(Finding(sentence, "warn") for sentence in report.warnings)]

    def _outcome(self, progress: Progress, /) -> Outcome:
        loop = self.build()
        if self._refused(loop):
            sentence = REFUSED.format(loop.report.warnings[0] if loop.report.warnings else loop.report.status.value)
            return self._told(
                loop, self._numbers_of(loop, None), {}, ok=False, status=sentence, headline=sentence, tables={},
                check="nothing ran", passed=True, warnings=loop.report.sentences,
            )  # fmt: skip
        run = self._simulated(loop)
        progress(0.6)
        numbers = self._numbers_of(loop, run)
        error = truths.loop_error(
            run, loop.controller, loop.reference, self.integrator.method, limits=loop.limits, noise=loop.noise
        )
        return self._told(
            loop,
            numbers,
            {"run": run},
            run=run,
            ok=run.status is RunStatus.COMPLETE,
            status=run.status.value,
            headline=self._headline(numbers, loop.report),
            check=f"every step taken anew in complex numbers: {error:.0e}",
            passed=bool(error < ONE_STEP),
            tables={"run.csv": dict(run.columns)},
            warnings=run.warnings,
        )

    def _headline(self, numbers: dict[str, Any], report: StabilityReport) -> str:
        if numbers["diverged"]:
            return "the loop diverges"
        if "final_rho" in numbers:
            return f"arrives within {1000.0 * numbers['final_rho']:.3g} mm; {report.status.value}"
        poles = " and ".join(f"{p.real:+.2f}" if abs(p.imag) < 1e-12 else f"{p:+.2f}" for p in report.poles)
        return f"largest error {1000.0 * numbers['largest_error']:.2f} mm; poles {poles}: {report.status.value}"


def _where(chosen: Any, yes: Any, no: Any, shape: tuple[int, ...]) -> Any:
    """As NumPy's, of a shape; a plain number for one robot."""
    values = np.broadcast_to(np.where(chosen, yes, no), shape)
    return values if shape else values.item()
