"""Continuation: the inverse problem at every node of a grid of poses, each solved from a neighbour that is solved.

From one assembly a working mode is followed over the grid, front by front. A step goes along the tangent and is
corrected; it is taken where the loops close, no joint value moves far, the signs that name the working mode stay,
and no two branches merge on the way (`platform_held.passes_zero`). What is reached is the part of the working mode
that hangs together with the start.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.ending import Mode, blocks
from assur.kinematics.following.followed_grid import Continuation, ModeEnds
from assur.kinematics.following.neighbours import Steps

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]


def continued(
    mode: Mode,
    axes: tuple[FloatArray, ...],
    start: tuple[FloatArray, FloatArray] | None,
    tick: Callable[[float], None] | None = None,
) -> Continuation:
    """Follow a working mode over a grid.

    Args:
        mode: the mechanism, the signs of its working quantities that must stay, and the poses of points.
        axes: the nodes' coordinates along each of d axes, evenly spaced.
        start: a point (d,) and joint values (n,) assembled there; None where there is none.
        tick: called with the share that is done, as far as can be known.

    Example: the five-bar over a column of poses; its elbows straighten 285.5 above the motors.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.named_signs import named_signs
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)
    >>> upwards = Mode(record, named_signs(record, "inverse", home), lambda y: np.concatenate([0 * y, y], axis=1))
    >>> found = continued(upwards, (np.linspace(200.0, 300.0, 11),), (pose_of(record, home)[1:], home))
    >>> found.reached.astype(int).tolist(), found.border(np.array([[280.0]]), np.array([[290.0]]))[0].round(4)
    ([1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0], array([0.5545]))
    """
    shape = tuple(len(axis) for axis in axes)
    joints = np.full((*shape, len(mode.record.coordinates)), np.nan)
    none = np.zeros((0, len(axes)), dtype=np.intp)
    nowhere = np.full((*shape, 2 * len(axes)), -1)
    ends = ModeEnds(none, none, np.zeros(0), np.zeros((0, joints.shape[-1])), nowhere)
    continuation = Continuation(mode, axes, joints, np.full(shape, np.nan), ends)
    if start is None:
        return continuation
    node = np.array([np.argmin(np.abs(axis - value)) for axis, value in zip(axes, start[0], strict=True)])
    point = np.array([axis[k] for axis, k in zip(axes, node, strict=True)])
    first, good = mode.stepped(start[1][None], start[0][None], point[None])
    if not good[0]:
        return continuation
    joints[tuple(node)] = first[0]
    rounds = sum(max(k, size - 1 - k) for k, size in zip(node.tolist(), shape, strict=True))
    front = node[None]
    done = 0
    while len(front):
        front = _spread(continuation, front)
        if not len(front):
            front = _across_the_rim(continuation)
        done += 1
        if tick is not None:
            tick(min(done / max(rounds, 1), 1.0))
    return replace(continuation, ends=_ends(continuation))


def _spread(continuation: Continuation, front: IntArray) -> IntArray:
    """Step from the nodes (N, d) of a front to their neighbours, each from one of them; what is new (M, d)."""
    new = [front[:0]]
    for rows in blocks(front):
        steps = _steps(continuation, rows)
        continuation.serial[tuple(rows.T)] = steps.held.serial
        tails, heads, _ = _edges(continuation, rows)
        heads, first = np.unique(heads, axis=0, return_index=True)
        new.append(
            _taken(continuation, heads, *steps.of(tails[first]).to(continuation.mode.poses(continuation.points(heads))))
        )
    return np.concatenate(new)


def _taken(continuation: Continuation, heads: IntArray, steps: Steps, good: BoolArray) -> IntArray:
    """Those of the nodes (N, d) that a step may be taken to, their joint values kept."""
    continuation.joints[tuple(heads[good].T)] = steps.places.joints[good]
    return heads[good]


def _across_the_rim(continuation: Continuation) -> IntArray:
    """Try what lies beside reached nodes once more, in small steps from the best neighbour; what is new (M, d)."""
    reached = np.argwhere(np.isfinite(continuation.joints[..., 0]))
    tails, heads, _ = _edges(continuation, reached)
    best = np.argsort(-continuation.serial[tuple(reached[tails].T)], kind="stable")
    tails, heads = tails[best], heads[best]
    heads, first = np.unique(heads, axis=0, return_index=True)
    new = [heads[:0]]
    for rows in blocks(np.arange(len(heads))):
        steps = _steps(continuation, reached[tails[first[rows]]])
        new.append(
            _taken(
                continuation, heads[rows], *steps.in_parts(continuation.mode.poses(continuation.points(heads[rows])))
            )
        )
    return np.concatenate(new)


def _ends(continuation: Continuation) -> ModeEnds:
    """Where the mode ends on every edge from a reached node to another."""
    reached = np.argwhere(np.isfinite(continuation.joints[..., 0]))
    tails, heads, ways = _edges(continuation, reached)
    nodes = reached[tails]
    share, joints = continuation.mode.ends(
        continuation.joints[tuple(nodes.T)], continuation.points(nodes), continuation.points(heads)
    )
    place = continuation.ends.place.copy()
    place[(*nodes.T, ways)] = np.arange(len(nodes))
    return ModeEnds(nodes, heads, share, joints, place)


def _steps(continuation: Continuation, nodes: IntArray) -> Steps:
    return continuation.mode.steps(continuation.joints[tuple(nodes.T)], continuation.points(nodes))


def _edges(continuation: Continuation, front: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Edges from a front: places in it (E,), neighbours (E, d) that are not reached, and which way they lie (E,)."""
    ways = np.concatenate([np.eye(len(continuation.axes)), -np.eye(len(continuation.axes))]).astype(np.intp)
    heads = (front[:, None] + ways).reshape(-1, len(continuation.axes))
    tails, which = (values.ravel() for values in np.indices((len(front), len(ways))))
    inside = np.all((heads >= 0) & (heads < continuation.joints.shape[:-1]), axis=1)
    inside[inside] = np.isnan(continuation.joints[(*heads[inside].T, 0)])
    return tails[inside], heads[inside], which[inside]
