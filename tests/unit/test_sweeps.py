"""Sweeps: which rows, the same table whatever the workers, nothing lost."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.engine import evaluator, reproducible
from coplanar.errors import InvalidInput, InvalidValue, UnknownName
from coplanar.scenarios import InvalidScenario, load
from coplanar.sweeps import Normal, Uniform, read_vary, sweep
from coplanar.sweeps.plan import planned
from coplanar.sweeps.task import measure_rows


def same(one, other):
    assert list(one.columns) == list(other.columns)
    for name, values in one.columns.items():
        np.testing.assert_array_equal(values, other[name])


def test_a_grid_has_every_combination_the_last_key_fastest():
    plan = planned(
        load("track-astroid"), {"controller.kp": [1, 2], "integrator.method": "euler,rk4", "duration": "1 s"}
    )
    assert plan.columns["controller.kp"].tolist() == [1, 1, 2, 2]
    assert plan.columns["integrator.method"].tolist() == ["euler", "rk4"] * 2
    assert plan.columns["duration"].tolist() == [1.0] * 4


def test_spans_take_units_and_hold_both_ends():
    plan = planned(load("arm-reach"), {"target.0": "10 cm:1 m:4", "target.1": "0.1:0.4:3:log"})
    np.testing.assert_allclose(np.unique(plan.columns["target.0"]), [0.1, 0.4, 0.7, 1.0])
    np.testing.assert_allclose(plan.columns["target.1"][:3], [0.1, 0.2, 0.4])


def test_draws_follow_their_distribution_and_their_seed():
    vary = {"target.0": Uniform(-1.0, 3.0), "target.1": Normal(0.5, 0.1)}
    one, other, third = (planned(load("arm-reach"), vary, samples=4000, seed=s) for s in (1, 1, 2))
    assert np.array_equal(one.columns["target.0"], other.columns["target.0"])
    assert not np.array_equal(one.columns["target.0"], third.columns["target.0"])
    assert abs(one.columns["target.0"].mean() - 1.0) < 5 * 4.0 / np.sqrt(12 * 4000)
    assert abs(one.columns["target.1"].std() - 0.1) < 5 * 0.1 / np.sqrt(2 * 4000)


def test_rows_together_are_rows_one_by_one():
    vary = {"controller.kp": "20:90:4", "controller.kd": [0.0, 0.2]}
    scenario = load("track-astroid").replaced({"duration": 5, "noise": {"position": 0.01, "v": 0.02}})
    vary["noise.seed"] = [0, 3]
    table = sweep(scenario, vary, jobs=1)
    for k in range(len(table)):
        alone = scenario.replaced({key: table[key][k].item() for key in vary}).measure()
        for name in table.measured:
            assert table[name][k] == pytest.approx(alone[name], rel=1e-9, abs=1e-12), name


def test_the_table_does_not_depend_on_the_workers():
    scenario = load("track-astroid").replaced({"duration": 0.5, "noise": {"position": 0.01}})
    vary, settings = {"controller.kp": "10:90", "integrator.method": "euler,exact"}, {"samples": 12, "seed": 5}
    alone = sweep(scenario, vary, **settings, jobs=1, task_rows=5)
    with ThreadPoolExecutor(3) as threads:
        same(alone, sweep(scenario, vary, **settings, executor=threads, task_rows=5))
    same(alone, sweep(scenario, vary, **settings, jobs=2, task_rows=5))
    assert len(np.unique(alone["noise.seed"])) == 24
    other = sweep(scenario, vary, samples=12, seed=6, jobs=1, task_rows=5)
    assert not np.array_equal(alone["rms_error"], other["rms_error"])


def test_a_row_that_cannot_run_says_why_and_the_others_have_their_numbers():
    table = sweep("arm-reach", {"target.0": [0.4, 0.5], "arm.links.1": [0.5, 1e9]}, jobs=1)
    wide = sweep("track-astroid", {"controller.kp": Normal(1.0, 2.0)}, samples=20, seed=1, jobs=1)
    bad = wide["controller.kp"] <= 0
    assert 0 < bad.sum() == wide.problems < 20
    assert all("controller.kp" in text for text in wide["problem"][bad])
    assert np.isfinite(wide["margin"][~bad]).all()
    assert np.isnan(wide["margin"][bad]).all()
    assert len(table) == 4


def test_an_interrupted_sweep_goes_on(tmp_path):
    vary, path = {"target.0": "0.1:1:20"}, tmp_path / "table.csv"
    whole = sweep("arm-reach", vary, jobs=1, task_rows=3)

    def stop_at_three(done, _):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep("arm-reach", vary, jobs=1, task_rows=3, path=path, progress=stop_at_three)
    assert not path.exists()
    parts = tmp_path / "table.csv.parts"
    assert len(list(parts.glob("[0-9]*.json"))) == 3
    (parts / "0.json").write_text("{ half a fi")  # a part that cannot be read is worked out again
    steps = []
    same(whole, sweep("arm-reach", vary, jobs=1, task_rows=3, path=path, progress=lambda done, _: steps.append(done)))
    assert steps[0] == 2
    assert path.exists()
    assert not parts.exists()


def test_parts_of_another_sweep_are_not_taken(tmp_path):
    path = tmp_path / "table.csv"

    def stop(done, _):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep("arm-reach", {"target.0": "0.1:1:9"}, jobs=1, task_rows=3, path=path, progress=stop)
    with pytest.raises(InvalidValue, match="same scenario"):
        sweep("arm-reach", {"target.0": "0.1:1:10"}, jobs=1, task_rows=3, path=path)


def test_csv_and_parquet_hold_the_table(tmp_path):
    pandas = pytest.importorskip("pandas", reason="reads the tables independently")
    pytest.importorskip("pyarrow", reason="Parquet needs the extra logs")
    vary = {"controller.kp": [50, -1.0, 250.0], "integrator.method": "euler,rk4"}
    with pytest.raises(InvalidScenario):
        sweep("track-astroid", vary, jobs=1)
    table = sweep("track-astroid", {"controller.kp": Normal(100.0, 120.0)}, samples=9, seed=2, jobs=1)
    assert 0 < table.problems < 9
    for name, read in (("t.csv", pandas.read_csv), ("t.parquet", pandas.read_parquet)):
        frame = read(table.write(tmp_path / name))
        assert list(frame.columns) == list(table.columns)
        np.testing.assert_array_equal(frame["controller.kp"], table["controller.kp"])
        np.testing.assert_array_equal(frame["rms_error"], table["rms_error"])
        assert [t or "" for t in frame["problem"].fillna("")] == [" ".join(t.split()) for t in table["problem"]]
    assert list(table.to_dataframe().columns) == list(table.columns)


@pytest.mark.parametrize(
    ("vary", "how", "match"),
    [({}, {}, "keys to vary"), ({"controller.kp": "1:2"}, {}, "samples"), ({"controller.kp": []}, {}, "one value"),
     ({"controller.kp": "1:2:0"}, {}, "values"), ({"controller.kp": "1:2:3:lin"}, {}, "lo:hi:n"),
     ({"controller.kp": "-1:2:3:log"}, {}, "controller.kp"), ({"controller.kq": [1]}, {}, "kp, kd"),
     ({"controller.kp": ["many"]}, {}, "controller.kp"), ({"controller.kp": [1]}, {"samples": 0}, "samples"),
     ({"controller.kp": [1]}, {"jobs": 0}, "jobs"), ({"controller.kp": [1]}, {"seed": -1}, "seed"),
     ({"controller.kp": [1]}, {"executor": 3}, "executor"), ({"controller.kp": [1]}, {"path": "a.xls"}, "csv"),
     ({"controller.kp": [1]}, {"task_rows": 0}, "task_rows"), ({"controller": "1:2:3"}, {}, "controller"),
     ({"controller.kp": [1]}, {"executor": "tcp://127.0.0.1:9"}, "dask")],
)  # fmt: skip
def test_what_cannot_be_swept_is_refused_before_anything_runs(vary, how, match):
    with pytest.raises(InvalidInput, match=match):
        sweep("track-astroid", vary, **{"jobs": 1, **how} if "executor" not in how else how)


@settings(deadline=None, max_examples=200)
@given(st.text(max_size=30))
def test_any_text_is_read_or_refused(text):
    with suppress(InvalidInput):
        read_vary(text)


def test_a_sweep_plots_one_key_or_two():
    one = sweep("arm-reach", {"target.0": "0.1:1.4:9"}, jobs=1)
    ax = one.plot("gap")
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), one["gap"])
    assert ax.get_xlabel() == "target.0"
    two = sweep("arm-reach", {"target.0": "0.1:1.4:5", "target.1": "0:1:4"}, jobs=1)
    ax = two.plot("gap")
    np.testing.assert_array_equal(np.asarray(ax.collections[0].get_array()).ravel(), two["gap"].reshape(5, 4).T.ravel())
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("target.0", "target.1")
    with pytest.raises(UnknownName, match="gap"):
        two.plot("gapp")


def test_reproducible_digits_do_not_hang_on_what_ran_before():
    from coplanar.laws import motion

    law = evaluator(motion.segment)
    rows = [np.random.default_rng(k).uniform(0.1, 1.0, 50) for k in range(8)]
    with reproducible():
        text = law.on_text(*rows)
        law.on_compiled(*rows)  # from here on the compiled loop is there
        again = law(*rows)
    assert all(np.array_equal(a, b) for a, b in zip(text, again, strict=True))


def test_a_task_travels_as_plain_data():
    data = json.loads(json.dumps(load("arm-reach").data()))
    assert measure_rows(data, {"target.0": [0.5, 5.0]})["reached"] == [True, False]
