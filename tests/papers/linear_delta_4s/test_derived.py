"""Linear Delta with rails of three directions: reference tables of rational numbers, checked with fractions."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

import assur
from assur.kinematics.closure import closure_error

R, r, l = 250, 50, 325  # noqa: E741  # the letters of the file

# (lean, rise), unit vector of the rail, pose, both places of slider 1 and of 2 and 3, the other pose at the first
VERTICAL = ((0, 1), (0, 1), (120, -300), ((15, -615), (-135, -465)), (-100, 140))
OBLIQUE = (
    (3, 4),
    (Fraction(3, 5), Fraction(4, 5)),
    (-100, -125),
    ((0, -560), (120, -500)),
    (-100 + Fraction(5900, 53), -125 + Fraction(20650, 53)),
)
HORIZONTAL = ((1, 0), (1, 0), (120, -165), ((200, -360), (0, -520)), (120, 165))
TABLES = pytest.mark.parametrize("table", [VERTICAL, OBLIQUE, HORIZONTAL], ids=["vertical", "oblique", "horizontal"])


def mechanism(table):
    lean, rise = table[0]
    return assur.load("linear_delta_4s", lean=lean, rise=rise)


def square(rail, pose, leg, slider):
    """Square of the rods' length at a pose (x, 0, z), exactly: outwards, around and up in the leg's frame."""
    (x, z), (a, b) = pose, rail
    outwards, around_square = (x, 0) if leg == 1 else (Fraction(-x, 2), Fraction(3 * x * x, 4))
    return (outwards + r - R - a * slider) ** 2 + around_square + (z - b * slider) ** 2


@TABLES
def test_rods_have_their_length_exactly(table):
    _, rail, pose, places, other = table
    for leg, both in enumerate(places, 1):
        assert both[0] > both[1]
        assert [square(rail, pose, leg, slider) for slider in both] == [l * l, l * l]
        assert square(rail, other, leg, both[0]) == l * l


@TABLES
def test_inverse_solutions_are_those_of_the_table(table):
    _, _, (x, z), (first, second), _ = table
    found = mechanism(table).inverse([x, 0, z])
    expected = list(itertools.product(first, second, second))
    np.testing.assert_allclose(found.inputs, np.array(expected, dtype=float), rtol=0, atol=1e-10)
    assert np.all(found.residuals < 1e-9)


@TABLES
def test_direct_solutions_are_those_of_the_table(table):
    _, _, (x, z), (first, second), other = table
    found = mechanism(table).direct([first[0], second[0], second[0]])
    expected = np.array([[x, 0, z], [other[0], 0, other[1]]], dtype=float)
    np.testing.assert_allclose(found.poses, expected, rtol=0, atol=1e-10)
    assert found.labels.tolist() == ["+", "-"]
    assert np.all(found.residuals < 1e-9)


@pytest.mark.parametrize("table", [OBLIQUE, HORIZONTAL], ids=["oblique", "horizontal"])
def test_two_sliders_that_bring_their_rods_together_leave_the_platform_free_on_a_circle(table):
    """With leaning rails the centres of two spheres can meet on the Z axis; then two pairs of rods are parallel."""
    _, (a, _), _, _, _ = table
    meeting = float((r - R) / Fraction(a))
    found = mechanism(table).direct([meeting, 0.0, meeting])
    assert len(found) == 0
    (curve,) = found.curves
    poses, joints = curve.poses(61), curve.joints(61)
    assert np.ptp(poses, axis=0).min() > 100
    inputs = joints[:, [item.coordinate.index for item in mechanism(table).inputs]]
    np.testing.assert_allclose(inputs, np.broadcast_to([meeting, 0.0, meeting], inputs.shape), rtol=0, atol=1e-12)
    assert np.max(closure_error(mechanism(table), joints)) < 1e-9


def test_printed_rows_are_the_vertical_table(at):
    rows = at("Table B row 1")
    assert [row.printed for row in rows.values()] == ["120.000000", "0.000000", "-300.000000"]
    assert [row.verdict for row in at("Table B row 2").values()] == ["ok", "ok", "ok"]


def test_every_number_of_ours_holds(found):
    assert found.origin == "derived"
    assert found.claims_hold
    assert found.ok == len(found.rows) > 10
