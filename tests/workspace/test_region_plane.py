"""A plane workspace: the five-bar's is where two rings meet, known by quadrature."""

import json
from math import pi

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.workspace.region import workspace

MECHANISM = assur.load("fivebar")
WIDE = [(-330.0, 330.0), (-320.0, 320.0)]


def ring_interval(p, x, centre, radius):
    return np.sqrt(np.maximum(radius**2 - (x - centre) ** 2, 0.0))


def width_of_meeting_rings(x, n=40_001):
    """Length of the y that both legs reach at x: |l2 - l1| <= distance from each motor <= l1 + l2."""
    p = MECHANISM.values
    outer = [ring_interval(p, x, centre, p.l1 + p.l2) for centre in (-p.g, p.g)]
    inner = [ring_interval(p, x, centre, abs(p.l2 - p.l1)) for centre in (-p.g, p.g)]
    return 2 * np.maximum(np.minimum(*outer) - np.maximum(*inner), 0.0)


@pytest.fixture(scope="module")
def wide():
    return workspace(MECHANISM, "-+", WIDE, resolution=96, sections=[0.0, 150.0])


def test_the_area_is_that_of_quadrature(wide):
    x = np.linspace(*WIDE[0], 400_001)
    exact = np.trapezoid(width_of_meeting_rings(x), x)
    assert abs(wide.volume - exact) < wide.volume_error < 0.005 * exact
    assert wide.unit == "mm^2"


def test_the_error_falls_with_the_square_of_the_step():
    x = np.linspace(*WIDE[0], 400_001)
    exact = np.trapezoid(width_of_meeting_rings(x), x)
    errors = [abs(workspace(MECHANISM, "-+", WIDE, resolution=n, near=300).volume - exact) for n in (20, 80)]
    assert 8 < errors[0] / errors[1] < 32


def test_sections_are_intervals(wide):
    p = MECHANISM.values
    middle, high = wide.sections
    outer = p.l1 + p.l2 - p.g
    # at y = 0 the rings leave the outside of the two inner circles: none of |x| < g + (l2 - l1) = 164
    inner = abs(p.l2 - p.l1) + p.g
    assert middle.area == pytest.approx(2 * (outer - inner), rel=1e-3)
    assert sorted(np.ravel(middle.polygons)) == pytest.approx([-outer, -inner, inner, outer], rel=1e-3)
    assert middle.plane == ("x",)
    half = np.sqrt((p.l1 + p.l2) ** 2 - 150.0**2) - p.g
    assert high.area == pytest.approx(2 * half, rel=1e-3)


def test_a_cut_along_the_other_axis(wide):
    found = wide.section(0.0, "x")
    assert found.plane == ("y",)
    assert found.area == pytest.approx(float(width_of_meeting_rings(np.array(0.0))), rel=1e-3)
    assert len(found.polygons) == 2


def test_the_outline_is_its_projection_on_its_own_plane(wide):
    found = wide.projection("x", "y")
    assert found.area == pytest.approx(wide.volume, rel=1e-9)
    assert len(found.polygons) == 2  # one outline, one hole
    with pytest.raises(UsageError, match="two different coordinates"):
        wide.projection("x")


def test_the_mesh_is_a_triangulation_of_the_area_seen_from_above(wide):
    a, b, c = (wide.vertices[wide.faces[:, k]] for k in range(3))
    assert wide.vertices.shape[1] == 2
    signed = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert np.all(signed >= -1e-9)
    assert np.sum(signed) == pytest.approx(wide.volume, rel=1e-9)


@pytest.mark.parametrize("mode", ["++", "+-", "-+", "--"])
def test_rods_fold_onto_each_other_on_arcs_of_known_length(mode):
    """sin(rods) = 0 where B1 = B2 (the rods are too long to stretch): P is on a circle about B1, in the right mode."""
    p = MECHANISM.values
    assert 2 * p.g + 2 * p.l1 < 2 * p.l2
    turn = (np.arange(40_000) + 0.5) * 2 * pi / 40_000
    wanted = np.array([1 if sign == "+" else -1 for sign in mode])
    length = 0.0
    for height in (np.sqrt(p.l1**2 - p.g**2), -np.sqrt(p.l1**2 - p.g**2)):
        rod = np.stack([np.cos(turn), np.sin(turn)])
        cranks = [np.array([p.g, height]) / p.l1, np.array([-p.g, height]) / p.l1]
        signs = np.array([np.sign(crank[0] * rod[1] - crank[1] * rod[0]) for crank in cranks])
        length += np.mean(np.all(signs == wanted[:, None], axis=0)) * 2 * pi * p.l2
    found = workspace(MECHANISM, mode, WIDE, resolution=120)
    (locus,) = found.loci
    # an arc ends where it touches the outer circle; facets that are off by their sagitta move that point along it
    step = np.max(found.region.grid.step)
    sagitta = step**2 / (8 * (p.l1 + p.l2))
    slip = np.sqrt(2 * sagitta / (1 / p.l2 - 1 / (p.l1 + p.l2)))
    assert slip < 0.01 * length
    assert locus.area == pytest.approx(length, abs=4 * slip)
    assert found.share > 0.0
    segments = locus.vertices[locus.faces]
    assert np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum() == pytest.approx(locus.area, rel=1e-6)


def test_the_json_has_the_last_coordinate_as_key(wide):
    found = json.loads(json.dumps(wide.to_json(), allow_nan=False))
    assert [list(item) for item in found["sections"]] == [["y", "area", "area_error"]] * 2
    assert found["box"] == [list(pair) for pair in WIDE]
