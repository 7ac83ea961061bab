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
