import random

import numpy as np
import pytest

from assur.model.topologies import load_topology
from assur.synthesis.following_limbs import classes_by_constraints, following_limbs, following_types, wrenches
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis
from assur.synthesis.virtual_chains import rows_named
from assur.topology.notation import plain_text
from mobility_oracle import outcomes

(ABOUT_A_POINT,) = rows_named("3R")


@pytest.fixture(scope="module")
def about_a_point():
    """Three equal limbs that turn the platform about a point."""
    return synthesis(question("3R", symmetric=True))


@pytest.fixture(scope="module")
def wrist_limbs():
    """Limbs that turn about a point, of three joints."""
    return following_limbs(ABOUT_A_POINT, following_types(ABOUT_A_POINT, 3, "any"), 2)


def oracle_says(texts, number):
    """What the oracle meets most around home: F, t, r, dim."""
    met = {seen: count for seen, count in outcomes(texts, number, 4).items() if seen.real}
    best = max(met, key=met.get)
    return best.freedoms, best.t, best.r, best.dim


def test_the_agile_eye_is_found_with_what_the_catalogue_declares(about_a_point):
    (design,) = (design for design in about_a_point.designs if design.names)
    assert design.names == ("agile_eye",)
    declared = load_topology("agile_eye").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert (design.redundant.collapsed, design.redundant.joint_graph) == declared.redundant_constraints


def test_limbs_of_the_wrist_with_upu_are_among_those_driven_inside():
    """R and R of each U turn about parallel axes in its middle, the outer ones meet in the point."""
    texts = {plain_text(limb.chain) for limb in following_types(ABOUT_A_POINT, 3, "leg")}
    assert any(text.startswith("U[x@O,") and text.endswith("@O]") for text in texts)


def test_an_axis_runs_through_the_point_only_where_it_must():
    """Of a planar group none does, whatever else stands beside it."""
    for limb in following_types(ABOUT_A_POINT, 5, "base"):
        if limb.freedoms == 5 and len(limb.chain.joints) == 5:
            assert sum(bool(joint.point) for joint in limb.chain.joints) == 2, plain_text(limb.chain)


def test_each_limb_resists_a_force_through_the_point_alone(wrist_limbs):
    """The reciprocal of all rotations about a point are forces through it: no moment there."""
    assert wrist_limbs
    for limb in wrist_limbs:
        for place in range(len(limb.edges)):
            assert np.allclose(wrenches(limb, place)[:, :3], 0.0, atol=1e-8), limb.text


def test_a_ball_joint_elsewhere_makes_limbs_of_the_wrist():
    """The force through the point and the centre of the ball is all that R R S resists, in any order of its joints."""
    texts = {plain_text(limb.chain) for limb in following_types(ABOUT_A_POINT, 3, "base")}
    assert {"R[x]@O R[y]@O S", "R[x]@O S R[y]@O"} <= texts
    assert not {plain_text(limb.chain) for limb in following_types(rows_named("1T2R:UP")[0], 3, "any")} & texts


def test_limbs_of_a_class_resist_the_same(wrist_limbs):
    for members in classes_by_constraints(wrist_limbs, ABOUT_A_POINT):
        first = wrenches(members[0], 0)
        if len({limb.text for limb in members}) == 1:  # what it resists depends on lengths: it is alone with its drives
            continue
        for limb in members:
            together = np.concatenate([first, wrenches(limb, 0)], axis=-1)
            assert np.linalg.matrix_rank(together, tol=1e-6).max() == 6 - limb.type.freedoms


def confirmed_by_the_oracle(design, row, number):
    """The mechanism moves as the virtual chain does: with it as one limb more it has the same freedoms."""
    texts = [chain.text for chain in design.chains]
    alone, beside = oracle_says(texts, number), oracle_says([*texts, row.text], number)
    assert alone[0] == beside[0] == row.dim, texts
    assert alone[1:] == beside[1:], texts


def test_the_oracle_of_finite_motion_confirms_some_mechanisms(about_a_point):
    for number, design in enumerate(random.Random(2).sample(about_a_point.designs, 2)):
        confirmed_by_the_oracle(design, ABOUT_A_POINT, number)


@pytest.mark.deep
@pytest.mark.parametrize(
    "motion", ["2R", "3R", "1T1R", "2T1R:PPR", "1T2R:PU", "1T2R:UP", "1T2R:RPR", "3T1R:PPPR", "3T2R"]
)
def test_the_oracle_of_finite_motion_confirms_families_of_every_motion(motion):
    found = synthesis(
        question(motion, members=1, symmetric=motion == "3T1R:PPPR")
    )  # of different limbs there are 1.9 million
    families = random.Random(7).sample(found.families, min(8, len(found.families)))
    rows = {row.row: row for row in rows_named(motion)}
    for number, family in enumerate(families):
        confirmed_by_the_oracle(family.designs[0], rows[family.designs[0].row], number)


def test_an_idle_joint_takes_redundant_constraints_away():
    """Three limbs PRRR with parallel R have three redundant constraints; with an R across that stays at rest none."""
    (row,) = rows_named("3T")
    without, within = (
        {plain_text(limb.chain): limb for limb in following_types(row, 5, "base", idle=idle)} for idle in (False, True)
    )
    more = [limb for text, limb in within.items() if text not in without]
    assert more
    assert not set(without) - set(within)
    assert {limb.freedoms for limb in more} >= {5}


def test_any_one_joint_may_be_driven():
    places = {limb.driven for limb in following_types(ABOUT_A_POINT, 3, "any")}
    assert {(0,), (1,), (2,)} <= places
