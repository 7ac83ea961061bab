"""Axes as formulas are of length 1 exactly, in every limb, however the file writes them."""

import pytest
import sympy

from assur.cli.main import main
from assur.derivation.solution import analytic_solution
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import ModularWitness
from assur.model.registry import load_record
from assur.numerics.vectors import dot


@pytest.fixture
def general(tmp_path):
    """Limbs turned about Z whose axes are decimals: of a root in the template, and of sums of roots in a limb."""
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "3-CRS"]) == 0
    return load_record(path)


def test_axes_in_turned_limbs_are_unit_vectors(general):
    geometry = GivenSymbols(general, "direct", ModularWitness()).geometry
    axes = [axis for own in geometry.joints.values() for axis in own.axes]
    assert len(axes) == 6
    assert [sympy.expand(dot(axis, axis)) for axis in axes] == [1] * 6


@pytest.mark.deep
def test_three_circles_with_general_axes_meet_a_triangle_in_sixteen_poses(general):
    assert analytic_solution(general, "direct").branches == 16


@pytest.mark.deep
@pytest.mark.parametrize(
    "axis", ["[0.7071067811865475, 0, 0.7071067811865475]", "[0.2672612419124244, 0, 0.9636241116594315]"]
)
def test_a_derivation_whose_axes_are_decimals_of_roots_is_verified(axis, tmp_path, capsys):
    """Rails that lean by 45 deg, and along (1, 0, sqrt(13)): derivation and verifier each read the decimals."""
    text, before = load_record("linear_delta_4r").description.text, 'at = ["R", 0, 0], axis = "z" }'
    own, data = tmp_path / "own.toml", tmp_path / "d.json"
    assert before in text
    own.write_text(text.replace(before, before.replace('"z"', axis)), encoding="utf-8")
    assert main(["derive", str(own), "--problem", "direct", "--prove", "--json"]) == 0
    data.write_text(capsys.readouterr().out, encoding="utf-8")
    assert main(["verify", str(data), "--mechanism", str(own)]) == 0


@pytest.mark.deep
def test_axes_of_many_digits_that_are_no_roots_are_said_to_be_too_long_for_a_closed_form(tmp_path, capsys):
    """Rails that lean by 40 deg."""
    text, before = load_record("linear_delta_4r").description.text, 'at = ["R", 0, 0], axis = "z" }'
    own = tmp_path / "own.toml"
    own.write_text(text.replace(before, before.replace('"z"', "[0.6427876096865394, 0, 0.766044443118978]")), "utf-8")
    assert main(["derive", str(own), "-o", str(tmp_path / "closed_form.py")]) == 5
    assert "axes by fewer digits" in " ".join(capsys.readouterr().out.split())
    assert not (tmp_path / "closed_form.py").exists()
