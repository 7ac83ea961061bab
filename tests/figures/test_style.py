"""Colours that must be told apart are, by readers with normal and with each kind of dichromatic vision."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib import colormaps
from matplotlib.colors import to_hex

from assur.figures import configuration, plane_map, plots, sections, sketch, style
from assur.scene import part
from assur.scene.mesh import rgb

VISION = {
    "normal": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""Linear RGB as it is seen: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, IEEE TVCG 15 (2009) 1291, severity 1."""

XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
APART = 14.0
"""CIE 1976 difference; from about 2.3 up two colours side by side are told apart, so this is six times as much."""


def lab(colour, vision):
    """CIE L*a*b* of "#rrggbb" as it is seen."""
    screen = rgb(colour)
    linear = np.where(screen <= 0.04045, screen / 12.92, ((screen + 0.055) / 1.055) ** 2.4)
    x, y, z = XYZ @ np.clip(np.asarray(VISION[vision]) @ linear, 0.0, 1.0) / (XYZ @ np.ones(3))
    x, y, z = (np.cbrt(v) if v > (6 / 29) ** 3 else v / (3 * (6 / 29) ** 2) + 4 / 29 for v in (x, y, z))
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def difference(one, two, vision):
    return float(np.linalg.norm(lab(one, vision) - lab(two, vision)))


def closest(colours, vision):
    return min((difference(one, two, vision), one, two) for one, two in combinations(colours, 2))


IN_GREY = 10.0
"""Least difference of lightness: what is left of colours on a printer without them."""


@pytest.mark.parametrize(
    "colours",
    [
        pytest.param(style.SERIES[:4], id="series"),
        pytest.param(sketch.CHAINS[:4], id="chains"),
        pytest.param(plots.LOCI[:4], id="loci"),
        pytest.param((plots.FREE, plots.CLOSE), id="areas"),
        pytest.param(sections.BORDERS, id="borders"),
    ],
)
def test_colours_stay_apart_in_grey(colours):
    """The first four; what is drawn in more colours has dashes, hatches or numbers besides."""
    lightness = [lab(colour, "normal")[0] for colour in colours]
    assert min(abs(one - two) for one, two in combinations(lightness, 2)) >= IN_GREY


def test_the_colours_of_maps_grow_lighter_all_along():
    steps = [lab(to_hex(colour), "normal")[0] for colour in colormaps[plane_map.COLOURS](np.linspace(0, 1, 33))]
    assert min(np.diff(steps)) > 1.0


@pytest.mark.parametrize("vision", VISION)
@pytest.mark.parametrize(
    "colours",
    [
        pytest.param(style.SERIES, id="series"),
        pytest.param(sketch.CHAINS, id="chains"),
        pytest.param(plots.LOCI, id="loci"),
        pytest.param(sections.BORDERS, id="borders"),
        *(
            pytest.param((*part.LINKS, part.DRIVE, part.STAGE, grey), id=f"parts-{grey}")
            for grey in (part.STEEL, part.DARK, part.PLATE)
        ),
        pytest.param((configuration.ACCENT, configuration.MUTED, part.DRIVE, part.DARK), id="accents"),
    ],
)
def test_colours_stay_apart(colours, vision):
    assert closest(colours, vision)[0] >= APART


def test_a_limb_has_one_colour_in_sketches_and_as_solids():
    def nearest(drawn):
        return min(part.LINKS, key=lambda solid: difference(drawn, solid, "normal"))

    assert tuple(map(nearest, sketch.CHAINS)) == part.LINKS


def test_the_measure_itself():
    np.testing.assert_allclose(lab("#ffffff", "normal"), [100, 0, 0], atol=0.02)
    np.testing.assert_allclose(lab("#ff0000", "normal"), [53.24, 80.09, 67.20], atol=0.05)  # of sRGB red, tabulated
    for vision in VISION:  # greys are greys for everyone
        np.testing.assert_allclose(lab("#808080", vision), lab("#808080", "normal"), atol=0.1)
    # a pair that readers with normal vision alone tell apart
    assert difference("#c98bb0", "#9aa3ab", "normal") > 30
    assert difference("#c98bb0", "#9aa3ab", "deuteranopia") < 3
