"""Many scenarios at once are each of them."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from coplanar.errors import InvalidInput, InvalidShape
from coplanar.scenarios import KINDS, InvalidScenario, batched, from_data, load, measured, names, varied

NEAR = 1e-9  # relative to the largest of a column: loops add up rounding, in another order for many than for one
SPREADS = [
    ("track-astroid", {"controller.kp": (5.0, 90.0), "controller.kd": (0.0, 0.3), "controller.point.0": (0.05, 0.3),
                       "controller.point.1": (-0.1, 0.1), "robot.start.theta": (-3.0, 3.0),
                       "reference.curve.a": (0.5, 2.0), "reference.curve.center.0": (-1.0, 1.0),
                       "reference.curve.tilt": (-1.0, 1.0)}),
    ("track-astroid-p", {"controller.kp": (50.0, 400.0), "robot.start.x": (0.9, 1.1), "robot.start.y": (-0.1, 0.1),
                         "limits.v": (0.3, 3.0), "limits.omega": (1.0, 9.0)}),
    ("track-astroid-p", {"noise.position": (0.0, 0.01), "noise.seed": (0, 999), "controller.ki": (0.0, 50.0)}),
    ("drive-to-pose", {"controller.k_rho": (1.0, 3.0), "controller.goal.x": (0.5, 2.0),
                       "controller.goal.theta": (-1.0, 1.0)}),
    ("arm-reach", {"target.0": (-1.3, 1.3), "target.1": (-1.3, 1.3), "near.0": (-1.0, 1.0), "near.1": (0.5, 1.0)}),
    ("arm-pose", {"q.0": (-3.0, 3.0), "q.1": (-3.0, 3.0)}),
    ("frames", {"frames.0.x": (-3.0, 3.0), "frames.1.theta": (-3.0, 3.0)}),
    ("rolling-wheel", {"radius": (0.1, 1.0), "rate": (-3.0, 3.0), "slip": (-1.0, 1.0)}),
    ("drive-square", {"start.x": (-1.0, 1.0), "start.theta": (-3.0, 3.0)}),
    ("arc-chain", {"segments.0.v": (-2.0, 2.0), "segments.1.omega": (-2.0, 2.0), "segments.2.a": (-1.0, 1.0),
                   "segments.3.alpha": (-1.0, 1.0), "segments.4.duration": (0.0, 3.0), "start.theta": (-3.0, 3.0)}),
    ("holonomic", {"pieces.0.ax": (-1.0, 1.0), "pieces.3.alpha": (-1.0, 1.0), "velocity.vy": (-1.0, 1.0)}),
    ("ramp", {"start.0": (-1.0, 1.0), "target.1": (-1.0, 1.0), "acceleration.0": (0.1, 1.0)}),
    ("omni-three", {"twist.vx": (-1.0, 1.0), "twist.vy": (-1.0, 1.0), "twist.omega": (0.1, 1.0)}),
    ("shot", {"projectile.mass": (0.5, 2.0), "projectile.drag": (0.0, 0.5), "launch.speed": (5.0, 90.0),
              "launch.angle": (0.1, 1.4), "level": (-3.0, 3.0)}),
    ("aim-speed", {"target.0": (10.0, 45.0), "target.1": (-3.0, 9.0), "speed": (20.0, 60.0),
                   "projectile.drag": (0.0, 0.05)}),
    ("aim-time", {"time": (0.5, 3.0), "target.0": (1.0, 9.0), "projectile.mass": (0.5, 2.0)}),
    ("aim-angle", {"angle": (0.3, 1.4), "target.0": (1.0, 9.0)}),
    ("aim-least", {"target.0": (-30.0, -1.0), "start.1": (0.0, 1.0), "projectile.gravity": (1.0, 20.0)}),
]  # fmt: skip


def tables(spread):
    """Columns of one to four rows."""

    def entries(low, high):
        return st.integers(low, high) if isinstance(low, int) else st.floats(low, high)

    return st.integers(1, 4).flatmap(
        lambda rows: st.fixed_dictionaries(
            {key: st.lists(entries(*ends), min_size=rows, max_size=rows) for key, ends in spread.items()}
        )
    )


def alike(many, one):
    """Equal up to rounding; NaN where the other is NaN."""
    many, one = np.asarray(many, dtype=float), np.asarray(one, dtype=float)
    scale = max(1.0, float(np.nanmax(np.abs(one), initial=0.0)) if np.isfinite(one).any() else 1.0)
    return np.allclose(many, one, rtol=NEAR, atol=NEAR * scale, equal_nan=True)


def ready(name, spread):
    """The demonstration with the structure that a spread of its keys needs."""
    changes = {key: 1 for key in spread if key.startswith("noise.seed")}
    changes |= {"near": [0.0, 0.5]} if "near.0" in spread else {}
    return load(name).replaced(changes) if changes else load(name)


@pytest.mark.parametrize(("name", "spread"), SPREADS, ids=[f"{n}-{i}" for i, (n, _) in enumerate(SPREADS)])
@settings(deadline=None, max_examples=4, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(data=st.data())
def test_a_batch_is_each_of_its_rows(name, spread, data):
    scenario, columns = ready(name, spread), data.draw(tables(spread))
    rows = len(next(iter(columns.values())))
    scenarios = [scenario.replaced({key: values[i] for key, values in columns.items()}) for i in range(rows)]
    alone = [one.measure() for one in scenarios]
    for table in (measured(scenario, columns), batched(scenarios).measure()):
        assert set(table) == set(alone[0])
        for key, column in table.items():
            whole = np.broadcast_to(column, (rows,)) if np.ndim(column) == 0 else column
            assert alike(whole, [one[key] for one in alone]), key


def test_every_kind_with_arrays_is_tried():
    tried = {load(name).type for name, _ in SPREADS}
    assert tried == {kind for kind, model in KINDS.items() if model.vectorised_keys}


def test_keys_that_take_no_arrays_go_one_after_another():
    table = measured(
        load("track-astroid-p"),
        {"controller.kp": [20.0, 30.0, 20.0, 30.0], "integrator.method": ["rk4", "rk4", "euler", "euler"],
         "integrator.step": [0.01, 0.01, 0.02, 0.02]},
    )  # fmt: skip
    one = load("track-astroid-p").replaced(
        {"controller.kp": 30.0, "integrator.method": "euler", "integrator.step": 0.02}
    )
    assert table["largest_error"].shape == (4,)
    assert table["largest_error"][3] == pytest.approx(one.measure()["largest_error"], rel=1e-12)
    links = measured(load("arm-reach"), {"arm.links.0": [0.5, 0.2], "target.0": [0.9, 0.9]})
    assert links["gap"].tolist() == pytest.approx([0.0, 0.2])
    text = measured(load("arm-reach"), {"arm.links.0": ["50 cm", "20 cm"]})
    assert text["reached"].tolist() == [True, True] or text["reached"].dtype == bool


def test_what_some_rows_do_not_have_is_nan():
    goal = {"type": "polar", "goal": {"x": 1.0}}
    track = load("track-astroid-p").replaced({"robot.start": {"x": 0.9, "y": 0.0}})
    table = measured(track, {"controller": [goal, track.data()["controller"]]})
    assert np.isnan(table["final_rho"]).tolist() == [False, True]
    assert np.isnan(table["largest_error"]).tolist() == [True, False]


def test_large_batches_are_measured_in_pieces(monkeypatch):
    scenario = load("rolling-wheel")
    monkeypatch.setattr(type(scenario), "rows_at_once", 3)
    radii = np.linspace(0.1, 1.0, 10)
    assert measured(scenario, {"radius": radii})["top_speed"].tolist() == pytest.approx((4.0 * radii).tolist())


def test_a_thousand_gains_take_no_thousand_runs():
    begun = time.process_time()
    gains = np.linspace(5.0, 60.0, 1000)
    errors = measured(load("track-astroid-p"), {"controller.kp": gains})["largest_error"]
    assert (np.diff(errors) < 0.0).all()
    assert time.process_time() - begun < 20.0


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"controller.kp": [10.0, -1.0, 20.0]}, "controller.kp = -1.0: needed a gain"),
        ({"controller.kpp": [1.0]}, "did you mean 'kp'?"),
        ({"controller.kp": [float("nan")]}, "finite"),
        ({"controller.kp": [True, False]}, "no numbers"),
        ({"controller.point.0": [-0.1, 0.0, 0.1]}, "px other than 0"),
        ({"controller.kp": [1.0], "controller.kd": [0.1, 0.2]}, "one length"),
        ({}, "one length"),
        ({"controller.kp": []}, "one length"),
    ],
)
def test_bad_tables_are_refused(columns, words):
    with pytest.raises(InvalidInput, match=words.replace("?", r"\?")):
        measured(load("track-astroid-p"), columns)


def test_what_cannot_be_stacked():
    track = load("track-astroid-p")
    with pytest.raises(InvalidScenario, match="a key that takes arrays"):
        varied(track, {"duration": [1.0, 2.0]})
    with pytest.raises(InvalidScenario, match=r"integrator\.step"):
        batched([track, track.replaced({"integrator.step": 0.02})])
    for other in ([], [track, load("shot")], [track, track.replaced({"noise.seed": 1})]):
        with pytest.raises(InvalidShape, match="same keys"):
            batched(other)


def test_arrays_are_read_only_and_plain_scenarios_stay_plain():
    many = varied(load("arm-pose"), {"q.0": [0.1, 0.2]})
    assert not many.q[0].flags.writeable
    assert load("arm-pose").q == (0.3, 0.4)
    same = load("arm-pose")
    assert batched([same, same]) is same


def test_every_key_of_a_pattern_exists():
    """A pattern that matches no key of its kind would be a misspelling."""
    for name in names():
        scenario = load(name)
        for pattern in scenario.vectorised_keys:
            assert pattern.split(".")[0] in type(scenario).model_fields
    assert from_data(load("shot").data()) == load("shot")
