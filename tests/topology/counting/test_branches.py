"""Branches and the loops between them, against the definition: least sets of branches that add one loop."""

from itertools import combinations

import networkx as nx
import numpy as np
import pytest

from assur.topology.counting.branches import LoopBranch, branches, names_along, next_loops
from assur.topology.screws.edges import Edge


def edges(text):
    """Edges from "A:base-a B:a-p": name, parent, child."""
    found = []
    for item in text.split():
        name, links = item.split(":")
        parent, child = links.split("-")
        found.append(Edge(name, parent, child, np.zeros((1, 6, 1))))
    return tuple(found)


def written(text):
    return [(" ".join(part.edges), part.start, part.end) for part in branches(edges(text))]


def test_branches_run_between_links_that_fork():
    assert written("A:base-a B:a-p C:base-c D:p-c E:p-e F:e-base") == [
        ("A B", "base", "p"),
        ("C D", "base", "p"),
        ("E F", "p", "base"),
    ]


def test_a_branch_starts_at_its_end_that_is_named_first():
    assert written("A:b-p B:base-a C:a-b D:base-p E:base-p")[0] == ("A C B", "p", "base")


def test_a_ring_closes_on_itself_at_the_link_that_is_named_first():
    assert written("A:base-a B:a-b C:base-b") == [("A B C", "base", "base")]


def test_two_rings_that_share_a_link():
    assert written("A:base-a B:a-base C:p-base D:base-p") == [("A B", "base", "base"), ("C D", "base", "base")]


def test_a_ring_that_closes_on_a_link_that_forks():
    found = written("A:a-b B:b-c C:c-a D:a-d E:d-a F:a-tip")
    assert found == [("A B C", "a", "a"), ("D E", "a", "a")]


def test_arms_and_bridges_are_in_no_branch():
    assert written("Z:ground-base A:base-a B:a-base Y:a-m C:m-n D:n-m X:n-tip") == [
        ("A B", "base", "base"),
        ("C D", "m", "m"),
    ]


def test_a_serial_chain_has_no_branches():
    assert written("A:base-a B:a-b C:b-p") == []


# ---- the loops that may come next ----------------------------------------------------------------------------


def loops_in(parts, chosen):
    """Independent loops of some branches."""
    built = nx.MultiGraph((parts[i].start, parts[i].end) for i in chosen)
    return built.number_of_edges() - built.number_of_nodes() + nx.number_connected_components(built)


def by_definition(parts, taken):
    """The least sets of branches that add exactly one loop."""
    rest = [index for index in range(len(parts)) if index not in taken]
    found = []
    for size in range(1, len(rest) + 1):
        for chosen in combinations(rest, size):
            adds = loops_in(parts, {*taken, *chosen}) - loops_in(parts, taken)
            if adds == 1 and not any(set(other) < set(chosen) for other in found):
                found.append(chosen)
    return sorted(found)


@pytest.mark.parametrize("seed", range(40))
def test_next_loops_are_the_least_sets_that_add_one_loop(seed):
    rng = np.random.default_rng(seed)
    links = [f"n{i}" for i in range(rng.integers(1, 5))]
    parts = [LoopBranch((f"J{i}",), *rng.choice(links, 2)) for i in range(rng.integers(1, 7))]
    taken = set()
    while True:
        found = list(next_loops(parts, taken))
        assert sorted(tuple(sorted(loop)) for loop in found) == by_definition(parts, taken)
        assert all(loop[0] == min(loop) for loop in found)
        if not found:
            break
        taken |= set(found[rng.integers(len(found))])


def test_only_the_branches_asked_for():
    parts = branches(edges("A:o-p B:o-p C:o-p"))
    assert list(next_loops(parts, ())) == [(0, 1), (0, 2), (1, 2)]
    assert list(next_loops(parts, (), {0, 2})) == [(0, 2)]
    assert list(next_loops(parts, {0, 1})) == [(2,)]


def test_names_follow_the_chain_through_parts_that_are_in():
    """Two rings are in; the loop that joins them passes through both."""
    text = "A:base-a B:base-a C:m-n D:n-m E:base-x F:x-m G:a-y H:n-y"
    parts = branches(edges(text))
    taken = {0, 1, 2, 3}
    (loop,) = next_loops(parts, taken)
    assert names_along(parts, taken, loop) == ("E", "F", "H", "G")
