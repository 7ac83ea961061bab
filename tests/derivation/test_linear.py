"""Lengths along unit vectors: each from its own equations, or said to have none."""

import pytest
import sympy

from assur.cli.main import main
from assur.derivation.derivation import derive
from assur.derivation.linear import ONE, projected
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.witness import ModularWitness
from assur.model.registry import load_record


def test_a_length_without_equation_is_said():
    x, y = sympy.symbols("x y")
    with pytest.raises(NotDerivedError, match="how far y slides"):
        projected([{x: ONE, y: -ONE}], [x, y], ModularWitness())


def test_planar_joints_that_leave_one_are_not_derived(tmp_path, capsys):
    path = str(tmp_path / "mine.toml")
    assert main(["new", path, "--chain", "P[x] E[x]", "--chain", "P[y] E[y]", "--chain", "P[z] E[z]"]) == 0
    with pytest.raises(NotDerivedError):
        derive(load_record(path))
    assert main(["derive", path]) == 5
    assert "not derived" in capsys.readouterr().out
