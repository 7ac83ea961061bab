"""The 3-UPU's tables by exact triangles, and where its constraints are dependent by the rank of the joint graph."""

import numpy as np
import pytest
import sympy

import assur
from assur.kinematics.closure import mobility
from assur.model.registry import load_record

GAP = 120  # R - r


def radial(number):
    angle = 2 * sympy.pi * number / 3
    return sympy.Matrix([sympy.cos(angle), sympy.sin(angle), 0])


def test_tables_are_exact():
    for pose, lengths in (((0, 0, 160), (200, 200, 200)), ((30, 40, 200), None)):
        squares = [(sympy.Matrix(pose) - GAP * radial(k)).dot(sympy.Matrix(pose) - GAP * radial(k)) for k in range(3)]
        if lengths:
            assert [sympy.sqrt(sympy.simplify(square)) for square in squares] == list(lengths)
        else:
            printed = (222.934968096, 228.442894667, 262.323929287)
            assert [float(sympy.sqrt(square)) for square in squares] == pytest.approx(printed, abs=5e-10)


@pytest.mark.parametrize(
    "source", ["Table A row 1", "Table A row 2", "Table B row 1", "Table B row 2", "Table C row 1"]
)
def test_rows(at, source):
    assert {row.verdict for row in at(source).values()} == {"ok"}


def test_the_triple_product_of_the_couples():
    x, y, z, c = sympy.symbols("x y z c")
    pose, normals = sympy.Matrix([x, y, z]), []
    for number in range(3):
        leg = pose - c * radial(number)
        tangent = radial(number).cross(sympy.Matrix([0, 0, 1]))
        normals.append(leg - tangent * tangent.dot(leg))
    product = sympy.Matrix.hstack(*normals).det()
    assert sympy.simplify(product - 3 * sympy.sqrt(3) / 8 * z * (4 * c**2 - x**2 - y**2)) == 0


@pytest.mark.parametrize(("distance", "rank"), [(0, 12), (150, 12), (239.9, 12), (240, 11), (240.1, 12), (300, 12)])
@pytest.mark.parametrize("angle", [0.0, 0.3, 2.0])
def test_the_platform_begins_to_turn_on_the_cylinder(distance, rank, angle):
    mechanism = assur.load("three_upu")
    pose = [distance * np.cos(angle), distance * np.sin(angle), 180.0]
    found = mechanism.inverse(pose)
    assert mobility(mechanism, found.joints[0]).rank == rank
    assert mechanism.singularity(pose).kind == ("constraint" if rank == 11 else "regular")


def test_radial_first_axes_make_the_whole_axis_singular(tmp_path):
    """The layout of the 3-UPU of Seoul National University: its constraints are dependent at home."""
    text = load_record("three_upu").file.read_text(encoding="utf-8")
    for old, new in (('axes = ["y", "x"]', 'axes = ["x", "_"]'), ('axes = ["x", "y"]', 'axes = ["y", "x"]')):
        text = text.replace(old, new)
    file = tmp_path / "radial.toml"
    file.write_text(
        text.replace('"_"', '"y"').replace("A = [-37, 0]", "A = [0, -37]").replace("B = [0, 37]", "B = [37, 0]")
    )
    mechanism = assur.load(file)
    assert mobility(mechanism, mechanism.home_values).rank < 12


def test_nothing_else_is_claimed(found):
    assert found.origin == "derived"
    assert found.claims_hold
