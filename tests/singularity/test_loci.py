"""Parallel loci of Zeng et al. 2019 against the curves that they are in the (x, z) plane."""

import numpy as np
import pytest

import assur
from assur.kinematics.modes import all_modes
from assur.singularity.loci import parallel_loci, rim_area
from assur.workspace.region import workspace
from catalogue import each

MECHANISM = assur.load("zeng2019")
P = MECHANISM.values
WIDTH = P.b - P.d


def areas(mode, **options):
    return {locus.factor: locus for locus in workspace(MECHANISM, mode, resolution=32, near=300.0, **options).loci}


def length_in_box(signs, height, n=400_000):
    """Length of the curve z = height(x) in the box, where both |w| <= l2 and |v| <= l6 hold."""
    x = P.l4 - WIDTH - 190.0 * (np.arange(n + 1) / n) ** 2
    c1 = P.l1 + signs[0] * np.sqrt(np.maximum(P.l4**2 - (x + WIDTH) ** 2, 0))
    c3 = P.l1 + P.l7 + P.l8 + signs[1] * np.sqrt(np.maximum(P.l6**2 - (x - WIDTH) ** 2, 0))
    z = height(c1, c3)
    keep = (z >= 180) & (z <= 480) & (np.abs(z - c1) <= P.l2) & (np.abs(z - c3) <= P.l6)
    both = keep[1:] & keep[:-1]
    return np.sum(np.hypot(np.diff(x), np.diff(z))[both])


def test_two_surfaces_cross_the_paper_s_box_in_the_built_mode():
    # E7: the paper's case (ii) misses both
    found = areas("++-++")
    assert found["w"].area == pytest.approx(500 * length_in_box((1, 1), lambda c1, _: c1), rel=1e-3)
    assert found["v"].area == pytest.approx(500 * length_in_box((1, 1), lambda _, c3: c3), rel=1e-3)
    assert found["w"].area > 50_000
    assert found["v"].area > 80_000


def test_a_factor_that_vanishes_on_the_boundary_only_has_no_surface():
    # u1 - u2 = -2 sqrt(M12) in this mode: zero where links 9 and 10 stand upright, the edge of the region
    found = areas("++-++", box={"z": (-400, 600)})
    assert found["u1_minus_u2"].area == 0.0
    assert not found["u1_minus_u2"].everywhere
    assert len(found["u1_minus_u2"].faces) == 0


@pytest.mark.parametrize("mode", ["++--+", "+++++", "--++-"])
def test_a_mode_with_u1_equal_to_u2_is_singular_everywhere(mode):
    # E6: the platform has a self-motion at each of its poses
    found = workspace(MECHANISM, mode, {"z": (-100, 480)}, resolution=16)
    assert [locus.factor for locus in found.loci if locus.everywhere] == ["u1_minus_u2"]
    assert found.share == 1.0
    assert found.to_json()["parallel_singular"]["factors"]["u1_minus_u2"] == {
        "meaning": found.loci[0].meaning, "area": None, "area_error": None, "faces": 0, "everywhere": True,
    }  # fmt: skip


def test_an_empty_region_is_singular_nowhere():
    # the mode reaches poses below the box only, some of them in its spare cell
    found = workspace(MECHANISM, "+-+++", resolution=32)
    assert found.volume == 0.0
    assert np.any(found.region.inside)
    assert not any(locus.everywhere or locus.area for locus in found.loci)


@pytest.mark.parametrize("mode", ["+--++", "-+-++", "+-+-+"])
def test_a_whole_plane_is_singular_where_the_sines_differ_in_sign(mode):
    # E8: alpha - beta = +-pi on x = -D (l6 - l4)/(l6 + l4)
    plane = -WIDTH * (P.l6 - P.l4) / (P.l6 + P.l4)
    signs = [1 if sign == "+" else -1 for sign in mode]
    found = areas(mode, box={"z": (-300, 480)})["sin_alpha_minus_beta"]
    np.testing.assert_allclose(found.vertices[:, 0], plane, atol=1e-5)
    c1 = P.l1 + signs[0] * np.sqrt(P.l4**2 - (plane + WIDTH) ** 2)
    c3 = P.l1 + signs[1] * np.sqrt(P.l6**2 - (plane - WIDTH) ** 2)
    span = min(480, c1 + P.l2, c3 + P.l6) - max(-300, c1 - P.l2, c3 - P.l6)
    assert span > 100
    assert found.area == pytest.approx(500 * span, rel=2e-3)


def test_no_parallel_singularity_of_that_kind_where_the_sines_agree():
    for mode in ("++-++", "---++"):
        assert areas(mode, box={"z": (-400, 480)})["sin_alpha_minus_beta"].area == 0.0


@pytest.mark.parametrize(("mode", "factors"), [("++-++", ["w", "v"]), ("+--++", ["sin_alpha_minus_beta"])])
def test_the_verdict_on_a_surface_is_singular_by_that_factor(mode, factors):
    found = workspace(MECHANISM, mode, {"z": (-300, 480)}, resolution=24)
    assert [locus.factor for locus in found.loci if locus.area > 0] == factors
    for locus in found.loci:
        if locus.area == 0:
            continue
        inner = MECHANISM.inverse(locus.vertices, mode=mode).factors[locus.factor][:, 0]
        best = locus.vertices[np.nanargmin(np.abs(inner))]
        verdict = MECHANISM.singularity(best, mode)
        assert verdict.closest == locus.factor
        assert verdict.reduced_kind == "parallel" or verdict.near
        assert verdict.condition is None or verdict.condition > 1e5


def test_most_vertices_are_exactly_singular():
    for locus in areas("++-++").values():
        if len(locus.faces):
            relative = np.abs(MECHANISM.inverse(locus.vertices, mode="++-++").factors[locus.factor][:, 0]) / P.l2
            assert np.mean(relative < 1e-6) > 0.7  # the others are where facets are cut by the boundary
            assert np.nanmax(relative) < 1e-3


@pytest.mark.parametrize("name", each())
def test_every_mechanism_and_mode_has_one_locus_per_parallel_factor(name):
    mechanism = assur.load(name)
    wanted = [item.name for item in mechanism.closed_form.factor_list if item.kind == "parallel"]
    for mode in all_modes(mechanism, "inverse")[:4]:
        found = workspace(mechanism, mode, resolution=8)
        assert [locus.factor for locus in parallel_loci(mechanism, found.region)] == wanted
        assert all(locus.meaning for locus in found.loci)


def test_the_rim_is_what_has_an_edge_of_its_own():
    """A fan of six triangles is all rim; a ring around it makes it inside. Of a path of segments both ends are rim."""
    angles = np.arange(6) * np.pi / 3
    inner, outer = (size * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1) for size in (1.0, 2.0))
    vertices = np.concatenate([np.zeros((1, 3)), inner, outer])
    around = [(k, k % 6 + 1) for k in range(1, 7)]
    fan = np.array([(0, a, b) for a, b in around])
    ring = np.array([face for a, b in around for face in ((a, b, a + 6), (b, b + 6, a + 6))])
    hexagon = 6 * np.sqrt(3) / 4
    assert rim_area(vertices, fan) == pytest.approx(hexagon)
    outside = [face for face in ring.tolist() if max(face) > 6 and sum(k > 6 for k in face) == 2]
    both = np.concatenate([fan, ring])
    assert rim_area(vertices, both) == pytest.approx(rim_area(vertices, np.array(outside)))
    assert rim_area(vertices, both) < 3 * hexagon
    path = np.array([[0, 1], [1, 2], [2, 3]])
    assert rim_area(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 5.0], [1.0, 7.0]]), path) == pytest.approx(3.0)
    assert rim_area(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64)) == 0.0
