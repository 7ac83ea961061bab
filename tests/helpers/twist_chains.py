"""Chains of joints as edges of twists, for tests that need no file of a mechanism."""

import numpy as np

from assur.topology.screws.edges import Edge

X, Y, Z = np.eye(3)


def turn(axis, point):
    return np.array([*axis, *np.cross(point, axis)])


def slide(axis):
    return np.array([0.0, 0.0, 0.0, *axis])


def ball(point):
    return [turn(axis, point) for axis in (X, Y, Z)]


def turns(rng, axis, count):
    """R joints with parallel axes at random places, one edge each."""
    return [[turn(axis, rng.normal(size=3))] for _ in range(count)]


def across(rng, axis):
    """A random direction of length 1 across another."""
    found = np.cross(axis, rng.normal(size=3))
    return found / np.linalg.norm(found)


def chain(name, start, end, joints, actuated=(), letter="J"):
    """Edges in series between two links; `joints` are lists of twists, of those actuated the first component is."""
    links = [start, *(f"{name}{i}" for i in range(1, len(joints))), end]
    columns = [np.stack(item, axis=-1)[None] for item in joints]
    return [
        Edge(f"{name}{letter}{i + 1}", *links[i : i + 2], twists, (), (0,) if i in actuated else (), len(joints[i]) < 3)
        for i, twists in enumerate(columns)
    ]
