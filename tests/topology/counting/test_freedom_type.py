"""Types of freedom: textbook mechanisms, and which chains still move when all drives but those of one are locked."""

import dataclasses
from itertools import combinations

import networkx as nx
import numpy as np
import pytest

import assur
from assur.topology.analysis import sample
from assur.topology.counting.freedom_type import freedom_type
from assur.topology.screws.edges import closure, input_columns, null_basis

FOUR_BAR = "{R[z] R[z] | R[z] R[z]}"
TYPES = {
    "five-bar": (["R[z] R[z] R[z]", "R[z] R[z]"], "full"),
    "planar 3-RRR": (["R[z] R[z] R[z]"] * 3, "full"),
    "five-bar on the coupler of a four-bar": ([f"{FOUR_BAR} R[z] R[z]", "R[z] R[z]"], "partial"),
    "four-bar on the coupler of a four-bar": ([f"{FOUR_BAR} {FOUR_BAR}"], "separable"),
    "slide before a four-bar": ([f"P[x] {FOUR_BAR}"], "separable"),
    "one four-bar": (["R[z] R[z]", "R[z] R[z]"], "full"),
}


@pytest.fixture(scope="module", params=TYPES)
def typed(request):
    texts, kind = TYPES[request.param]
    return assur.topology(texts), kind


def test_types_of_known_mechanisms(typed):
    topology, kind = typed
    assert topology.freedom_type == kind


def test_chains_hang_together_where_they_move_with_the_same_drives(typed):
    """Another route: the drives of all chains but one are locked, and what still moves belongs to its part."""
    topology, kind = typed
    edges = sample(topology.linkage).collapsed
    chains = [
        {joint for index in chain.loops for joint in topology.loops[index].joints} for chain in topology.assur_chains
    ]
    chains += [{edge.name} for edge in edges if not any(edge.name in chain for chain in chains)]
    names = [edge.name for edge in edges for _ in range(edge.freedoms)]
    drives = input_columns(edges)
    driven = [chain for chain in chains if any(names[column] in chain for column in drives)]
    together = nx.Graph()
    together.add_nodes_from(range(len(driven)))
    moving = []
    for chain in driven:
        kept = [i for i, name in enumerate(names) if i not in drives or name in chain]
        moves = null_basis(closure(edges)[:, :, kept])
        moving.append({names[kept[row]] for row in np.flatnonzero(np.abs(moves).max(axis=(0, 2)) > 1e-7)})
    together.add_edges_from((i, j) for i, j in combinations(range(len(driven)), 2) if moving[i] & moving[j])
    parts = nx.number_connected_components(together)
    assert kind == ("full" if len(driven) == 1 else "partial" if parts == 1 else "separable")


def test_drives_that_leave_a_freedom_have_no_type():
    assert assur.topology(["R[z] R[z]"]).freedom_type is None


def test_drives_that_hinder_each_other_have_no_type():
    topology = assur.topology(["R[z] R[z]", "R[z] R[z]"])
    edges = sample(topology.linkage).collapsed
    assert freedom_type(edges, topology.loops, topology.assur_chains) == "full"
    twice = [dataclasses.replace(edge, inputs=(0,)) for edge in edges[:2]]
    assert freedom_type([*twice, *edges[2:]], topology.loops, topology.assur_chains) is None
