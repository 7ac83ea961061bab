import itertools

import networkx as nx
import numpy as np
import pytest

from assur.figures.series_parallel import Beside, Series, levels, tree, turned


def names(part):
    """The edges of a tree in its order."""
    return [part] if isinstance(part, str) else [name for item in part.parts for name in names(item)]


def walked(part, edges, start):
    """Run through a tree from a node: the node where it ends; every edge must lead on from where the last one led."""
    if isinstance(part, str):
        assert start in edges[part], part
        return next(node for node in (*edges[part], start) if node != start)
    if isinstance(part, Beside):
        ends = {walked(item, edges, start) for item in part.parts}
        assert len(ends) == 1
        return ends.pop()
    nodes = [start]
    for item in part.parts:
        nodes.append(walked(item, edges, nodes[-1]))
    assert tuple(nodes[1:-1]) == part.nodes
    return nodes[-1]


def grown(rng, steps):
    """A random series-parallel graph between "s" and "t", its edges in random order and of random sense."""
    edges = [("s", "t")]
    for count in range(steps):
        place = int(rng.integers(len(edges)))
        start, end = edges[place]
        if rng.random() < 0.6:
            edges[place : place + 1] = [(start, str(count)), (str(count), end)]
        else:
            edges.append((start, end))
    order = rng.permutation(len(edges))
    return {f"e{k}": edges[index] if rng.random() < 0.5 else edges[index][::-1] for k, index in enumerate(order)}


@pytest.mark.parametrize("seed", range(40))
def test_a_grown_graph_reduces_to_a_tree_with_every_edge_once(seed):
    edges = grown(np.random.default_rng(seed), 3 + seed % 15)
    found = tree(edges, "s", "t")
    assert sorted(names(found)) == sorted(edges)
    assert walked(found, edges, "s") == "t"
    assert walked(turned(found), edges, "t") == "s"
    assert turned(turned(found)) == found


@pytest.mark.parametrize("seed", range(20))
def test_levels_are_the_longest_way_through(seed):
    edges = grown(np.random.default_rng(seed), 3 + seed % 9)
    graph = nx.MultiGraph(edges.values())
    ways = nx.all_simple_paths(nx.Graph(graph), "s", "t")
    assert levels(tree(edges, "s", "t")) == max(len(way) - 1 for way in ways)


@pytest.mark.parametrize("order", list(itertools.permutations(range(5))))
def test_a_bridge_between_two_ways_does_not_reduce(order):
    bridge = [("s", "a"), ("s", "b"), ("a", "b"), ("a", "t"), ("b", "t")]
    assert tree({str(k): bridge[k] for k in order}, "s", "t") is None


def test_a_free_end_and_a_loop_on_itself_do_not_reduce():
    assert tree({"A": ("s", "t"), "B": ("t", "free")}, "s", "t") is None
    assert tree({"A": ("s", "t"), "B": ("t", "k"), "C": ("k", "t")}, "s", "t") is None


def test_parts_stand_in_the_order_of_the_edges():
    edges = {"A": ("s", "1"), "B": ("s", "2"), "C": ("1", "t"), "D": ("2", "t"), "E": ("s", "t")}
    assert tree(edges, "s", "t") == Beside((Series(("A", "C"), ("1",)), Series(("B", "D"), ("2",)), "E"))
