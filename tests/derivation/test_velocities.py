"""Velocity equations come out as the paper's regular form, and their determinants as its factors."""

import pytest
import sympy

from assur.derivation.solution import analytic_solution
from assur.derivation.velocities import velocity_equations
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains


def test_the_paper_s_regular_form_and_its_factors_are_derived():
    equations = velocity_equations(analytic_solution(load_record("zeng2019"), "inverse"))
    assert equations.jp[0, 0] == equations.jp[0, 2] == 0  # row 1 less row 2: u1 - u2 alone
    assert len([factor for factor, _ in equations.parallel if factor.free_symbols]) == 4  # u1 - u2, w, v, sin(a - b)
    serial = {str(factor) for factor, _ in equations.serial if factor.free_symbols}
    assert serial == {"cos_link9", "cos_link10", "cos_link4a", "sin_link12", "sin_link7a"}


def test_determinants_are_the_products_of_their_factors():
    for name in ("zeng2019", "orthoglide", "fivebar"):
        equations = velocity_equations(analytic_solution(load_record(name), "inverse"))
        for matrix, factors in ((equations.jp, equations.parallel), (equations.jq, equations.serial)):
            whole = sympy.prod([factor**power for factor, power in factors])
            assert sympy.expand(matrix.det() - whole) == 0


@pytest.mark.deep
def test_a_slide_along_a_line_that_turns_adds_no_factor_to_both_determinants(tmp_path):
    path = tmp_path / "mechanism.toml"
    path.write_text(drafted(parse_chains(["R[z] R[z] R[z]", "R[z] P[x]"]), path).text, encoding="utf-8")
    equations = velocity_equations(analytic_solution(load_record(path), "inverse"))
    both = (equations.parallel, equations.serial)
    parallel, serial = ({base for base, _ in factors if base.free_symbols} for factors in both)
    assert len(parallel) == 1
    assert not parallel & serial
