"""The five-bar's reference table is exact: cranks at cos = -3/5 and 3/5, both sines 4/5; checked with fractions."""

import math
from fractions import Fraction

import pytest

G, L1, L2 = 70, 100, 194
CRANKS = {"theta1": (Fraction(-3, 5), Fraction(4, 5)), "theta2": (Fraction(3, 5), Fraction(4, 5))}
POSES = [(0, 224), (0, -64)]


@pytest.mark.parametrize("pose", POSES)
def test_pose_is_a_solution_exactly(pose):
    for side, (cosine, sine) in zip((-1, 1), CRANKS.values(), strict=True):
        assert cosine**2 + sine**2 == 1
        end = (side * G + L1 * cosine, L1 * sine)
        assert sum((a - b) ** 2 for a, b in zip(pose, end, strict=True)) == L2**2


@pytest.mark.parametrize(("number", "pose"), [("1", POSES[0]), ("2", POSES[1])])
def test_tablea_row(at, number, pose):
    rows = at(f"Table A row {number}")
    assert [Fraction(row.printed) for row in rows.values()] == list(pose)
    assert [row.verdict for row in rows.values()] == ["ok", "ok"]
    assert all(abs(row.off_by) < 1e-9 < row.tolerance for row in rows.values())


def test_printed_angles_are_those_of_the_fractions():
    from assur.audit.audit import reference_entry
    from assur.model.registry import load_record

    given = reference_entry(load_record("fivebar"), "direct", "Table A").given
    for digits, (cosine, sine) in zip(given, CRANKS.values(), strict=True):
        exact = math.degrees(math.atan2(sine, cosine))
        assert abs(digits.value - exact) <= digits.half_unit + 1e-13


def test_dimensions_are_those_of_the_fractions(found):
    assert found.origin == "derived"
    assert found.claims_hold
    assert found.ok == len(found.rows) > 10
