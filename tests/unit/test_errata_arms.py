"""Where the printed equations of the arm are wrong, and what is right."""

from __future__ import annotations

import numpy as np

from coplanar.arms import Arm


def as_printed(theta1, theta2, l1, l2):
    """The tip with theta2, measured from the first link, in the place of an angle to the x axis."""
    return np.array([l1 * np.cos(theta1) + l2 * np.cos(theta2), l1 * np.sin(theta1) + l2 * np.sin(theta2)])


def measured(theta1, theta2, l1, l2):
    """The tip by ruler and compass: the elbow, the first link's line extended, turned by theta2 about the elbow."""
    elbow = l1 * np.exp(1j * theta1)
    ahead = elbow / abs(elbow) * l2
    tip = elbow + ahead * np.exp(1j * theta2)
    return np.array([tip.real, tip.imag])


def test_an_angle_measured_from_the_first_link_adds_to_that_links_angle():
    q, links = (0.6, 0.9), (1.0, 0.8)
    right = measured(*q, *links)
    assert np.allclose(Arm(links).forward(q).position, right, atol=1e-15)
    assert np.hypot(*(as_printed(*q, *links) - right)) > 0.4


def test_the_printed_form_is_that_of_absolute_angles():
    q, links = (0.6, 0.9), (1.0, 0.8)
    assert np.allclose(Arm(links, angles="absolute").forward(q).position, as_printed(*q, *links), atol=1e-15)


def test_the_two_agree_only_where_the_first_link_lies_on_the_axis():
    assert np.allclose(as_printed(0.0, 0.9, 1.0, 0.8), Arm((1.0, 0.8)).forward([0.0, 0.9]).position)
