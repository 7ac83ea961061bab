"""Chains of joints as edges of twists, for tests that need no file of a mechanism; what linkages give directly."""

import numpy as np

from assur.topology.screws.edges import Edge
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.twists import edges, generic_values, motion_space

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


def joint_twists(linkage, values):
    """Twists (N, 6, n) of child against parent per unit of each joint value: (omega, v at the base's origin)."""
    tree = screw_tree(linkage)
    twists = tree.at(values / tree.scales).twists / tree.scales
    omega = twists[:, :3]
    moved = linkage.length * twists[:, 3:] + np.cross(linkage.point, omega, axisb=1, axisc=1)
    return np.concatenate([omega, moved], axis=1)


def poses(linkage, values):
    """Displacements from home of all links: link -> rotation (N, 3, 3) and translation (N, 3), in the base frame."""
    tree = screw_tree(linkage)
    placed, found = tree.at(values / tree.scales).frames, {}
    for link, frame in tree.frames.items():
        rotation = placed[:, frame, :3, :3]
        shift = linkage.point - rotation @ linkage.point + linkage.length * placed[:, frame, :3, 3]
        found[link] = rotation, shift
    return found


def residuals(linkage, values):
    """By how much each loop is open, (N, 6 v): rotation vector in rad and gap in lengths of the linkage."""
    return _loops(linkage, values)[0].reshape(len(values), -1)


def closure_jacobian(linkage, values):
    """Derivative (N, 6 v, n) of `residuals` by the joint values; exact also where the loops are open."""
    jacobian = _loops(linkage, values)[1] / screw_tree(linkage).scales
    return jacobian.reshape(len(values), -1, values.shape[1])


def _loops(linkage, values):
    tree = screw_tree(linkage)
    return tree.misfit(tree.at(values / tree.scales), *tree.loops.T)


def limb_motion(edges, joints, base, link):
    """Basis (N, 6, k) of what a limb alone would let its end link do, at the same configurations."""
    return motion_space([edge for edge in edges if edge.name in set(joints)], base, link)


def generic_edges(linkage, *, count=4, seed=0, hold=None, collapsed=True):
    """The joints as edges at `generic_values`; see there and at `edges`."""
    return edges(linkage, generic_values(linkage, count, seed, hold), collapsed)
