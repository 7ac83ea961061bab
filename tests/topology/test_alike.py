"""Limbs that are alike, wherever they stand."""

import pytest

from assur.topology.alike import alike_limbs
from assur.topology.notation import parse_chains


@pytest.mark.parametrize(
    ("texts", "driven", "groups"),
    [
        (["P[x] R[x] R[x]", "P[0.6,0.8,0] R[0.6,0.8,0] R[-0.6,-0.8,0]"], ("P1", "P2"), ((1, 2),)),
        (["P[x] R[x] R[x]", "P[y] R[y] R[y]"], ("P1", "R4"), ((1,), (2,))),
        (["P[x] R[x] R[y]", "P[x] R[y] R[x]"], (), ((1,), (2,))),
        (["R[x]@A R[y]@A", "R[x] R[y]"], (), ((1,), (2,))),
        (["{P[x] | R[x] R[x]} R[y]", "{P[y] | R[y] R[y]} R[x]", "P[x] R[x] R[x] R[y]"], (), ((1, 2), (3,))),
        (["U P S", "U P S"], (), ((1, 2),)),
        (["P(4R)[x]", "P(4S)[x]"], (), ((1,), (2,))),
    ],
)
def test_the_same_joints_drives_angles_and_points(texts, driven, groups):
    assert alike_limbs(parse_chains(texts), driven) == groups
