"""Runs of every kind, for the tests of the logs, and what it means that two are the same."""

from __future__ import annotations

import math

import numpy as np

from coplanar.run import Kind, Run, RunStatus

T = np.arange(20) / 7.0
WOBBLE = np.sin(np.outer(T, [1.0, 2.0, 3.0, 5.0, 7.0, 11.0])).T / 3.0


def unicycle(**more):
    names = ("x", "y", "theta", "v", "omega", "ex")
    columns = {"t": T, **dict(zip(names, WOBBLE, strict=True)), "ey": WOBBLE[0] * 1e-300, **more}
    info = {"method": "exact", "step": 0.1, "seed": None, "gains": [1.0, 2.5], "on": True, "nested": {"deep": [[1]]}}
    return Run(columns, "unicycle", warnings=("near the edge: 0,99", 'the "last" step is longer'), info=info)


RUNS = {
    "unicycle": unicycle(),
    "body": Run(
        {"t": T, **dict(zip(("x", "y", "theta", "vx", "vy", "omega"), WOBBLE, strict=True)), "wheel/rate 1": T}, "body"
    ),
    "arm": Run({"t": T, "q1": WOBBLE[0], "q2": WOBBLE[1], "x": WOBBLE[2], "y": WOBBLE[3]}, "arm"),
    "arm with heading": Run(
        {"t": T, "q1": WOBBLE[0], "q2": WOBBLE[1], "x": WOBBLE[2], "y": WOBBLE[3], "theta": WOBBLE[4]}, "arm"
    ),
    "flight": Run({"t": T, **dict(zip(("x", "y", "vx", "vy"), WOBBLE, strict=False))}, "flight"),
    "table": Run({"s": T[::-1], "höhe": WOBBLE[0]}, Kind(states=("h*",), angles=("höhe",)), index="s"),
    "before zero": Run({"t": T - 1.0, "x": WOBBLE[0]}),
    "one row": Run({"t": [0.25], "x": [-0.0]}),
    "diverged": Run(
        {
            "t": [0.0, 0.1, 0.2],
            "x": [0.0, math.inf, math.nan],
            "y": [0.0, -math.inf, 1.0],
            "theta": [0.0, 1.0, math.nan],
        },
        "unicycle",
        status=RunStatus.DIVERGED,
    ),
}
BATCH = Run(
    {"t": T, "x": np.arange(120.0).reshape(20, 3, 2) / 7.0, "y": np.arange(40.0).reshape(20, 2) / 3.0, "theta": T},
    "unicycle",
)


def same_numbers(one, other):
    """Column by column, bit by bit (any NaN is a NaN)."""
    assert list(one.columns) == list(other.columns)
    for name, values in one.columns.items():
        assert other[name].shape == values.shape
        np.testing.assert_array_equal(other[name], values)
        np.testing.assert_array_equal(np.signbit(other[name])[~np.isnan(values)], np.signbit(values)[~np.isnan(values)])


def same(one, other):
    """Numbers, kind, index, status, warnings, info."""
    same_numbers(one, other)
    assert (other.kind, other.index, other.status) == (one.kind, one.index, one.status)
    assert (other.warnings, dict(other.info)) == (one.warnings, dict(one.info))
