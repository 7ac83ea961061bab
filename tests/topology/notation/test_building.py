"""From sketch to chain: types, points, what is general."""

from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import ChainJoint, InnerLoop, Parallelogram
from assur.topology.notation import parse_chain, parse_chains

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def test_a_chain_is_what_its_text_says():
    text = "P[x] {R[y]@A | C[z] P(4U)[y]} U[x,-z]@A S"
    chain = parse_chain(text)
    assert chain.text == text
    assert chain.elements == (
        ChainJoint(PRISMATIC, (X,), name="P1"),
        InnerLoop(
            (
                (ChainJoint(REVOLUTE, (Y,), "A", "R1"),),
                (ChainJoint(CYLINDRICAL, (Z,), name="C1"), Parallelogram("4U", Y, "Pa1")),
            )
        ),
        ChainJoint(UNIVERSAL, (X, (0.0, 0.0, -1.0)), "A", "U1"),
        ChainJoint(SPHERICAL, (), name="S1"),
    )


def test_general_is_what_nobody_chose():
    chain = parse_chain("R - R ∥ R - U - P(4R) - Pa[x] - S - R[x] ⊥ R")
    found = [getattr(element, "general", None) for element in chain.elements]
    assert found == [True, False, False, True, True, False, False, False, False]


def test_points_are_the_mechanisms():
    limbs = parse_chains(["R[x]@A ⌢ R[y] - R[x] ⌢ R[y]", "R[x] ⌢ R[y] - R[x]@C R[y]"])
    assert [[joint.point for joint in limb.joints] for limb in limbs] == [["A", "A", "B", "B"], ["D", "D", "C", ""]]


def test_more_points_than_letters():
    text = "-".join(["R ⌢ R"] * 30)
    assert len({joint.point for joint in parse_chain(text).joints}) == 30
