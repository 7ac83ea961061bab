"""Linkages seen from other assemblies: what does not depend on home stays, and names of modes lead there."""

import numpy as np
import pytest

import assur
from assur.derived_topology import operation_modes
from assur.errors import UnknownNameError
from assur.kinematics.structure import linkage
from assur.model.registry import load_record
from assur.topology.analysis import analyse
from assur.topology.notation import parse_chains
from assur.topology.screws.assembled import assembled_at
from assur.topology.screws.configurations import configurations
from assur.topology.screws.edges import closure
from assur.topology.screws.placing import place
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.twists import edges


@pytest.mark.parametrize("name", ["zeng2019", "three_upu", "gough_stewart"])
def test_the_new_home_is_the_old_assembly(name):
    """Where every screw is, by the old home's exponentials; two steps make the one that their product is."""
    old = linkage(load_record(name))
    values = configurations(old, 2, seed=1)[0]
    new = assembled_at(old, values)
    there = np.concatenate([joint.screws for joint in new.joints.values() if not joint.type.ball])
    placed = screw_tree(old).at((values / screw_tree(old).scales)[None]).twists[0].T
    kept = np.concatenate([np.full(len(joint.screws), not joint.type.ball) for joint in old.joints.values()])
    np.testing.assert_allclose(there[:, :3], placed[kept, :3], atol=1e-12)
    about = np.cross(there[:, :3], old.point) + there[:, 3:]  # at O' of the old home
    turning = np.any(np.abs(there[:, :3]) > 0, axis=1)
    np.testing.assert_allclose(about[turning] / old.length, placed[kept, 3:][turning], atol=1e-9)
    at_home = closure(edges(new, np.zeros((1, len(values))), collapsed=False))[0]
    assert np.linalg.matrix_rank(at_home, tol=1e-7) == np.linalg.matrix_rank(
        closure(edges(old, values[None], collapsed=False))[0], tol=1e-7
    )


def test_the_topology_of_one_mode_is_the_same_from_each_of_its_assemblies():
    chains = parse_chains(["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"])
    old = place(chains, actuated=["P1", "P2", "P3"])
    new = assembled_at(old, configurations(old, 2, seed=3)[1])
    before, after = analyse(old, chains), analyse(new)
    facts = [
        (str(item.poc), item.dof, item.xi, item.coupling_degree, item.decoupling.depends) for item in (before, after)
    ]
    assert facts[0] == facts[1]


@pytest.mark.parametrize(
    "what", [pytest.param("three_upu", marks=pytest.mark.deep), load_record("three_upu")], ids=["chains", "file"]
)
def test_every_mode_can_be_asked_for_by_its_name(what):
    for mode in operation_modes(what):
        found = assur.topology(what, mode=mode.name)
        assert (found.mode, found.poc.t, found.poc.r, found.poc.dim) == (
            mode.name,
            mode.poc.t,
            mode.poc.r,
            mode.poc.dim,
        )
        assert (found.dof, found.coupling_degree) == (mode.dof, mode.coupling_degree)
        assert any("around an example" in note for note in found.notes)


def test_an_unknown_mode_lists_those_that_were_met():
    with pytest.raises(UnknownNameError, match="unknown mode 'free'; there is: 2T1R, home, translation"):
        assur.topology(["R[z] R[z] R[z]"] * 2, mode="free")
