import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.closure import assemble
from assur.singularity.examples import singular_examples
from assur.singularity.verdict import verdict_at

TESTS = Path(__file__).parents[1]

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


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_the_joint_graph_gives_the_same_verdict_as_the_closed_form(name):
    mechanism = assur.load(name)
    for example in singular_examples(mechanism):
        form, here = mechanism.singularity(example.pose, example.mode), verdict_at(mechanism, example.joints)
        assert (here.kind, here.near) == (form.kind, form.near), example.factor.name
        assert (here.rank, here.generic_rank, here.freedoms) == (form.rank, form.generic_rank, form.freedoms)
        if here.rank == here.generic_rank:  # else the reduced model knows less
            assert here.reduced_kind == form.reduced_kind, example.factor.name
            assert here.closest == {"parallel": "output", "serial": "input"}[here.reduced_kind]
            assert here.condition is None
        else:
            assert "IIM" in here.types


def test_a_regular_verdict_from_joint_values(paper):
    form = paper.singularity(ROW_3, "++-++")
    here = verdict_at(paper, paper.inverse(ROW_3, "++-++").joints[0])
    assert (here.kind, here.reduced_kind, here.types, here.platform_gains) == ("regular", "regular", (), False)
    assert here.condition == pytest.approx(form.condition, rel=1e-8)
    assert here.det_jp * here.det_jq * form.det_jp * form.det_jq > 0
    assert here.gap > 1e6
    assert all(0.0 < value <= 1.0 for value in here.factors.values())


def test_a_mechanism_without_closed_form():
    delta = assur.load(TESTS / "model" / "file" / "delta.toml")
    verdict = verdict_at(delta, delta.home_values)
    assert (verdict.kind, verdict.rank, verdict.generic_rank, verdict.freedoms) == ("regular", 30, 30, 3)


def test_constraint_singularity_of_a_3_upu():
    """On a cylinder of radius 2 |r - R| about z; tests/kinematics/rates/test_instantaneous.py says why."""
    upu = assur.load(TESTS / "kinematics" / "rates" / "upu.toml")
    kinds = {}
    for radius in (190.0, 200.0, 210.0):
        found = assemble(upu, upu.home_values, poses=np.array([radius, 0.0, 300.0]))
        assert np.allclose(upu.frames(found.values)["platform"][0], np.eye(3), atol=1e-7)
        kinds[radius] = verdict_at(upu, found.values)
    assert [verdict.kind for verdict in kinds.values()] == ["regular", "constraint", "regular"]
    assert [verdict.platform_gains for verdict in kinds.values()] == [False, True, False]
    assert [verdict.rank for verdict in kinds.values()] == [12, 11, 12]
    assert kinds[200.0].factors["closure"] < 1e-5


def test_joint_values_that_do_not_close_are_a_verdict_too(paper):
    verdict = verdict_at(paper, paper.home_values + 0.1)
    assert (verdict.kind, verdict.condition, verdict.rank) == ("not_closed", None, None)


def test_one_configuration_at_a_time(paper):
    with pytest.raises(assur.UsageError, match=r"not a batch of shape \(2,\)"):
        verdict_at(paper, np.array([paper.home_values, paper.home_values]))


def test_a_pose_of_a_mechanism_without_closed_form_is_searched_for_and_judged():
    five_bar = assur.load("fivebar")
    bare = dataclasses.replace(five_bar, closed_form=None)
    found = bare.singularity([10.0, 220.0], "-+")
    form = five_bar.singularity([10.0, 220.0], "-+")
    assert (found.kind, found.rank, found.freedoms) == (form.kind, form.rank, form.freedoms)
    assert found.condition == pytest.approx(form.condition, rel=1e-6)
    assert bare.singularity([1000.0, 0.0], "-+").kind == "unreachable", "its loops in turn have no real root"
