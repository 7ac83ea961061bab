"""The coupling degree by Eq. (4) itself, with motion spaces, over all orders of limbs: a second route."""

import dataclasses
from itertools import permutations

import numpy as np
import pytest

from assur.topology.counting.coupling import coupling
from assur.topology.counting.mobility import mobility
from coupled_mechanisms import (
    crr,
    delta_4r,
    delta_4s,
    gough,
    limbs,
    orthoglide,
    planar_rpr,
    planar_rrr,
    rps,
    rrc,
    tricept,
    tripteron,
    ups_limb,
    upu,
)
from twist_chains import X, Z, slide, turns


def space(matrix):
    left, singular, _ = np.linalg.svd(matrix)
    return left[:, : int(np.sum(singular > 1e-9))]


def common(first, second):
    """Orthonormal basis of what two spaces share: the complement of the sum of their complements."""
    complements = [np.eye(6) - basis @ basis.T for basis in (first, second)]
    left, singular, _ = np.linalg.svd(np.hstack(complements))
    return left[:, int(np.sum(singular > 1e-9)) :]


def by_equation_4(edges):
    """The totals Σ|Δ| of all permutations of limbs, ξ = dim{(∩ M_bi) ∪ M_b(j+1)}."""
    parts = {}
    for edge in edges:
        parts.setdefault(edge.name[:2], []).append(edge)
    data = [
        (
            space(np.hstack([edge.twists[0] for edge in part])),
            sum(edge.freedoms for edge in part),
            sum(len(edge.inputs) for edge in part),
        )
        for part in parts.values()
    ]
    totals = set()
    for order in permutations(data):
        meet, freedoms, inputs = order[0]
        total = 0
        for index, (motion, more, new) in enumerate(order[1:]):
            xi = space(np.hstack([meet, motion])).shape[1]
            delta = more + (freedoms if index == 0 else 0) - new - (inputs if index == 0 else 0) - xi
            total += abs(delta)
            meet = common(meet, motion)
        totals.add(total)
    return totals


PARALLEL = [delta_4r, orthoglide, delta_4s, upu, tripteron, crr, rrc, planar_rrr, planar_rpr, rps, gough, tricept]


@pytest.mark.parametrize("build", PARALLEL, ids=[build.__name__ for build in PARALLEL])
def test_equation_4_gives_the_same_coupling_degree(build):
    edges = build(np.random.default_rng(5))
    assert 2 * coupling(edges).coupling_degree == min(by_equation_4(edges))


def random_limb(rng):
    """A limb with one input whose motions are planar, Schoenflies, five-dimensional or all."""
    kind = rng.integers(4)
    if kind == 0:
        return turns(rng, Z, 3)
    if kind == 1:
        return [*turns(rng, Z, 3), [slide(rng.normal(size=3))]]
    if kind == 2:
        return [*turns(rng, Z, 3), *turns(rng, X, 2)]
    return [*turns(rng, Z, 3), *turns(rng, X, 3)] if rng.integers(2) else ups_limb(rng)


@pytest.mark.parametrize("seed", range(12))
def test_equation_4_gives_the_same_on_random_limbs(seed):
    rng = np.random.default_rng(seed)
    edges = limbs([random_limb(rng) for _ in range(4)])
    freedoms = mobility(edges, "base", "p").dof
    spare = [edge.name for edge in edges if edge.freedoms == 1 and not edge.inputs]
    driven_too = set(spare[: max(freedoms - 4, 0)])
    edges = [dataclasses.replace(edge, inputs=(0,)) if edge.name in driven_too else edge for edge in edges]
    found = coupling(edges)
    assert sum(abs(loop.delta) for loop in found.loops) == min(by_equation_4(edges))


def test_orders_of_the_tricept_have_two_totals():
    assert by_equation_4(tricept(np.random.default_rng(3))) == {4, 8}
