"""What holds where a condition does not: self-motions come out by themselves, and what is left is open."""

import pytest

from assur.derivation.closed_conditions import closed_conditions
from assur.derivation.solution import analytic_solution
from assur.model.registry import load_record


def cases(name, problem="direct"):
    solution = analytic_solution(load_record(name), problem)
    return {(str(own.condition), *map(str, own.vanish)): own for own in closed_conditions(solution)}


def test_the_self_motion_of_the_seed_comes_out_by_itself():
    """Links 9 and 10 turn together where yA1 - l3 - yA2 = 0, as the paper's B."""
    own = cases("zeng2019")["H1", "l3 - yA1 + yA2"]
    assert (own.outcome, own.freedoms, own.links) == ("self-motion", 1, ("link9", "link10"))
    assert {str(formula) for formula in own.formulas} == {"cos_link10 - cos_link9", "sin_link10 - sin_link9"}


def test_circles_of_one_centre_and_different_radii_do_not_meet():
    (own,) = (own for own in cases("zeng2019").values() if str(own.condition) == "N3")
    assert own.outcome == "no solution"
    assert {own.outcome for own in cases("fivebar", "inverse").values()} == {"no solution"}


def test_rods_of_one_length_turn_together_where_the_cranks_ends_meet():
    (own,) = cases("fivebar").values()
    assert (own.outcome, own.freedoms, own.links) == ("self-motion", 1, ("rod1", "rod2"))


def test_balls_whose_centres_coincide_leave_a_circle_or_a_ball():
    found = {key[1:]: (own.outcome, own.freedoms) for key, own in cases("orthoglide").items()}
    assert found["q1", "q2"] == found["q2", "q3"] == ("self-motion", 1)
    assert found["q1", "q2", "q3"] == ("self-motion", 2)


@pytest.mark.parametrize("name", ["planar_3rrr"])
def test_a_determinant_vanishes_at_no_solution_for_general_inputs(name):
    """So says the verifier too: it divides by it modulo the polynomial."""
    assert {own.outcome for own in cases(name).values()} == {"apart"}


@pytest.mark.deep
def test_legs_without_length_fix_a_platform_twice():
    """Its point is then where the leg's joint on the base is, which is one equation more than a leg of a length has."""
    found = {str(own.condition): own.outcome for own in cases("planar_3rpr").values()}
    assert found == {"rho2": "no solution", "rho3": "no solution", "det": "apart"}
