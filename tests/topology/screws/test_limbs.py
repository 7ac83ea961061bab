"""Limbs by series-parallel reduction: order, inner loops, direction of travel, and graphs that have none."""

import pytest

from assur.joints.revolute import REVOLUTE
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import ChainJoint, InnerLoop
from assur.topology.screws.limbs import LinkagePath, limbs

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def path(start: str, end: str, name: str) -> LinkagePath:
    return LinkagePath(start, end, (ChainJoint(REVOLUTE, (Z,), name=name),))


def names(elements):
    return [[names(b) for b in e.branches] if isinstance(e, InnerLoop) else e.name for e in elements]


def test_serial_limbs_keep_the_order_of_the_joints_whatever_the_order_of_the_file():
    found = limbs(
        [path("c", "p", "C"), path("base", "a", "A"), path("a", "p", "B"), path("base", "c", "D")], "base", "p"
    )
    assert [names(chain.elements) for chain in found] == [["D", "C"], ["A", "B"]]


def test_a_loop_inside_a_limb_becomes_branches():
    pieces = [
        ("base", "a", "A"),
        ("a", "o", "B"),
        ("base", "c", "C"),
        ("c", "o", "D"),
        ("o", "p", "E"),
        ("base", "p", "F"),
    ]
    found = limbs([path(*piece) for piece in pieces], "base", "p")
    assert [names(chain.elements) for chain in found] == [[[["A", "B"], ["C", "D"]], "E"], ["F"]]


def test_loops_nest():
    pieces = [
        ("base", "m", "A"),
        ("m", "n", "B"),
        ("m", "n", "C"),
        ("n", "o", "D"),
        ("base", "o", "E"),
        ("o", "p", "F"),
    ]
    found = limbs([path(*piece) for piece in pieces], "base", "p")
    assert [names(chain.elements) for chain in found] == [[[["A", [["B"], ["C"]], "D"], ["E"]], "F"]]


def test_a_joint_written_from_the_platform_is_passed_through_from_its_other_side():
    backwards = LinkagePath("p", "a", (ChainJoint(UNIVERSAL, (X, Y), name="U"),))
    (chain,) = limbs([path("base", "a", "A"), backwards], "base", "p")
    assert chain.elements[1].axes == (Y, X)


def test_an_arm_with_a_free_end_is_no_limb():
    found = limbs([path("base", "p", "A"), path("p", "tool", "B"), path("tool", "tip", "C")], "base", "p")
    assert [names(chain.elements) for chain in found] == [["A"]]


@pytest.mark.parametrize("bridge", [True, False])
def test_a_bridge_between_two_limbs_does_not_reduce(bridge):
    pieces = [("base", "a", "A"), ("a", "p", "B"), ("base", "c", "C"), ("c", "p", "D")]
    found = limbs([path(*piece) for piece in [*pieces, *([("a", "c", "E")] if bridge else [])]], "base", "p")
    assert (found is None) == bridge
