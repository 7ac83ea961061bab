"""Where labelled points may lie: anywhere, but on the axes that run through several of them, along their directions.

An axis in the direction d that runs through A and B says d × (A - B) = 0. All that labels say is a system of such
equations, so that points that nothing else ties are a general solution of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from assur.topology.chains import Chain, ChainJoint
from assur.topology.directions import Vector

FloatArray = NDArray[np.float64]

APART = 1e-6
"""Points of a general solution that are nearer than this are one point in all."""

Tie = tuple[str, str, Vector]
"""Two points and the direction of an axis through both."""


def centre_of(joint: ChainJoint, name: str) -> str:
    """The label of a joint's point or centre; one of its own, made of its name, where nothing labels it."""
    return joint.point or f"#{name}"


def tied_points(chains: Sequence[Chain], names: Sequence[str], rng: np.random.Generator) -> dict[str, FloatArray]:
    """General positions (3,) of all points that lie on an axis with others, centres of joints among them.

    Args:
        chains: with labels.
        names: of their joints, in the order of the text.
        rng: gives the general solution; the points stand in a box of size about 2.

    >>> from assur.topology.notation import parse_chains
    >>> chains = parse_chains(["R[x]@A@B R[y]@A", "R[z]@B"])
    >>> places = tied_points(chains, ["R1", "R2", "R3"], np.random.default_rng(0))
    >>> sorted(places), bool(abs(places["A"] - places["B"])[1:].max() < 1e-12)
    (['A', 'B'], True)
    """
    ties = list(_ties(chains, names))
    labels = sorted({label for near, far, _ in ties for label in (near, far)})
    if not ties:
        return {}
    rows = np.zeros((len(ties), 3, len(labels), 3))
    for row, (near, far, direction) in zip(rows, ties, strict=True):
        across = np.eye(3) - np.outer(direction, direction)
        row[:, labels.index(near)] += across
        row[:, labels.index(far)] -= across
    _, singular, turned = np.linalg.svd(rows.reshape(3 * len(ties), 3 * len(labels)))
    basis = turned[int(np.sum(singular > APART)) :]
    places = (rng.uniform(-1.0, 1.0, 3 * len(labels)) @ basis.T @ basis).reshape(len(labels), 3)
    return dict(zip(labels, places, strict=True))


def merged(chains: Sequence[Chain], names: Sequence[str]) -> tuple[str, str] | None:
    """Two labels that the axes leave no choice but to be one point; None where there are none.

    >>> from assur.topology.notation import parse_chains
    >>> from assur.topology.chains import Chain
    >>> first, second = parse_chains(["R[x]@A@B", "R[y]@A"])[0].joints[0], parse_chains(["R[y]@A@B"])[0].joints[0]
    >>> merged([Chain((first,)), Chain((second,))], ["R1", "R2"])
    ('A', 'B')
    """
    places = tied_points(chains, names, np.random.default_rng(0))
    written = ((label, place) for label, place in places.items() if not label.startswith("#"))
    for (first, place), (second, other) in combinations(written, 2):
        if float(np.max(np.abs(place - other))) < APART:
            return first, second
    return None


def _ties(chains: Sequence[Chain], names: Sequence[str]) -> Iterator[Tie]:
    joints = (joint for chain in chains for joint in chain.joints)
    for joint, name in zip(joints, names, strict=True):
        if isinstance(joint, ChainJoint) and joint.through:
            centre = centre_of(joint, name)
            for axis, further in zip(joint.axes, joint.through, strict=True):
                labels = [centre, *(label for label in further if label != centre)]
                yield from ((near, far, axis) for near, far in pairwise(labels))
