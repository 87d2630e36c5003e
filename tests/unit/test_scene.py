"""A scene holds rows for frames, rounded, in a view."""

from __future__ import annotations

import json

import numpy as np
import pytest

from coplanar.errors import InvalidShape
from coplanar.viz.scene import Scene

BOTH = Scene([0.0, 1.0])


def test_a_framed_field_has_a_row_a_time_or_one_for_all():
    assert len(BOTH.moving_point([[0, 0], [1, 2]]).layers[0]["points"]) == 2
    assert BOTH.moving_point([0, 0]).layers[0]["points"] == [[0.0, 0.0]]
    with pytest.raises(InvalidShape, match="one per time, or a single one"):
        BOTH.moving_point([[0, 0]] * 3)
    with pytest.raises(InvalidShape, match="rows of 4 numbers"):
        BOTH.segments([0, 0, 1])
    with pytest.raises(InvalidShape, match="one per time"):
        BOTH.trail([[0, 0]])


@pytest.mark.parametrize(
    ("add", "box"),
    [
        (lambda s: s.discs([1, 2, 0.5]), (0.5, 1.5, 1.5, 2.5)),
        (lambda s: s.arrows([1, 2, -3, 1]), (-2.0, 1.0, 2.0, 3.0)),
        (lambda s: s.segments([[0, 0, 1, 1], [2, 0, 1, 1]]), (0.0, 2.0, 0.0, 1.0)),
        (lambda s: s.region([[(0, 0), (2, 0), (0, 3)]]), (0.0, 2.0, 0.0, 3.0)),
        (lambda s: s.outline([(0, 0), (2, 0), (0, 3)]), (0.0, 2.0, 0.0, 3.0)),
        (lambda s: s.linkage([(0, 0), (2, 0)]), (0.0, 2.0, 0.0, 0.0)),
        (lambda s: s.linkage([[(0, 0), (2, 0)], [(0, 0), (0, 2)]]), (0.0, 2.0, 0.0, 2.0)),
        (lambda s: s.body([1, 0, 0.3], [(1, 0), (0, 1)]), (0.0, 2.0, -1.0, 1.0)),
        (lambda s: s.carried([1, 0, 0.3], [0, 0, 1, 0]), (0.0, 2.0, -1.0, 1.0)),
        (lambda s: s.cross([1, 2]).text("here", [3, 4]), (1.0, 3.0, 2.0, 4.0)),
    ],
)
def test_the_box_holds_every_kind(add, box):
    assert add(BOTH).bounds() == box
    assert add(Scene(view=(0.0, 1.0, 0.0, 1.0))).bounds() == (0.0, 1.0, 0.0, 1.0) if len(box) == 0 else True


def test_looks_that_are_not_set_are_not_sent():
    plain = BOTH.curve([(0, 0), (1, 1)], dashed=False).layers[0]
    assert set(plain) == {"kind", "role", "points"}
    ghost = BOTH.curve([(0, 0), (1, 1)], dashed=True, opacity=0.3).layers[0]
    assert (ghost["dashed"], ghost["opacity"]) == (True, 0.3)


def test_numbers_keep_six_digits_of_the_largest():
    points = BOTH.curve([(1234.56789, 1e-9), (-0.123456789, 0.0)]).layers[0]["points"]
    assert points == [[1234.57, 0.0], [-0.12, 0.0]]
    assert "-0.0" not in json.dumps(BOTH.curve([(-1e-30, 1.0)]).as_mapping())
    tiny = BOTH.curve([(1e-310, 0.0), (0.0, 0.0)]).layers[0]["points"]
    assert np.isfinite(tiny).all()


def test_a_picture_that_stands_still_has_one_time():
    still = Scene(view=(-1, 1, -1, 1)).discs([0, 0, 1]).as_mapping()
    assert still["times"] == [0.0]
    assert still["bounds"] == [-1.0, 1.0, -1.0, 1.0]


def test_headings_are_unwrapped():
    poses = BOTH.body([[0, 0, 3.1], [0, 0, -3.1]], [(1, 0), (0, 1)]).layers[0]["poses"]
    assert abs(poses[1][2] - poses[0][2]) < 0.2
