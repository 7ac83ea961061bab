"""Starts of a search: joint values by chance, and such as known assemblies suggest.

Assemblies of one problem share most of what their limbs do. Joints of one beside those of another, or beside some that
are drawn anew, close more often, in fewer steps, and on rare assemblies no less than on others.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.kinematics.home import home_values
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]

REDRAWN = 0.3
"""Share of the joints of a known assembly that are drawn anew: with more the rest is no help, with fewer the start
leads back to where it came from."""


def by_chance(record: MechanismRecord, count: int, rng: np.random.Generator) -> FloatArray:
    """Joint values (count, n): angles anywhere on the circle, ball joints anywhere, lengths and screws around home.

    Lengths lie within twice the characteristic length of home, screws where they advance as far.

    >>> from assur.model.registry import load_record
    >>> by_chance(load_record("fivebar"), 4, np.random.default_rng(0)).shape
    (4, 5)
    """
    home, units = home_values(record), joint_units(record)
    spread = rng.uniform(-1.0, 1.0, size=(count, len(home)))
    angles = (units == 1.0) & [item.kind == "angle" for item in record.coordinates]
    starts = home + np.where(angles, np.pi, 2.0 * units) * spread
    for place in joint_graph(record).turns:
        quaternion = rng.normal(size=(count, 4))
        quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
        starts[:, place] = rotations.to_vector(rotations.from_quaternion(quaternion))
    return np.asarray(starts)


def redrawn(record: MechanismRecord, known: FloatArray, count: int, rng: np.random.Generator) -> FloatArray:
    """Known assemblies (K, n), each as often, in which some joints are drawn anew: (count, n)."""
    return _exchanged(record, _each(known, count), by_chance(record, count, rng), REDRAWN, rng)


def mixed(record: MechanismRecord, known: FloatArray, count: int, rng: np.random.Generator) -> FloatArray:
    """Known assemblies (K, n), each as often, in which about half of the joints stand as in another: (count, n)."""
    return _exchanged(record, _each(known, count), known[rng.integers(len(known), size=count)], 0.5, rng)


def _each(known: FloatArray, count: int) -> FloatArray:
    return known[np.arange(count) % len(known)]


def _exchanged(
    record: MechanismRecord, first: FloatArray, second: FloatArray, share: float, rng: np.random.Generator
) -> FloatArray:
    """Joint values (N, n) of the first, a share of the joints as in the second."""
    answer = first.copy()
    for place in joint_graph(record).slices.values():
        rows = rng.random(len(first)) < share
        answer[rows, place] = second[rows, place]
    return answer
