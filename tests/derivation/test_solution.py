"""Towers of square roots: as many branches as the hand-written forms have, each of which closes every loop exactly."""

import random
from dataclasses import replace
from operator import ge

import pytest
import sympy

from assur.derivation.linear import value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import analytic_solution
from assur.model.registry import load_record

BRANCHES = {
    "zeng2019": (8, 32), "fivebar": (2, 4), "orthoglide": (2, 8), "tripteron": (8, 8), "linear_delta_4r": (2, 8),
    "delta_4s": (2, 8), "tsai_platform": (2, 8), "three_p2us": (2, 8), "linear_delta_4s": (2, 8), "three_crr": (8, 8),
}  # fmt: skip
"""Of the direct and the inverse problem."""
POLYNOMIALS = (("planar_3rrr", 6, "platform"), ("three_rrc", 8, "leg2_rod"), ("planar_3rpr", 6, "platform"))
"""Degree, and the link in whose angle it is."""
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


def of_its_own(name):
    """A direct solution that a test may spoil: of a record that no other test has."""
    return analytic_solution(replace(load_record(name)), "direct")


def test_a_root_with_the_other_sign_everywhere_would_not_be_noticed_but_a_wrong_formula_is():
    solution = of_its_own("fivebar")
    wrong = solution.sets[0].definitions[-1]
    object.__setattr__(wrong, "formula", wrong.formula * 2)
    assert not solution.closes()


def test_a_coupled_set_ends_in_one_polynomial_whose_roots_close_every_loop():
    for name, degree, unknown in POLYNOMIALS:
        solution = analytic_solution(load_record(name), "direct")
        assert (solution.branches, solution.eliminant.degree) == (degree, degree)
        assert solution.eliminant.direction.name == unknown
        assert solution.closes()
        assert solution.group.insoluble


def test_a_wrong_coefficient_of_a_polynomial_is_noticed():
    solution = of_its_own("three_rrc")
    wrong = solution.eliminant.known[-1]
    object.__setattr__(wrong, "formula", wrong.formula * 2)
    assert not solution.closes()


@pytest.mark.parametrize("name", [name for name, _, _ in POLYNOMIALS])
def test_the_degree_is_the_number_of_solutions_of_the_loop_equations_modulo_a_prime(name):
    """Counted by a Groebner basis of the loop equations: another way than by elimination."""
    solution = analytic_solution(load_record(name), "direct")
    equations = [value_of(form) for form in solution.sets[0].equations]
    equations += [direction.quadric for direction in solution.sets[0].directions]
    for own in reversed(solution.eliminant.known):
        equations = [equation.subs(own.symbol, own.formula) for equation in equations]
    unknowns = [unknown for direction in solution.sets[0].directions for unknown in direction.unknowns]
    prime, field = 32003, random.Random(5)
    left = sorted({symbol for equation in equations for symbol in equation.free_symbols} - {*unknowns}, key=str)
    drawn = {symbol: field.randrange(1, prime) for symbol in left}
    drawn[sympy.sqrt(3)] = next(k for k in range(prime) if k * k % prime == 3)
    basis = sympy.groebner([equation.subs(drawn) for equation in equations], *unknowns, modulus=prime, order="grevlex")
    leading = [sympy.Poly(part, *unknowns).monoms("grevlex")[0] for part in basis.exprs]
    assert _below(leading) == solution.branches


def _below(leading):
    """How many monomials none of these divides."""
    count, waiting = 0, {(0,) * len(leading[0])}
    while waiting:
        free = {own for own in waiting if not any(all(map(ge, own, lead)) for lead in leading)}
        count += len(free)
        waiting = {(*own[:k], own[k] + 1, *own[k + 1 :]) for own in free for k in range(len(own))}
    return count


def test_links_that_belong_together_are_named_and_not_solved():
    with pytest.raises(NotDerivedError, match="platform turns in space, held by B1"):
        analytic_solution(load_record("gough_stewart"), "direct")
