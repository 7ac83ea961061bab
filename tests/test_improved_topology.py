"""What is better in a neighbour is so by its own topology, asked for as a user would ask."""

import pytest

from assur.derived_topology import topology
from assur.errors import UsageError
from assur.improved_topology import improvements, zeros


@pytest.fixture(scope="module")
def planar():
    chains = ["R[z] R[z] R[z]"] * 3
    return topology(chains), improvements(chains)


def test_each_is_better_in_something_and_moves_alike(planar):
    before, found = planar
    assert found
    for item in (found[0], found[-1]):
        after = topology(item.chains, actuate=item.actuate)
        assert (str(after.poc).split("(")[0], after.poc.dim, after.motion_type) == (
            str(before.poc).split("(")[0],
            before.poc.dim,
            before.motion_type,
        )
        assert (after.coupling_degree, zeros(after)) == (item.coupling_degree, item.zeros)
        less = after.redundant_constraints.joint_graph < before.redundant_constraints.joint_graph
        assert item.better
        assert less or after.coupling_degree < before.coupling_degree or zeros(after) > zeros(before)


def test_two_drives_in_one_limb_take_the_coupling_away(planar):
    _, found = planar
    assert found[0].change == "drives moved to R1, R2, R4"
    assert found[0].better == ("κ 1 to 0",)


def test_they_are_ordered_by_coupling_then_redundancy(planar):
    ranks = [(item.coupling_degree, item.redundant_constraints.joint_graph, -item.zeros) for item in planar[1]]
    assert ranks == sorted(ranks)


def test_a_graph_without_limbs_has_no_neighbours():
    bars = ["R[y] P(4S)[y] <left>"] * 2 + ["R[x] P(4S)[x] <right>"] * 2
    with pytest.raises(UsageError, match="no limbs"):
        improvements([*bars, "<left> R[z]", "<right> R[z]", "<left> R[z] R[z] <right>"])
