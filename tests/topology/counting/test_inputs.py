"""Which joints are actuated: the first of each branch, or by number, and every way to be refused."""

import pytest

from assur.errors import UsageError
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.notation import parse_chains

NESTED = "{P[y] {R[x] | R[x]} R[x] | R[x] S} U[x,y] P(4R)[z] P(4S)[y]"


@pytest.mark.parametrize(
    ("texts", "names"),
    [
        (["P[x] R[x] R[x] R[x]", "R[y] R[y] R[y]"], ("P1", "R4")),
        (["U P S", "S P[x] S", "C[x] R[x]", "H[z] R[z]"], ("P1", "P2", "C1", "H1")),
        (["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"], ("P1", "P2", "P3")),
        (["R[z] {P[y] R[x] | P[y] R[x]}"], ("R1",)),  # one actuator in front of the loop moves both branches
        (["S {P[y] R[x] | R[x] P[y]}"], ("P1", "R2")),
        (["{U S | P[x] R[y]} P[z]"], ("P1",)),
        (["{U S | S U} R[z]"], ("R1",)),
        ([NESTED], ("P1", "R4")),
        (["{{R[x] | R[y]} P[z] | P[y]}"], ("R1", "R2", "P2")),
        (["P(4R)[x] P(4S)[y] R[y]"], ("R1",)),
        (["S S", "U U"], ()),
    ],
)
def test_the_first_joint_of_each_branch_that_can_be_driven(texts, names):
    assert default_inputs(parse_chains(texts)) == names


def test_numbers_count_the_joints_of_nested_branches_in_the_order_of_the_text():
    chains = parse_chains(["P[x]", NESTED])
    joints = ("P2", "R1", "R2", "R3", "R4", "S1", "U1", "Pa1", "Pa2")
    assert tuple(joint.name for joint in chains[1].joints) == joints
    drivable = [(number, name) for number, name in enumerate(joints, 1) if name not in ("S1", "Pa2")]
    assert numbered_inputs(chains, [f"2.{number}" for number, _ in drivable]) == tuple(name for _, name in drivable)
    assert numbered_inputs(chains, [" 1.1 ", "2.08"]) == ("P1", "Pa1")
    assert numbered_inputs(chains, []) == ()


@pytest.mark.parametrize("number", ["", "1", "1.", ".2", "1,2", "1.2.3", "-1.1", "1.-1", "1.x", "P1", "1.2²", "1 .2"])
def test_what_is_no_number_of_a_joint(number):
    with pytest.raises(UsageError, match=r"names no joint to actuate; write limb\.joint, both counted from 1") as error:
        numbered_inputs(parse_chains(["P[x] R[x]"]), [number])
    assert f"'{number}'" in error.value.message
    assert "branches of inner loops" in error.value.hint


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        (["0.1"], "'0.1': there is no limb 0; limbs run from 1 to 2"),
        (["3.1"], "'3.1': there is no limb 3; limbs run from 1 to 2"),
        (["1.0"], "'1.0': limb 1 has joints 1 to 1"),
        (["1.2"], "'1.2': limb 1 has joints 1 to 1"),
        (["2.10"], "'2.10': limb 2 has joints 1 to 9"),
        (["2.6"], "'2.6' is a spherical joint, which cannot be actuated; any other joint can"),
        (["2.9"], "'2.9' is a parallelogram with 4 freedoms; only a P(4R) can be actuated"),
        (["2.1", "1.1", "2.1"], "names the joint 2.1 twice; each once"),
        (["2.1", "2.01"], "names the joint 2.01 twice; each once"),
    ],
)
def test_what_cannot_be_actuated(numbers, words):
    with pytest.raises(UsageError) as error:
        numbered_inputs(parse_chains(["P[x]", NESTED]), numbers)
    assert words in error.value.message
