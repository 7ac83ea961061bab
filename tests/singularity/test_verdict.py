from __future__ import annotations

import numpy as np
import pytest

import assur

ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def paper():
    return assur.load("zeng2019")


def _pose(paper, cos_alpha, s_alpha, w, y=0.0):
    """A pose with link 12 at an angle and C1 at a height over B1, by the geometry of chain I."""
    x = -100.0 + 180.0 * cos_alpha
    return [x, y, 30.0 + w + s_alpha * 180.0 * np.sqrt(1 - cos_alpha**2)]


def test_regular(paper):
    verdict = paper.singularity(ROW_3, "++-++")
    assert (verdict.kind, verdict.rank, verdict.freedoms) == ("regular", 14, 3)
    assert verdict.det_jp * verdict.det_jq != 0
    assert verdict.condition == pytest.approx(5.98, abs=0.01)


def test_links_9_and_10_along_y_is_parallel_and_keeps_the_rank(paper):
    """w = 0: B1, C1, C2, B2 on one line (errata E7)."""
    verdict = paper.singularity(_pose(paper, 0.1, 1, 0.0), "++-++")
    assert (verdict.kind, verdict.reduced_kind, verdict.closest) == ("parallel", "parallel", "w")
    assert (verdict.rank, verdict.condition) == (14, None)


def test_flat_parallelogram_1_lowers_the_rank_of_the_joint_graph(paper):
    """v = 0 is parallel in the reduced model and a constraint singularity of the joint graph (E7, E14)."""
    x = -100.0
    cos_beta = (x - 100.0) / 230.0
    z = 30.0 + 230.0 * np.sqrt(1 - cos_beta**2)
    verdict = paper.singularity([x, 0.0, z], "++-++")
    assert (verdict.kind, verdict.reduced_kind, verdict.closest) == ("constraint", "parallel", "v")
    assert verdict.rank == 13
    assert verdict.freedoms == 4


def test_equal_working_signs_are_self_motion_everywhere(paper):
    for mode in ("+++++", "++--+"):
        verdict = paper.singularity(ROW_3, mode)
        assert (verdict.kind, verdict.rank) == ("self_motion", 14)


def test_crossing_plane_of_opposite_angles(paper):
    """E8: for sin(alpha) sin(beta) < 0 the plane x = -D (l6 - l4)/(l6 + l4) is singular."""
    x = -100.0 * (230.0 - 180.0) / (230.0 + 180.0)
    verdict = paper.singularity([x, 0.0, 0.0], "+--++")
    assert (verdict.kind, verdict.closest, verdict.rank) == ("parallel", "sin_alpha_minus_beta", 14)
    assert paper.singularity([x + 1.0, 0.0, 0.0], "+--++").kind == "regular"


def test_out_of_reach_is_a_verdict_too(paper):
    verdict = paper.singularity([500.0, 0.0, 300.0])
    assert verdict.kind == "unreachable"
    assert verdict.condition is None


def test_a_five_bar_in_one_line_loses_rank():
    """g = l1: at x = l2 all five joints lie on the X axis and B1 on B2; of the two kinds self-motion is told."""
    narrow = assur.load("fivebar", g=100.0)
    verdict = narrow.singularity([194.0, 0.0], "++")
    assert (verdict.kind, verdict.reduced_kind) == ("self_motion", "comprehensive")
    assert (verdict.rank, verdict.generic_rank) == (2, 3)
