import math

import pytest

from assur.synthesis.drafting.families import families, turns
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains


def angles(*texts: str) -> list[tuple[float, ...]]:
    return [item.angles for item in families(parse_chains(texts))]


@pytest.mark.parametrize("text", ["R[y] P(4S)[y]", "P[x] U[y,z] S", "U P S", "{R[y] S | R[y] S} R[z]", "R[x]@A S@A"])
@pytest.mark.parametrize("count", [2, 3, 5])
def test_a_repeated_limb_is_one_family(text, count):
    (family,) = families(repeated(text, count))
    assert family.members == tuple(range(count))
    assert family.angles == pytest.approx([360 * number / count for number in range(count)])
    assert family.even


def test_limbs_in_another_order_have_their_own_angles():
    first, second, third = (f"R[{math.cos(a)},{math.sin(a)},0] S" for a in (0.3, 0.3 + math.pi / 2, 0.3 + math.pi))
    assert angles(first, third, second) == [pytest.approx((0, 180, 90))]


def test_an_axis_has_no_sense_but_senses_that_agree_are_taken_first():
    assert turns([(1.0, 0.0, 0.0)], [(-1.0, 0.0, 0.0)]) == ([180.0], [0.0])
    assert turns([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0)]) == ([], [0.0, 180.0])


def test_what_is_not_a_turn_about_z_is_no_family():
    assert angles("P[x] R[x] R[x] R[x]", "P[z] R[z] R[z] R[z]") == [(0.0,), (0.0,)]
    assert angles("R[x] U[y,z] S", "R[x] U[x,z] S") == [(0.0,), (0.0,)]
    assert angles("R[z] R[z]", "R[z] R[z] R[z]") == [(0.0,), (0.0,)]


def test_two_limbs_do_not_stand_in_one_place():
    """Four limbs that are alike and not turned: they can stand opposite each other, two and two."""
    assert angles(*["R[y] U[y,x] S"] * 4) == [(0.0, 180.0), (0.0, 180.0)]


def test_a_point_of_two_limbs_is_not_a_point_of_each():
    assert len(angles("R[x]@O R[z]@O", "R[y]@O R[z]@O")) == 1
    assert len(angles("R[x]@O R[z]@O", "R[y]@A R[z]@A", "S@O")) == 3
