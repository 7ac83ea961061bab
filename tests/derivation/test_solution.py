"""Towers of square roots: as many branches as the hand-written forms have, each of which closes every loop exactly."""

import pytest
import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import analytic_solution
from assur.model.registry import load_record

BRANCHES = {
    "zeng2019": (8, 32), "fivebar": (2, 4), "orthoglide": (2, 8), "tripteron": (8, 8), "linear_delta_4r": (2, 8),
    "delta_4s": (2, 8), "tsai_platform": (2, 8), "three_p2us": (2, 8), "linear_delta_4s": (2, 8), "three_crr": (8, 8),
}  # fmt: skip
"""Of the direct and the inverse problem."""
QUICK = ("zeng2019", "fivebar", "orthoglide", "tripteron")


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in BRANCHES]
)
def test_every_branch_of_a_tower_closes_every_loop(name):
    record = load_record(name)
    for problem, count in zip(("direct", "inverse"), BRANCHES[name], strict=True):
        solution = analytic_solution(record, problem)
        assert solution.branches == count
        assert solution.closes()


def test_the_paper_s_order_its_special_constraint_and_its_self_motion_are_found():
    solution = analytic_solution(load_record("zeng2019"), "direct")
    sets = [{own.name for own in part.directions} for part in solution.sets]
    assert sets == [{"link9", "link10"}, {"link4a"}, {"link12", "link7a"}]
    known = {own.symbol: own.formula for own in solution.definitions}
    (condition,) = solution.sets[0].conditions
    names = sympy.symbols("yA1 l3 yA2", real=True)
    y1, length, y2 = (next((s for s in known[condition].free_symbols if s.name == own.name), own) for own in names)
    assert sympy.expand(known[condition] + y1 - length - y2) == 0  # B of Eq. (9), where the self-motion is


def test_a_root_with_the_other_sign_everywhere_would_not_be_noticed_but_a_wrong_formula_is():
    solution = analytic_solution(load_record("fivebar"), "direct")
    wrong = solution.sets[0].definitions[-1]
    object.__setattr__(wrong, "formula", wrong.formula * 2)
    assert not solution.closes()


def test_links_that_belong_together_are_named_and_not_solved():
    with pytest.raises(NotDerivedError, match="leg1_rod and platform and leg2_rod and leg3_rod belong together"):
        analytic_solution(load_record("planar_3rrr"), "direct")
