"""Paths of points in text files."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.errors import InvalidInput, InvalidShape, InvalidValue
from coplanar.logs import Waypoints, read_path

POINTS = [[0.0, 1.0], [2.5, -1e-3], [4.0, 3.0]]
HEADINGS = [0.0, 0.5, -3.0]


@pytest.mark.parametrize(
    "text",
    [
        "x,y\n0,1\n2.5,-1e-3\n4,3\n",
        "0,1\n2.5,-1e-3\n4,3",
        "0 1\n2.5   -1e-3\n  4\t 3\n",
        "0\t1\n2.5\t-1e-3\n4\t3\n",
        "0; 1\n2.5; -1e-3\n4; 3\n",
        "# a survey\n\n0 1 # here\n% no\n2.5 -1e-3\r\n4 3\n",
        "y, x\n1, 0\n-1e-3, 2.5\n3, 4\n",
        '"Y [m]","X [m]"\n1,0\n-1e-3,2.5\n3,4\n',
        "x_m y_m\n0 1\n2.5 -1e-3\n4 3\n",
        "t,x,y,speed\n0,0,1,9\n1,2.5,-1e-3,fast\n2,4,3,9\n",
        "# x_m, y_m, w_right_m, w_left_m\n0,1,9,9\n2.5,-1e-3,9,9\n4,3,9,9\n",
        "\ufeffx,y\n0,1\n2.5,-1e-3\n4,3\n",
    ],
)
def test_points_in_any_order_and_form(tmp_path, text):
    path = tmp_path / "path.csv"
    path.write_text(text, encoding="utf-8")
    read = read_path(path)
    assert read.points.tolist() == POINTS
    assert read.theta is None


@pytest.mark.parametrize(
    "text",
    [
        "0,1,0\n2.5,-1e-3,0.5\n4,3,-3\n",
        "theta,y,x\n0,1,0\n.5,-1e-3,2.5\n-3,3,4\n",
        "x y Yaw\n0 1 0\n2.5 -1e-3 .5\n4 3 -3\n",
        "x y heading_rad\n0 1 0\n2.5 -1e-3 .5\n4 3 -3\n",
        "# x y psi [rad]\n0 1 0\n2.5 -1e-3 .5\n4 3 -3\n",
    ],
)
def test_headings(tmp_path, text):
    path = tmp_path / "path.txt"
    path.write_text(text, encoding="utf-8")
    read = read_path(path)
    assert read.points.tolist() == POINTS
    assert read.theta.tolist() == HEADINGS


def test_ready_for_curves(tmp_path):
    path = tmp_path / "path.csv"
    path.write_text("0,0\n3,0\n3,4\n0,4\n", encoding="utf-8")
    read = read_path(path)
    assert read.polyline().interval == (0.0, 10.0)
    assert read.polyline(closed=True).interval == (0.0, 14.0)
    np.testing.assert_allclose(read.spline().position(3.0), [3.0, 0.0], atol=1e-15)
    assert read.spline(closed=True).closed
    with pytest.raises(ValueError, match="read-only"):
        read.points[0, 0] = 1.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "path.csv"),
        ("# nothing\n", "a point in each line"),
        ("x,y\n", "line 1 of .*points below"),
        ("x,z\n0,1\n", "line 1 of .*names x and y"),
        ("a b\n0 1\n", "line 1 of"),
        ("x,y,x\n0,1,2\n", "line 1 of .*one column for x"),
        ("x,y,theta_deg\n0,1,2\n", "line 1 of .*theta in rad.*convert"),
        ("x_ft,y_ft\n0,1\n", "line 1 of .*x in m"),
        ("0,1,2,3\n", "line 1 of .*name the columns in a header"),
        ("0\n1\n", "line 1 of"),
        ("x,y\n0,1\n\n# so\n2\n", "line 5 of .*2 numbers.*it has 1"),
        ("x,y\n0,1\n2,two\n", "line 3 of .*two"),
        ("0 1\n2 nan\n", "line 2 of .*finite"),
        ("0 1\n2 1e999\n", "line 2 of .*finite"),
        ("0,1\n2 3\n", "line 2 of"),
        ("0 1\n1_0 2\n", "line 2 of"),
    ],
)
def test_what_is_no_path(tmp_path, text, words):
    path = tmp_path / "path.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInput, match=words):
        read_path(path)


def test_neighbours_that_coincide_are_the_curves_matter(tmp_path):
    path = tmp_path / "path.csv"
    path.write_text("0,0\n0,0\n1,0\n", encoding="utf-8")
    with pytest.raises(InvalidValue, match="remove point 1"):
        read_path(path).polyline()


def test_waypoints_check_what_they_hold():
    with pytest.raises(InvalidShape):
        Waypoints([1.0, 2.0, 3.0])
    with pytest.raises(InvalidShape):
        Waypoints([[1.0, 2.0]], [0.0, 1.0])
    with pytest.raises(InvalidShape):
        Waypoints([1.0, 2.0])
    with pytest.raises(InvalidValue, match="a file that can be read"):
        read_path("no/such/file.csv")
