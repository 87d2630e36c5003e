"""What outcomes look like: the drawn numbers are those of the library."""

from __future__ import annotations

import json

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from coplanar.scenarios import KINDS, load, names, parse, template
from coplanar.viz import outcomes as pictures
from coplanar.viz.outcomes import figure_of, scene_of

NOES = [
    ("arm-reach", {"target": [1.2, 0.3]}),
    ("trace-circle", {"curve.center": [1.6, 0.5]}),
    ("trace-circle", {"curve.center": [5.0, 0.5]}),
    ("track-astroid", {"controller.kp": 400}),
    ("track-astroid", {"controller.kp": 400, "unstable": "run"}),
    ("aim-speed", {"target": [45, 2]}),
    ("aim-speed", {"target": [-30, 2], "start": [1, 0]}),
    ("aim-angle", {"target": [0.8, 2.1]}),
    ("mecanum", {"base": {"type": "differential", "track": 0.4, "radius": 0.05}}),
    ("rolling-wheel", {"rate": 0.0}),
    ("rolling-wheel", {"rate": -1.0, "slip": 0.3}),
    ("shot", {"level": 100.0, "duration": None}),
    ("arm-reach", {"arm.links": [0.5, 0.5, 0.3], "search": None}),
    ("track-astroid-p", {"reference.curve": {"type": "point", "point": [1, 1]}, "robot.start": {"x": 0, "y": 0}}),
]


def drawn(outcome):
    figure = Figure(figsize=(7.2, 4.6))
    FigureCanvasAgg(figure)
    figure_of(outcome, figure)
    figure.canvas.draw()
    return figure


def lines(ax):
    return [line.get_xydata() for line in ax.lines]


@pytest.mark.parametrize("name", names())
def test_every_demonstration_has_its_figure_and_scene(name):
    outcome = load(name).run()
    figure = drawn(outcome)
    assert figure.axes
    assert all(ax.get_xlabel() and ax.get_ylabel() for ax in figure.axes if name != "drive-square")
    scene = scene_of(outcome)
    assert (scene is None) == (name in ("frames", "arm-pose", "integrators"))
    if scene is not None:
        json.loads(scene.as_json(), parse_constant=pytest.fail)
        assert len(scene.times) <= 600


@pytest.mark.parametrize(("name", "changes"), NOES)
def test_an_honest_no_is_drawn_as_well(name, changes):
    outcome = load(name).replaced(changes).run()
    assert drawn(outcome).axes
    scene = scene_of(outcome)
    assert scene is None or json.loads(scene.as_json(), parse_constant=pytest.fail)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_drawn(kind):
    outcome = parse(template(kind)).run()
    assert figure_of(outcome).axes
    assert kind in pictures._FIGURES
    scene_of(outcome)


def test_the_arm_is_drawn_where_it_is():
    outcome = load("arm-pose").run()
    assert any(np.allclose(line[-1], outcome.things["points"][-1]) for line in lines(drawn(outcome).axes[0]))


def test_the_tracked_point_is_drawn_on_its_reference():
    outcome = load("track-astroid-p").run()
    wanted, moved = lines(drawn(outcome).axes[0])[0], None
    moved = outcome.run.poses @ np.asarray((0.05, 0.0))
    assert np.allclose(wanted, outcome.things["reference"].position(outcome.run.t))
    assert any(line.shape == moved.shape and np.allclose(line, moved) for line in lines(drawn(outcome).axes[0]))


def test_what_falls_short_shows_by_how_much():
    outcome = load("arm-reach").replaced({"target": [1.2, 0.3]}).run()
    gap = next(line for line in drawn(outcome).axes[0].lines if line.get_linestyle() == "--").get_xydata()
    assert float(np.hypot(*(gap[1] - gap[0]))) == pytest.approx(outcome.summary["gap"])


def test_a_rolling_wheel_turns_as_far_as_it_rolls():
    outcome = load("rolling-wheel").run()
    body = next(layer for layer in scene_of(outcome).layers if layer["kind"] == "body")
    poses = np.array(body["poses"])
    rolled, turned = poses[:, 0] - poses[0, 0], poses[:, 2] - poses[0, 2]
    assert np.allclose(rolled, -0.3 * turned, rtol=0, atol=2e-4)  # [m] a scene is rounded far below a pixel
    assert rolled[-1] > 3.0
