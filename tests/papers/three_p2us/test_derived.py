"""The reference tables of the 3-[P2(US)] are rational numbers, checked with fractions."""

from fractions import Fraction

import pytest

R, r, l = 180, 60, 325  # noqa: E741  # the letters of the file
SLIDERS = (15, -135, -135)
POSES = {"1": (200, -300), "2": (Fraction(-10700, 61), Fraction(9180, 61))}


@pytest.mark.parametrize("pose", POSES.values(), ids=POSES)
def test_rods_have_their_length_exactly(pose):
    x, z = pose
    assert (x + r - R) ** 2 + (z - SLIDERS[0]) ** 2 == l * l
    assert (-x / Fraction(2) + r - R) ** 2 + 3 * x * x / Fraction(4) + (z - SLIDERS[1]) ** 2 == l * l


@pytest.mark.parametrize("number", POSES)
def test_tableb_row(at, number):
    rows = at(f"Table B row {number}")
    x, z = POSES[number]
    for row, exact in zip(rows.values(), (x, 0, z), strict=True):
        assert abs(Fraction(row.printed) - exact) <= Fraction(1, 2_000_000)
        assert row.verdict == "ok"


def test_every_number_of_ours_holds(found):
    assert found.origin == "derived"
    assert found.claims_hold
    assert found.ok == len(found.rows) > 10
