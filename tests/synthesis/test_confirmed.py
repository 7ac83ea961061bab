import pytest

from assur.synthesis.confirmed import confirmed
from assur.synthesis.isomorphism import limb_key
from assur.synthesis.limb_motions import verdict
from assur.synthesis.limbs import LimbType
from assur.synthesis.positions import positions
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain


def limb(text, driven=(0,), name="3T"):
    motion, chain = MOTIONS[name], parse_chain(text)
    found = verdict(LimbType(chain, driven, limb_key(chain, motion, driven)), motion, positions(motion, motion.dim))
    return found.limb


@pytest.mark.parametrize(
    ("text", "driven", "xi", "degree"),
    [
        ("R[x] R[x] P(4R)[y] R[x]", (0,), (5, 4), 1),
        ("P[x] R[x] R[x] R[x]", (0,), (5, 4), 1),
        ("U[x,y] P[x] U[y,x]", (1,), (6, 6), 2),
        ("P[x] P[y] P[z]", (0,), (3, 3), 1),
    ],
)
def test_rows_of_the_theory(text, driven, xi, degree):
    """poc-theory, the table of section 5; three P-P-P by hand: 9 - 3 - 3."""
    found = confirmed([limb(text, driven)] * 3, (0, 1, 2))
    assert (found.dof, found.left) == (3, 0)
    assert tuple(loop.xi for loop in found.loops.loops) == xi
    assert found.loops.coupling_degree == degree
    assert tuple(edge.name for edge in found.edges) == ("limb 1", "limb 2", "limb 3")


def test_locked_joints_may_leave_freedoms():
    """Three P-P-P that all drive along x when they are turned into their positions leave y and z free."""
    found = confirmed([limb("P[x] P[y] P[z]"), limb("P[z] P[x] P[y]"), limb("P[y] P[z] P[x]")], (0, 1, 2))
    assert (found.dof, found.left) == (3, 2)


def test_the_column_that_is_locked_is_the_driven_one():
    found = confirmed([limb("R[x] P[y] C[x]", (1,))] * 3, (0, 1, 2))
    assert [edge.inputs for edge in found.edges] == [(1,)] * 3
