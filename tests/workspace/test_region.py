"""The workspace of Zeng et al. 2019 against quadrature of the circles that bound it, and against sampling.

Written from the geometry, not from the kernel: C1 and D3 reach a height w = z - l1 - l4 sin(alpha) with |w| <= l2
and v = z - l1 - l7 - l8 - l6 sin(beta) with |v| <= l6, where x = l4 cos(alpha) - D = l6 cos(beta) + D.
"""

import json
from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.modes import all_modes
from assur.workspace.region import workspace

MECHANISM = assur.load("zeng2019")
STROKES = {"yA1": (-200.0, 380.0), "yA2": (-360.0, 200.0), "yA3": (-250.0, 150.0)}


def heights(p, signs, x, z):
    """w and v at (x, z), and whether D1D2 and D3E3 reach x."""
    width = p.b - p.d
    n_alpha, n_beta = p.l4**2 - (x + width) ** 2, p.l6**2 - (x - width) ** 2
    w = z - p.l1 - signs[0] * np.sqrt(np.maximum(n_alpha, 0))
    v = z - p.l1 - p.l7 - p.l8 - signs[1] * np.sqrt(np.maximum(n_beta, 0))
    return w, v, (n_alpha >= 0) & (n_beta >= 0)


def extents(p, signs, x, z, low, high, strokes=None):
    """Length of the interval of y at (x, z): that of the box, cut by the strokes."""
    w, v, reached = heights(p, signs, x, z)
    reached = reached & (np.abs(w) <= p.l2) & (np.abs(v) <= p.l6)
    u12, u3 = np.sqrt(np.maximum(p.l2**2 - w**2, 0)), np.sqrt(np.maximum(p.l6**2 - v**2, 0))
    # y - q for each slider
    gaps = (signs[2] * u12 - p.l3 / 2, signs[3] * u12 + p.l3 / 2, signs[4] * u3)
    bottom, top = np.full_like(w, low), np.full_like(w, high)
    for gap, name in zip(gaps, ("yA1", "yA2", "yA3"), strict=True):
        if strokes and name in strokes:
            bottom = np.maximum(bottom, strokes[name][0] + gap)
            top = np.minimum(top, strokes[name][1] + gap)
    return np.where(reached, np.maximum(top - bottom, 0.0), 0.0)


def quadrature(mechanism, mode, box, strokes=None, n=1200):
    """Volume by the midpoint rule in x and z and the exact interval of y."""
    (x0, x1), (y0, y1), (z0, z1) = box
    p, signs = mechanism.values, [1 if sign == "+" else -1 for sign in mode]
    x = x0 + (x1 - x0) * (np.arange(n) + 0.5) / n
    z = z0 + (z1 - z0) * (np.arange(n) + 0.5) / n
    lengths = extents(p, signs, x[:, None], z[None, :], y0, y1, strokes)
    return float(np.mean(lengths) * (x1 - x0) * (z1 - z0))


def area_at(mechanism, mode, box, z, strokes=None, n=200_000):
    """Area of a section by the midpoint rule in x."""
    (x0, x1), (y0, y1), _ = box
    signs = [1 if sign == "+" else -1 for sign in mode]
    x = x0 + (x1 - x0) * (np.arange(n) + 0.5) / n
    return float(np.mean(extents(mechanism.values, signs, x, np.full(n, z), y0, y1, strokes)) * (x1 - x0))


@pytest.fixture(scope="module")
def built():
    return workspace(MECHANISM)


@pytest.fixture(scope="module")
def stroked():
    return workspace(MECHANISM, strokes=STROKES, near=300.0)


def test_the_volume_is_that_of_quadrature_within_its_stated_error(built):
    exact = quadrature(MECHANISM, built.mode, built.box.intervals, n=2000)
    assert abs(built.volume - exact) < built.volume_error
    assert built.volume_error < 0.005 * exact
    assert built.unit == "mm^3"
    assert built.mode == "++-++"


def test_the_volume_is_500_mm_times_a_closed_area(built):
    # the interval of z at each x in closed form, then Gauss-Legendre in s with x = 80 - s^2
    p, (low, high) = MECHANISM.values, built.box.intervals[2]
    edge = p.l4 - (p.b - p.d)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    end = np.sqrt(edge - built.box.low[0])
    s = end * (nodes + 1) / 2
    x = edge - s**2
    alpha, beta = p.l4**2 - (x + p.b - p.d) ** 2, p.l6**2 - (x - p.b + p.d) ** 2
    a, b = p.l1 + np.sqrt(alpha), p.l1 + p.l7 + p.l8 + np.sqrt(beta)
    top = np.minimum(high, np.minimum(a + p.l2, b + p.l6))
    bottom = np.maximum(low, np.maximum(a - p.l2, b - p.l6))
    area = np.sum(weights * np.maximum(top - bottom, 0) * 2 * s) * end / 2
    assert abs(built.volume - 500 * area) < built.volume_error
    assert abs(built.projection("x", "z").area - area) < 2e-4 * area


def test_the_error_falls_with_the_square_of_the_step_and_is_never_understated():
    exact = quadrature(MECHANISM, "++-++", [list(MECHANISM.box[name]) for name in "xyz"], n=2000)
    found = [workspace(MECHANISM, resolution=n, near=300) for n in (12, 24, 48)]
    errors = [abs(item.volume - exact) for item in found]
    assert all(error < item.volume_error < 10 * error for error, item in zip(errors, found, strict=True))
    assert 2.5 < errors[0] / errors[1] < 6
    assert 2.5 < errors[1] / errors[2] < 6


@pytest.mark.parametrize("z", [300.0, 350.0, 400.0, 450.0])
def test_sections_have_the_area_of_quadrature(built, stroked, z):
    for found, strokes in ((built, None), (stroked, STROKES)):
        exact = area_at(MECHANISM, found.mode, found.box.intervals, z, strokes)
        (section,) = [item for item in found.sections if item.value == z]
        assert section.area == pytest.approx(exact, rel=1e-3)
        rings = [p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1) for p in section.polygons]
        assert sum(np.sum(ring) / 2 for ring in rings) == pytest.approx(section.area, rel=1e-9)


def test_strokes_cut_the_volume_down_to_that_of_quadrature(built, stroked):
    exact = quadrature(MECHANISM, "++-++", stroked.box.intervals, STROKES)
    assert exact < 0.6 * built.volume  # the strokes do bite
    assert abs(stroked.volume - exact) < stroked.volume_error < 0.005 * exact


def test_a_stroke_in_the_file_counts_until_it_is_taken_away(built):
    inputs = tuple(replace(item, stroke=STROKES[item.name]) for item in MECHANISM.inputs)
    with_strokes = replace(MECHANISM, inputs=inputs)
    options = {"resolution": 16, "near": 300.0}
    assert workspace(with_strokes, **options).volume < 0.6 * built.volume
    free = workspace(with_strokes, strokes=dict.fromkeys(STROKES), **options)
    assert free.volume == workspace(MECHANISM, **options).volume


def test_wide_strokes_change_nothing(built):
    wide = {"yA1": (-1e4, np.inf), "yA3": (-np.inf, 1e4)}
    assert workspace(MECHANISM, strokes=wide, near=300.0).volume == built.volume


def test_random_poses_agree_with_the_inverse_solution(stroked):
    rng = np.random.default_rng(4)
    poses = rng.uniform(stroked.box.low, stroked.box.high, size=(60_000, 3))
    found = MECHANISM.inverse(poses, mode="++-++")
    low, high = np.array([STROKES[item.name] for item in MECHANISM.inputs]).T
    with np.errstate(invalid="ignore"):
        inside = found.exists[:, 0] & np.all((found.inputs[:, 0] >= low) & (found.inputs[:, 0] <= high), axis=-1)
    size = np.prod(np.subtract(stroked.box.high, stroked.box.low))
    share, deviation = np.mean(inside), np.std(inside) / np.sqrt(len(inside))
    assert abs(share - stroked.volume / size) < 4 * deviation
    assert deviation < 0.003


OTHER = {"l7": 25.0, "l8": 10.0, "l2": 200.0, "l6": 190.0}
MODES_AND_DIMENSIONS = [
    *(("+-+-+", {}), ("--+++", {}), ("-+-++", OTHER), ("+++++", OTHER)),
    *(pytest.param(*case, marks=pytest.mark.deep)
      for case in (("-+-++", {}), ("+++++", {}), ("+-+-+", OTHER), ("--+++", OTHER))),
]  # fmt: skip
"""Each mode once in every run, two of them with other dimensions; all with both in the deep one."""


@pytest.mark.parametrize(("mode", "parameters"), MODES_AND_DIMENSIONS)
def test_other_modes_and_dimensions_agree_with_quadrature(mode, parameters):
    mechanism = assur.load("zeng2019", **parameters)
    box = [[-130.0, 80.0], [-100.0, 100.0], [-300.0, 300.0]]
    strokes = {"yA1": (-200.0, 120.0)}
    found = workspace(mechanism, mode, box, strokes, resolution=40, sections=[], near=300.0)
    exact = quadrature(mechanism, mode, box, strokes)
    assert exact > 1e5
    assert abs(found.volume - exact) < max(found.volume_error, 1e-3 * exact)
    assert found.volume_error < 0.02 * exact


def test_no_vertex_is_half_a_millimetre_off_the_boundary(stroked):
    around = 0.5 * np.array([(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)])
    points = (stroked.vertices[:, None] + around).reshape(-1, 3)
    grid = stroked.region.grid
    allowed = [np.all((points >= grid.low) & (points <= grid.high), axis=1)]
    allowed += [field(tuple(points.T)) >= 0 for field in stroked.margins.values()]
    allowed = np.array(allowed).reshape(len(allowed), -1, len(around))
    assert allowed.shape[1] > 1000
    assert np.all(np.any(allowed, axis=2))  # every limit is kept half a millimetre away or nearer
    assert np.all(np.any(~allowed, axis=(0, 2)))  # and one of them is not


def test_the_paper_s_box_reaches_past_what_link_12_reaches(built):
    # E11: x is at most l4 - (b - d) = 80, and -130..-110 is cut off by the box
    assert built.vertices[:, 0].max() == pytest.approx(80.0, abs=1e-5)
    assert built.vertices[:, 0].min() == -110.0
    wide = workspace(MECHANISM, box={"x": (-200, 200)}, resolution=32)
    assert wide.vertices[:, 0].min() == pytest.approx(-130.0, abs=1e-5)


def test_the_projections_cover_what_the_sections_cover(built):
    xoz, yoz = built.projection("x", "z"), built.projection("z", "y")
    assert xoz.plane == ("x", "z")
    assert yoz.plane == ("y", "z")
    # nothing depends on y, so the volume is the length of the box times the outline
    assert 500 * xoz.area == pytest.approx(built.volume, rel=1e-6)
    assert yoz.polygons[0].min(axis=0) == pytest.approx([-250.0, 180.0])
    heights_of_box = built.vertices[:, 2].max() - 180.0
    assert yoz.area == pytest.approx(500 * heights_of_box, rel=1e-6)


def test_cuts_across_other_axes(built):
    assert built.section(0.0, "y").plane == ("x", "z")
    assert built.section(0.0, "y").area == pytest.approx(built.volume / 500, rel=1e-6)
    assert built.section(85.0, "x").area == 0.0  # inside the box, outside of the reach
    with pytest.raises(UsageError, match=r"outside the box \[180, 480\]"):
        built.section(500.0)
    with pytest.raises(UnknownNameError, match="there is: x, y, z"):
        built.section(0.0, "w")
    with pytest.raises(UsageError, match="two different coordinates"):
        built.projection("x", "x")


def test_a_box_that_no_pose_reaches_gives_an_empty_workspace():
    found = workspace(MECHANISM, box={"x": (200, 300)}, strokes=STROKES)
    assert found.volume == 0.0
    assert found.volume_error == 0.0
    assert found.share is None
    assert found.vertices.shape == (0, 3)
    assert [item.area for item in found.sections] == [0.0] * 4
    assert found.projection("x", "z").area == 0.0
    assert json.loads(json.dumps(found.to_json(), allow_nan=False))["parallel_singular"]["share"] is None


def test_a_box_that_is_reached_throughout_is_its_own_workspace():
    found = workspace(MECHANISM, box=[(-20, 0), (-10, 10), (400, 420)], sections=[400, 420], resolution=8)
    assert found.volume == pytest.approx(20**3, rel=1e-12)
    assert found.volume_error == pytest.approx(0.0, abs=1e-9)
    assert [item.area for item in found.sections] == pytest.approx([400.0, 400.0])


def test_default_sections_are_those_of_the_file_inside_the_box():
    found = workspace(MECHANISM, box={"z": (340, 420)}, resolution=8)
    assert [item.value for item in found.sections] == [350.0, 400.0]


def test_the_json_has_its_stated_shape(built):
    found = json.loads(json.dumps(built.to_json(), allow_nan=False))
    assert list(found) == [
        "volume",
        "volume_error",
        "unit",
        "mode",
        "how",
        "coordinates",
        "box",
        "held",
        "parallel_singular",
        "sections",
    ]
    assert found["box"] == [[-110.0, 90.0], [-250.0, 250.0], [180.0, 480.0]]
    assert [list(item) for item in found["sections"]] == [["z", "area", "area_error"]] * 4
    assert list(found["parallel_singular"]) == ["factors", "near", "share"]
    assert found["parallel_singular"]["near"] == 10.0
    assert found["how"] == "closed form"


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"box": {"z": (480, 180)}}, "turned round"),
        ({"strokes": {"yA1": (300, -300)}}, "turned round"),
        ({"strokes": {"yA1": (np.nan, 300)}}, "turned round or empty"),
        ({"strokes": {"yA1": 300}}, "is not"),
        ({"strokes": {"yA4": (0, 1)}}, "there is: yA1, yA2, yA3"),
        ({"mode": "++0++"}, r"there is: \+\+\+\+\+"),
        ({"mode": "+++"}, "s_alpha, s_beta, u1, u2, u3"),
        ({"resolution": 3}, "at least 4"),
        ({"resolution": 0}, "2 to 400"),
        ({"near": -1.0}, "positive distance"),
        ({"near": np.inf}, "positive distance"),
        ({"near": "10"}, "positive distance"),
        ({"sections": ["300"], "resolution": 8}, "not a number"),
        ({"sections": [100.0], "resolution": 8}, "outside the box"),
    ],
)
def test_misuse_is_refused_and_says_what_is_allowed(options, says):
    with pytest.raises(UsageError, match=says):
        workspace(MECHANISM, **options)


def test_progress_counts_up_to_its_total():
    seen = []
    workspace(MECHANISM, resolution=8, progress=lambda done, total: seen.append((done, total)))
    assert [done for done, _ in seen] == list(range(1, len(seen) + 1))
    assert {total for _, total in seen} == {len(seen)}


def test_it_takes_the_default_mode_of_the_file(built):
    assert built.mode == MECHANISM.modes.default_working
    assert built.mode in all_modes(MECHANISM, "inverse")
