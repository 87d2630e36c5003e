"""The palette: legible on its surface, told apart by everybody; themes come and go without a trace."""

from __future__ import annotations

import itertools

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from coplanar.errors import UnknownName
from coplanar.viz import drawn_in, plot_path
from coplanar.viz.style import DARK, LIGHT, ORDER, ROLES, THEMES, theme_on, theme_set

LEAST_CONTRAST = 3.0  # WCAG 2.2, success criterion 1.4.11: graphical objects
LEAST_DISTANCE = 12.0  # CIEDE2000; 1 is just noticeable side by side

# Machado, Oliveira, Fernandes 2009, table 1, severity 1: what is seen without one kind of cone, in linear RGB.
SIGHTS = {
    "all cones": np.eye(3),
    "protanopia": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deuteranopia": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritanopia": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)


def linear(colour):
    rgb = np.array(to_rgb(colour))
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    part = TO_XYZ @ np.clip(rgb, 0.0, 1.0) / (TO_XYZ @ np.ones(3))
    f = np.where(part > (6 / 29) ** 3, np.cbrt(part), part / (3 * (6 / 29) ** 2) + 4 / 29)
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


def ciede2000(one, other):
    """Sharma, Wu, Dalal 2005, eqs. 2-22."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    mean = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    stretch = 1.5 - 0.5 * np.sqrt(mean**7 / (mean**7 + 25.0**7))
    c1, c2 = np.hypot(a1 * stretch, b1), np.hypot(a2 * stretch, b2)
    h1, h2 = np.arctan2(b1, a1 * stretch) % (2 * np.pi), np.arctan2(b2, a2 * stretch) % (2 * np.pi)
    turn = (h2 - h1 + np.pi) % (2 * np.pi) - np.pi
    light, chroma, hue = (l1 + l2) / 2, (c1 + c2) / 2, np.degrees(h1 + turn / 2) % 360
    cosine = lambda k, shift: np.cos(np.radians(k * hue + shift))  # noqa: E731 - one line of the standard
    t = 1 - 0.17 * cosine(1, -30) + 0.24 * cosine(2, 0) + 0.32 * cosine(3, 6) - 0.20 * cosine(4, -63)
    s_light = 1 + 0.015 * (light - 50) ** 2 / np.sqrt(20 + (light - 50) ** 2)
    bend = -2 * np.sqrt(chroma**7 / (chroma**7 + 25.0**7)) * np.sin(np.radians(60 * np.exp(-(((hue - 275) / 25) ** 2))))
    dl, dc = (l2 - l1) / s_light, (c2 - c1) / (1 + 0.045 * chroma)
    dh = 2 * np.sqrt(c1 * c2) * np.sin(turn / 2) / (1 + 0.015 * chroma * t)
    return np.sqrt(dl**2 + dc**2 + dh**2 + bend * dc * dh)


def contrast(one, other):
    a, b = sorted((TO_XYZ[1] @ linear(one), TO_XYZ[1] @ linear(other)))
    return (b + 0.05) / (a + 0.05)


def test_the_distance_is_the_standards():
    """Pairs 1, 7 and 25 of the test data of Sharma, Wu, Dalal 2005."""
    assert ciede2000((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485)) == pytest.approx(2.0425, abs=5e-5)
    assert ciede2000((50.0, 0.0, 0.0), (50.0, -1.0, 2.0)) == pytest.approx(2.3669, abs=5e-5)
    assert ciede2000((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387)) == pytest.approx(1.2644, abs=5e-5)


@pytest.mark.parametrize("sight", SIGHTS)
@pytest.mark.parametrize("theme", THEMES)
def test_series_are_told_apart_by_everybody(theme, sight):
    seen = [lab(SIGHTS[sight] @ linear(colour)) for colour in THEMES[theme].series]
    assert min(ciede2000(a, b) for a, b in itertools.combinations(seen, 2)) >= LEAST_DISTANCE


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_everything_stands_out_from_its_surface(theme):
    assert min(contrast(colour, theme.surface) for colour in theme.series) >= LEAST_CONTRAST
    assert contrast(theme.ink, theme.surface) >= 7.0
    assert contrast(theme.muted, theme.surface) >= 4.5


def test_a_palette_of_neighbours_would_be_seen():
    seen = [lab(SIGHTS["deuteranopia"] @ linear(colour)) for colour in ("#0b7a62", "#a1306f")]
    assert ciede2000(*seen) < LEAST_DISTANCE


def test_roles_places_and_fields_are_colours():
    assert set(ROLES.values()) <= set(ORDER)
    assert LIGHT.colour("link") == LIGHT.colour("C0") == LIGHT.colour("first") == LIGHT.series[0]
    assert DARK.colour("C7") == DARK.series[1]
    assert DARK.colour("muted") == DARK.muted
    assert LIGHT.colour("crimson") == "crimson"
    assert LIGHT.colour((1, 0, 0)) == (1, 0, 0)


def test_a_theme_lasts_as_long_as_its_block_and_figures_keep_theirs():
    before = dict(mpl.rcParams)
    with drawn_in("dark"):
        assert theme_set() is DARK
        ax = plot_path([(0, 0), (1, 1)], color="C1")
    assert dict(mpl.rcParams) == before
    assert theme_set() is LIGHT
    assert ax.figure.get_facecolor() == mpl.colors.to_rgba(DARK.surface)
    assert ax.lines[0].get_color() == DARK.series[1]
    labels = [label.get_color() for label in (*ax.get_xticklabels(), *ax.get_yticklabels())]
    assert set(labels) == {DARK.muted}


def test_the_theme_is_read_from_the_axes():
    for colour, theme in (("white", LIGHT), ("#222222", DARK), ("none", LIGHT)):
        ax = Figure().subplots()
        ax.set_facecolor(colour)
        assert theme_on(ax) is theme
    ax = Figure(facecolor="black").subplots()
    ax.set_facecolor("none")
    assert theme_on(ax) is DARK


def test_a_name_that_is_no_theme():
    with pytest.raises(UnknownName, match="did you mean 'dark'"), drawn_in("darc"):
        pass
