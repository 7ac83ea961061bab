"""Lengths along unit vectors: each from its own equations, or said to have none."""

import json

import pytest
import sympy

from assur.cli.main import main
from assur.derivation.derivation import derive
from assur.derivation.linear import ONE, projected, sparse
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.witness import ModularWitness
from assur.model.registry import load_record

SLIDING = {
    "two slides of a limb, and no set": (["--limb", "P[y] R[z] P[x]"], 1, ("cos_phi != 0",)),
    "two slides of a limb that a crank turns": (
        ["--chain", "P[x] R[z] P[x]", "--chain", "P[x] R[z] R[z]"], 2, ("sin_phi != 0",),
    ),
    "a slide whose joint stands aside by an angle": (["--chain", "R[z] P[x] R[z]", "--chain", "P[x] R[z]"], 4, ()),
    "a vector that the formula of a slide has in it": (
        ["--chain", "R[z] P[x] R[z]", "--chain", "P[x] R[z] R[z]", "--chain", "R[z] R[z] P[x]"], 8, (),
    ),
}  # fmt: skip


def own_record(words, folder):
    file = folder / "mine.toml"
    assert main(["new", str(file), *words]) == 0
    return load_record(file)


def test_nothing_is_divided_by_the_sine_of_a_dimension():
    x, y, z = sympy.symbols("x y z")
    angle, length = sympy.Symbol("angle", real=True), sympy.Symbol("length", positive=True)
    rows = [{x: sympy.sin(angle), y: ONE}, {x: sympy.cos(angle), y: ONE, z: ONE}]
    assert sparse([{x: sympy.sin(angle)}, {x: ONE, y: ONE}], ModularWitness())[1] == {x: ONE, y: ONE}
    assert sparse([{x: length}, {x: ONE, y: ONE}], ModularWitness())[1] == {y: ONE}
    assert all(not sympy.fraction(sympy.together(part))[1].free_symbols for row in sparse(rows, ModularWitness())
               for part in row.values())  # fmt: skip


@pytest.mark.deep
@pytest.mark.parametrize(("words", "branches", "conditions"), SLIDING.values(), ids=[*SLIDING])
def test_slides_of_one_limb_are_verified_where_their_conditions_hold(words, branches, conditions, tmp_path, capsys):
    record, document = own_record(words, tmp_path), tmp_path / "d.json"
    capsys.readouterr()
    assert main(["derive", str(record.file), "--problem", "inverse", "--prove", "--json"]) == 0
    document.write_text(capsys.readouterr().out)
    problem = json.loads(document.read_text())["problems"][0]
    assert (problem["branches"], problem["conditions"]) == (branches, [*conditions])
    assert main(["verify", str(document), "--mechanism", str(record.file)]) == 0
    capsys.readouterr()
    if conditions:  # what is divided by is no formula of its own without them
        document.write_text(document.read_text().replace(json.dumps([*conditions]), "[]"))
        assert main(["verify", str(document), "--mechanism", str(record.file)]) == 1


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
