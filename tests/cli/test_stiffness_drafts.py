"""Stiffness, reactions and errors of mechanisms that somebody drafts: the laws of all the others hold of them."""

import numpy as np
import pytest

import assur
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.elasticity.elastic_reactions import elastic_reactions
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import reactions
from bending import bending, by_multipliers
from weighed import place

DRAFTS = {
    "3-PRS": ("--limb", "P[z] R[y] S", "--count", "3"),
    "hybrid": ("--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "--chain", "P[y] P(4R)[x] P(4R)[y]"),
    "3-RUU": ("--limb", "R[y] U[y,x] U[x,y]", "--count", "3"),
    "planar": ("--chain", "R[z] R[z] R[z]", "--chain", "P[x] R[z] R[z]", "--chain", "R[z] P[x] R[z]"),
}


@pytest.mark.deep
@pytest.mark.parametrize("draft", DRAFTS)
def test_laws_hold_of_a_mechanism_of_ones_own(assur_cli, tmp_path, draft):
    path = tmp_path / "own.toml"
    assert assur_cli("new", str(path), *DRAFTS[draft]).code == 0
    bare = assur.load(path)
    record, values = bending(bare), place(bare)
    own = stiffness_at(record, values)
    other, _ = by_multipliers(record, values[0])
    np.testing.assert_allclose(own.compliance[0], other, atol=1e-7 * np.abs(other).max())
    assert own.shares().energy == pytest.approx(0.5 * np.trace(own.compliance[0, :3, :3]), rel=1e-7)
    solved = forces_at(record, values, load_of([3.0, -4.0, 5.0, 0.6, 0.7, -0.8]))
    passed, bent = reactions(solved), elastic_reactions(solved)
    size = max(np.abs([*item.force, *item.moment]).max() for item in passed.joints)
    for item in passed.joints:
        rigid = np.array([*item.force, *item.moment])
        np.testing.assert_allclose(bent[item.joint][item.unique], rigid[item.unique], atol=1e-7 * size)
    assert pose_errors_at(record, values[0]).sensitivity
