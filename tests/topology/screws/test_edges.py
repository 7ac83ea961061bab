"""Edges: loops close whatever way round, paths agree, ranks are generic ones, columns have names."""

import dataclasses

import numpy as np
import pytest

from assur.topology.screws.edges import (
    along,
    at_generic,
    closure,
    column_names,
    input_columns,
    null_basis,
    rank,
)
from twist_chains import X, Y, Z, ball, chain, slide, turn, turns


def turned(edge):
    """The same edge written from its other link."""
    return dataclasses.replace(edge, parent=edge.child, child=edge.parent, twists=-edge.twists)


@pytest.mark.parametrize("seed", range(5))
def test_what_the_closure_leaves_moves_the_platform_the_same_along_every_limb(seed):
    rng = np.random.default_rng(seed)
    limbs = [chain(name, "base", "p", [*turns(rng, Z, 3), [slide(rng.normal(size=3))]]) for name in "ABC"]
    edges = [edge for limb in limbs for edge in limb]
    free = null_basis(closure(edges))[0]
    assert free.shape[1] == 12 - 8
    moves = []
    for index, limb in enumerate(limbs):
        moves.append(along(limb, "base", "p")[0] @ free[4 * index : 4 * index + 4])
    for other in moves[1:]:
        np.testing.assert_allclose(other, moves[0], atol=1e-12)
    np.testing.assert_allclose(along(edges, "base", "p")[0] @ free, moves[0], atol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_order_and_sense_of_the_edges_do_not_matter(seed):
    rng = np.random.default_rng(seed)
    edges = [edge for name in "ABC" for edge in chain(name, "base", "p", turns(rng, Z, 3))]
    edges += chain("D", "p", "q", turns(rng, X, 2)) + chain("E", "q", "base", turns(rng, X, 2))
    free = null_basis(closure(edges))[0]
    order = rng.permutation(len(edges))
    shuffled = [turned(edges[i]) if rng.integers(2) else edges[i] for i in order]
    again = null_basis(closure(shuffled))[0]
    np.testing.assert_allclose(again @ again.T, (free @ free.T)[np.ix_(order, order)], atol=1e-10)


def test_an_edge_that_closes_on_one_link_is_a_loop():
    (edge,) = chain("A", "base", "base", [[turn(Z, X), slide(X)]])
    assert closure([edge]).shape == (1, 6, 2)
    assert rank(closure([edge])) == 2


def test_configurations_of_lower_rank_are_left_out_and_the_rest_sorted():
    rng = np.random.default_rng(0)
    good = chain("A", "base", "base", turns(rng, Z, 4))
    twists = [edge.twists[0] for edge in good]
    near = twists[0] + 1e-4 * rng.normal(size=(6, 1)) * [[0], [0], [0], [1], [1], [0]]
    edges = [
        dataclasses.replace(edge, twists=np.stack([twists[0], near if i else twists[0], twists[i]]))
        for i, edge in enumerate(good)
    ]
    kept = at_generic(edges)
    assert rank(closure(edges)) == 3
    assert len(kept[0].twists) == len(null_basis(closure(edges))) == 1
    np.testing.assert_array_equal(kept[2].twists[0], twists[2])
    better = [
        dataclasses.replace(e, twists=np.concatenate([e.twists, r.twists])) for e, r in zip(edges, good, strict=True)
    ]
    assert len(at_generic(better)[0].twists) == 2


def test_best_conditioned_configuration_comes_first():
    rng = np.random.default_rng(0)
    good = chain("A", "base", "base", turns(rng, Z, 4))
    squeezed = np.diag([1, 1, 1, 1e-4, 1, 1])
    edges = [dataclasses.replace(e, twists=np.concatenate([squeezed @ e.twists, e.twists])) for e in good]
    kept = at_generic(edges)
    assert len(kept[0].twists) == 2
    for edge, first in zip(good, kept, strict=True):
        np.testing.assert_array_equal(first.twists[0], edge.twists[0])


def test_edges_without_loops_keep_every_configuration():
    edges = chain("A", "base", "p", turns(np.random.default_rng(0), Z, 2))
    assert at_generic(edges) == tuple(edges)


def test_rounding_errors_have_no_rank_at_a_given_scale():
    dust = 1e-15 * np.random.default_rng(0).normal(size=(1, 6, 2))
    assert rank(dust, scale=1.0) == 0
    assert null_basis(dust, scale=1.0).shape == (1, 2, 2)


def test_columns_have_names_and_inputs():
    edges = chain("A", "base", "p", [ball(X), [slide(Y)]], (1,))
    assert column_names(edges) == ("AJ1.1", "AJ1.2", "AJ1.3", "AJ2")
    assert input_columns(edges) == [3]
