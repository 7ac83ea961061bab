import numpy as np
import pytest

from assur.errors import UnknownNameError
from assur.topology.notation import parse_chain
from assur.topology.screws.linkage import part
from assur.topology.screws.placing import place


def _two_limbs():
    limbs = [parse_chain("C[x] P(4S)[y]"), parse_chain("U[x,y] P[z] S")]
    return place(limbs, actuated=["C1", "P1"])


def test_links_and_values_are_in_the_order_of_the_joints():
    linkage = _two_limbs()
    rods = ("Pa1 rod 1", "platform", "Pa1 rod 2")
    assert linkage.links == ("base", "link 1.1", *rods, "link 2.1", "link 2.2")
    assert list(linkage.slices) == list(linkage.joints)
    assert linkage.slices["C1"] == slice(0, 2)
    assert linkage.slices["Pa1.a"] == slice(2, 5)
    assert linkage.slices["S1"] == slice(17, 20)


def test_a_part_has_its_joints_groups_and_inputs_only():
    linkage = _two_limbs()
    limb = part(linkage, ["Pa1", "C1"], "platform")
    assert list(limb.joints) == ["C1", "Pa1.a", "Pa1.b", "Pa1.c", "Pa1.d"]
    assert list(limb.groups) == ["Pa1"]
    assert limb.inputs == (("C1", 0),)
    assert limb.point is linkage.point
    start = part(linkage, ["U1", "P1"], "link 2.2", np.array([1.0, 2.0, 3.0]))
    assert (start.platform, start.groups, start.inputs) == ("link 2.2", {}, (("P1", 0),))
    np.testing.assert_array_equal(start.point, [1.0, 2.0, 3.0])


def test_half_a_parallelogram_is_none():
    linkage = _two_limbs()
    assert part(linkage, ["C1", "Pa1.a", "Pa1.b"], "platform").groups == {}


def test_a_part_of_joints_that_do_not_exist_is_refused():
    with pytest.raises(UnknownNameError, match="unknown joint 'C2'"):
        part(_two_limbs(), ["C2"], "platform")
