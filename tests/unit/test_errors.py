"""Errors say what was given, what was needed, what to do; they are one family and travel well."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

from coplanar import errors
from coplanar.errors import (
    CoplanarError,
    InvalidInput,
    InvalidShape,
    InvalidValue,
    MissingExtra,
    NoSolution,
    UnknownName,
)

EXAMPLES = [
    InvalidInput("speed", -1, "0 or more", "drive backwards by omega"),
    InvalidValue("radius", 0.0, "greater than 0"),
    InvalidShape("points", "shape (3,)", "shape (..., 2)"),
    UnknownName("method", "rk5", ["euler", "rk4"]),
    NoSolution("out of reach by 0.2 m", {"gap": 0.2}),
    MissingExtra("pandas", "logs"),
]


def test_every_error_is_of_one_family_and_drawn_in_the_docstring():
    kinds = [k for k in vars(errors).values() if isinstance(k, type) and issubclass(k, CoplanarError)]
    assert {type(e) for e in EXAMPLES} | {CoplanarError} == set(kinds)
    assert all(kind.__name__ in errors.__doc__ for kind in kinds)


def test_a_caller_may_catch_them_as_the_usual_ones():
    assert issubclass(InvalidShape, ValueError)
    assert issubclass(InvalidValue, ValueError)
    assert issubclass(UnknownName, ValueError)
    assert issubclass(MissingExtra, ImportError)
    assert not issubclass(NoSolution, ValueError)


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (EXAMPLES[0], "speed = -1: needed 0 or more; drive backwards by omega"),
        (EXAMPLES[1], "radius = 0.0: needed greater than 0"),
        (EXAMPLES[2], "points with shape (3,): needed shape (..., 2)"),
        (EXAMPLES[3], "method = 'rk5': needed one of euler, rk4; did you mean 'rk4'?"),
        (EXAMPLES[4], "out of reach by 0.2 m"),
    ],
)
def test_the_text_says_given_needed_and_what_to_do(error, text):
    assert str(error) == text


def test_the_numbers_are_kept():
    error = InvalidValue("radius", -2.0, "greater than 0", "give the size")
    assert (error.name, error.given, error.needed, error.remedy) == ("radius", -2.0, "greater than 0", "give the size")
    assert EXAMPLES[4].result == {"gap": 0.2}
    assert (EXAMPLES[5].package, EXAMPLES[5].extra) == ("pandas", "logs")


def test_a_missing_extra_says_how_to_install_it():
    assert "pandas" in str(EXAMPLES[5])
    assert "pip install 'coplanar[logs]'" in str(EXAMPLES[5])


def test_a_long_value_is_cut_and_stays_on_one_line():
    text = str(InvalidValue("x", np.zeros((50, 50)), "finite numbers"))
    assert "\n" not in text
    assert len(text) < 130
    assert "..." in text


def test_a_name_unlike_any_other_gets_the_list_alone():
    assert str(UnknownName("method", "zzz", ["euler", "rk4"])) == "method = 'zzz': needed one of euler, rk4"
    assert str(UnknownName("method", None, ["euler"])) == "method = None: needed one of euler"


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda e: type(e).__name__)
@pytest.mark.parametrize("travel", [copy.copy, copy.deepcopy, lambda e: pickle.loads(pickle.dumps(e))])
def test_errors_travel_between_processes(error, travel):
    there = travel(error)
    assert type(there) is type(error)
    assert str(there) == str(error)
    assert vars(there) == vars(error)
