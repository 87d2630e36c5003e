"""Which laws may be compiled with the fast primitives: those that cannot hide a NaN."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.engine import Evaluator, sin, where
from coplanar.laws import arms, landing
from tests.engines import NEEDS_NUMBA

pytestmark = NEEDS_NUMBA
FAR = 1e9  # [rad] where the fast sine answers NaN


def compared_and_forgotten(x):
    return where(sin(x) > 0.0, 1.0, -1.0)


def compared_and_shown(x):
    s = sin(x)
    return where(s > 0.0, 1.0, -1.0), s


def of_one_side_and_shown(x):
    s = where(x < 1.0, 0.5, sin(x))
    return where(s > 0.0, 1.0, -1.0) * s


def of_one_side_and_shown_on_another(x):
    s = where(x < 1.0, 0.5, sin(x))
    return where(s > 0.0, 1.0, -1.0), where(x < 2e9, 0.0, s)


def of_one_side_and_forgotten(x):
    s = where(x < 1.0, 0.5, sin(x))
    return where(s > 0.0, 1.0, -1.0)


def of_both_sides_and_shown_of_one(x):
    s = sin(x)
    side = where(x < 1.0, 2.0 * s, 3.0 * s)
    return where(side > 0.0, 1.0, -1.0), where(x < 1.0, s, 0.0)


def of_both_sides_and_shown(x):
    s = sin(x)
    side = where(x < 1.0, 2.0 * s, 3.0 * s)
    return where(side > 0.0, 1.0, -1.0) * side


LAWS = {
    compared_and_forgotten: False,
    compared_and_shown: True,
    of_one_side_and_shown: True,
    of_one_side_and_shown_on_another: False,
    of_one_side_and_forgotten: False,
    of_both_sides_and_shown_of_one: False,
    of_both_sides_and_shown: True,
    arms.turn_onto: False,
    landing.landing_finish: True,
}


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_a_law_that_compares_an_answer_shows_its_nan(law):
    from coplanar.engine.compiled.doubt import shows_every_nan

    assert shows_every_nan(law) is LAWS[law]


@pytest.mark.parametrize("law", [law for law in LAWS if law.__module__ == __name__], ids=lambda law: law.__name__)
def test_and_so_it_answers_beyond_the_fast_primitives(law):
    x = np.array([-FAR, -2.0, 0.25, 0.5, FAR, FAR + 1.0, FAR + 2.0, FAR + 3.0, FAR + 4.0])
    compiled, text = Evaluator(law).on_compiled(x), Evaluator(law).on_text(x)
    assert np.allclose(compiled, text, rtol=0.0, atol=1e-12)
