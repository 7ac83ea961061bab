"""Relaxation: joints with more freedoms in the place of joints, so that redundant constraints vanish.

A redundant constraint is one that the others imply; it asks for exact making and stresses the parts. A revolute
joint that becomes cylindrical, universal or spherical, or a prismatic one that becomes cylindrical, gives it up. The
mechanism must move as before: its old motions stay possible, so if the platform and the inputs span no more than
before, nothing that is new moves, except internally.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.results.answers.topology import Relaxation, Replacement
from assur.topology.counting.mobility import motions
from assur.topology.screws.edges import Edge, closure, rank

FloatArray = NDArray[np.float64]

TURN = 1e-9
"""Rotation (or pitch) below which a unit twist is a pure translation (or a pure rotation)."""

FREQUENCIES = (1.0, 2.0**0.5, 3.0**0.5)
"""Of the sines that put the new axes in general places: nothing forces them to be parallel or to meet."""


def relaxation(edges: Sequence[Edge], base: str, platform: str) -> Relaxation:
    """Which joints could be relaxed, one by one and together.

    R becomes C, U or S unless it is actuated, P becomes C. The second axis of a U, the centre of a U or S on the old
    axis, and the axis of a C in the place of a P are in general places: the maker chooses them. Generalised joints
    stay as they are: ask on the joint graph for the joints inside them.

    Args:
        edges: with twists at generic configurations.
        base: a link.
        platform: a link.

    >>> turn = lambda *point: np.array([0, 0, 1, *np.cross(point, (0, 0, 1))], float).reshape(1, 6, 1)
    >>> links = ("base", "crank", "rod", "rocker", "base")
    >>> points = ((0, 0, 0), (1, 2, 0), (4, 2.5, 0), (5, 0, 0))
    >>> driven = ((0,), (), (), ())
    >>> bars = [Edge(f"R{i + 1}", *links[i : i + 2], turn(*points[i]), (), driven[i]) for i in range(4)]
    >>> for item in relaxation(bars, "base", "rod").together:
    ...     print(item)
    R2: R to S removes 2
    R3: R to C removes 1
    """
    start = _State(tuple(edges), rank(closure(edges)), motions(edges, base, platform).useful.shape[-1])
    options = [(edge.name, new) for edge in edges for new in _options(edge)]
    single = [replacement for replacement, _ in _tried(start, options, base, platform)]
    together: list[Replacement] = []
    now, useful = start, single
    while useful:
        # A replacement that is of no use now is of none later: redundancy only shrinks and motions only grow.
        names = {replacement.joint for replacement in together}
        left = [(replacement.joint, replacement.new) for replacement in useful if replacement.joint not in names]
        tried = list(_tried(now, left, base, platform))
        useful = [replacement for replacement, _ in tried]
        if tried:
            chosen, now = min(tried, key=lambda pair: _preference(pair[0]))
            together.append(chosen)
    return Relaxation(closure(edges).shape[1] - start.rank, tuple(single), tuple(together))


@dataclass(frozen=True, eq=False)
class _State:
    """Edges, the rank of their closure, and the dimension of their motions less internal ones."""

    edges: tuple[Edge, ...]
    rank: int
    useful: int


def _tried(
    state: _State, options: Sequence[tuple[str, str]], base: str, platform: str
) -> Iterator[tuple[Replacement, _State]]:
    """The options that remove redundant constraints and leave the useful motions as they are."""
    for name, new in options:
        index = next(i for i, edge in enumerate(state.edges) if edge.name == name)
        old = state.edges[index]
        added = _added(old, new, np.sin(np.multiply(FREQUENCIES, index + 1)))
        edge = dataclasses.replace(old, twists=np.concatenate([old.twists, added], axis=-1))
        edges = (*state.edges[:index], edge, *state.edges[index + 1 :])
        removed = rank(closure(edges)) - state.rank
        if removed and motions(edges, base, platform).useful.shape[-1] == state.useful:
            letter = "P" if _slides(old) else "R"
            yield (
                Replacement(name, letter, new, removed, added.shape[-1] - removed),
                _State(edges, state.rank + removed, state.useful),
            )


def _preference(replacement: Replacement) -> tuple[int, int]:
    """Best first: most removed, then fewest internal freedoms."""
    return -replacement.removed, replacement.internal


def _slides(edge: Edge) -> bool:
    return bool(np.max(np.abs(edge.twists[:, :3])) < TURN)


def _turns(edge: Edge) -> bool:
    turning, moving = edge.twists[:, :3, 0], edge.twists[:, 3:, 0]
    return bool(np.all(np.abs(np.sum(turning * moving, axis=-1)) < TURN) and np.all(np.sum(turning**2, axis=-1) > TURN))


def _options(edge: Edge) -> tuple[str, ...]:
    """What may stand in the place of a joint."""
    if edge.freedoms != 1 or len(edge.joints) > 1:
        return ()
    if _slides(edge):
        return ("C",)
    return ("C", "U", "S") if _turns(edge) and not edge.inputs else ()


def _added(edge: Edge, new: str, place: FloatArray) -> FloatArray:
    """Twists (N, 6, 1 or 2) of the freedoms that a new joint has beside the old one, at a place (3,) of its own."""
    slides = _slides(edge)
    along = edge.twists[:, 3:, 0] if slides else edge.twists[:, :3, 0]
    along = along / np.linalg.norm(along, axis=-1, keepdims=True)
    if slides:
        return _rotations(along, np.broadcast_to(place, along.shape))[..., None]
    if new == "C":
        return np.concatenate([np.zeros_like(along), along], axis=-1)[..., None]
    foot = np.cross(edge.twists[:, :3, 0], edge.twists[:, 3:, 0])
    centre = foot / np.sum(edge.twists[:, :3, 0] ** 2, axis=-1, keepdims=True) + place[0] * along
    across = np.cross(along, place)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    axes = [across] if new == "U" else [across, np.cross(along, across)]
    return np.stack([_rotations(axis, centre) for axis in axes], axis=-1)


def _rotations(axes: FloatArray, points: FloatArray) -> FloatArray:
    """Twists (N, 6) of rotations about axes through points."""
    return np.concatenate([axes, np.cross(points, axes)], axis=-1)
