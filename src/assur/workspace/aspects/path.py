"""Paths: a polyline between two poses of one aspect, with the boxes in which its pieces lie for a certificate.

Boxes are convex, so a straight piece between two points of a box stays in it: the polyline passes from box to box
through a point of the face that two of them share, and every pose on it is reached and not singular.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from assur.workspace.aspects.adjacency import shared_faces
from assur.workspace.aspects.places import Place, place
from assur.workspace.aspects.search import BoxSearch
from assur.workspace.aspects.turning import Ends, ends_of, moved, turns
from assur.workspace.certified.boxes import Boxes, together
from assur.workspace.certified.planes import judged
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

INNER = 0.25
"""The path keeps this share of a face away from its edges, which may lie on a border."""

SWEEPS = 200
"""Times that the points on faces are moved to make the path shorter."""

Verdict = Literal["connected", "separated", "undecided", "outside"]


@dataclass(frozen=True, eq=False)
class AspectPath:
    """Whether two poses lie in one aspect, and a path between them.

    Attributes:
        status: "connected": one aspect, and here is a path; "separated": certainly two, inside the box looked at;
            "undecided"; "outside": one of the poses is not reached, or beyond the box.
        why: in words, where they are not connected.
        start, end: where the two poses are.
        coordinates: of the points, those that vary.
        points: (n, free) vertices of the path; empty where there is none. An angle that goes beyond the end of its turn
            goes on: the last vertex is then the pose asked for after whole turns, rounded.
        names: coordinates of the boxes; nothing depends on the others.
        boxes: n - 1 boxes; the piece from vertex k to k + 1 lies in box k, in which every pose is proved.
    """

    status: Verdict
    why: str
    start: Place = field(repr=False)
    end: Place = field(repr=False)
    coordinates: tuple[str, ...]
    points: FloatArray = field(repr=False)
    names: tuple[str, ...]
    boxes: Boxes = field(repr=False)


def path_between(
    state: BoxSearch, labels: Sequence[str], names: tuple[str, ...], first: FloatArray, last: FloatArray
) -> AspectPath:
    """The path between two points (free,); labels are those of the components."""
    box = state.frame.box
    start, end = place(state, labels, first), place(state, labels, last)
    status, why = _verdict(state, start, end)
    if status != "connected":
        return AspectPath(status, why, start, end, box.names, np.zeros((0, len(box.names))), names, state.certain[:0])
    chain = _chain(state, start.box, end.box)
    ends = ends_of(state.frame)
    count = turns(state.certain[chain], ends)
    passed = _shifted(state.certain[chain], count, ends)
    final = count[:, -1:]
    arrival = _shifted(end.boxes[::-1], final, ends)
    if count.any() and not judged(state.frame, together([passed, arrival]), shares=False).inside.all():
        why = "rounding leaves a box undecided where the angle goes on beyond its end"
        return AspectPath("undecided", why, start, end, box.names, np.zeros((0, len(box.names))), names, passed[:0])
    finish = moved(end.points[::-1].T, final, ends).T
    corners = _pulled(passed, start.points[-1], finish[0], _extent(box, state.frame.used))
    points = np.concatenate([start.points[:-1], corners, finish[1:]])
    boxes = together([start.boxes, passed, arrival])
    whole = _whole(points, state.frame.used, first, last, _extent(box, state.frame.used))
    return AspectPath("connected", "", start, end, box.names, whole, names, boxes)


def _shifted(boxes: Boxes, count: NDArray[np.int64], ends: Ends) -> Boxes:
    """Boxes after so many turns (k, 1) or (k, N), rounded."""
    count = np.broadcast_to(count, boxes.low.shape)
    return Boxes(moved(boxes.low, count, ends), moved(boxes.high, count, ends))


def _verdict(state: BoxSearch, start: Place, end: Place) -> tuple[Verdict, str]:
    for word, item in (("from", start), ("to", end)):
        if item.status in ("outside", "beyond"):
            return "outside", f"{word}: {item.why}"
    apart = [name for name in start.signs if name in end.signs and start.signs[name] != end.signs[name]]
    if apart:
        signs = {1: "positive", -1: "negative"}
        told = [
            f"{name} is {signs[start.signs[name]]} at one and {signs[end.signs[name]]} at the other" for name in apart
        ]
        return "separated", f"{'; '.join(told)}: singular or not reached on every way between them"
    for word, item in (("from", start), ("to", end)):
        if item.status == "undecided":
            return "undecided", f"{word}: {item.why}"
    one, two = (int(state.links.component[item.box]) for item in (start, end))
    if one == two:
        return "connected", ""
    if state.links.group[one] == state.links.group[two]:
        return "undecided", "undecided boxes may join the two parts; look with a smaller size"
    return "separated", "inside the box only poses that are not reached, or singular, lie between them"


def _extent(box: Box, used: Sequence[bool]) -> FloatArray:
    return np.asarray(np.subtract(box.high, box.low)[list(used)])


def _chain(state: BoxSearch, first: int, last: int) -> IntArray:
    """Numbers of the fewest boxes from one to another, each of which shares a face with the next."""
    own = np.flatnonzero(state.links.component == state.links.component[first])
    boxes = state.certain[own]
    ends = ends_of(state.frame)
    pairs, _ = shared_faces(boxes, ends)
    middles = boxes.middles / _extent(state.frame.box, state.frame.used)[:, None]
    apart = middles[:, pairs[:, 0]] - middles[:, pairs[:, 1]]
    turning = [pair is not None for pair in ends]
    apart[turning] -= np.round(apart[turning])
    lengths = 1.0 + np.sqrt(np.sum(apart**2, axis=0))
    graph = coo_array((lengths, (pairs[:, 0], pairs[:, 1])), shape=(len(own), len(own))).tocsr()
    start, end = np.searchsorted(own, [first, last])
    _, before = dijkstra(graph, directed=False, indices=np.array([start]), return_predecessors=True)
    found = [int(end)]
    while found[-1] != start:
        found.append(int(before[0, found[-1]]))
    return own[found[::-1]]


def _pulled(boxes: Boxes, start: FloatArray, end: FloatArray, extent: FloatArray) -> FloatArray:
    """Vertices (N + 1, k) of a short polyline through N boxes in turn: start, a point on each face, end."""
    low = np.maximum(boxes.low[:, :-1], boxes.low[:, 1:]).T  # (N - 1, k), the faces
    high = np.minimum(boxes.high[:, :-1], boxes.high[:, 1:]).T
    inner = INNER * (high - low)
    points = np.concatenate([start[None], np.clip(0.5 * low + 0.5 * high, low, high), end[None]])
    across = np.argmin((high - low) / extent, axis=1)
    rows = np.arange(len(low))
    for sweep in range(SWEEPS if len(low) else 0):
        turn = rows[sweep % 2 :: 2]  # every second point, between neighbours that stand still
        before, after, axis = points[turn], points[turn + 2], across[turn]
        every = np.arange(len(turn))
        way = (after - before)[every, axis]
        share = (low[turn, axis] - before[every, axis]) / np.where(way == 0, 1.0, way)
        share = np.where(way == 0, 0.5, np.clip(share, 0.0, 1.0))
        meeting = before + share[:, None] * (after - before)
        points[turn + 1] = np.clip(meeting, low[turn] + inner[turn], high[turn] - inner[turn])
    points[1:-1] = np.clip(points[1:-1], low, high)
    return points


def _whole(
    points: FloatArray, used: Sequence[bool], first: FloatArray, last: FloatArray, extent: FloatArray
) -> FloatArray:
    """Points (n, free) from those (n, k) of the coordinates that matter; the others change evenly along the way."""
    steps = np.sqrt(np.sum((np.diff(points, axis=0) / extent) ** 2, axis=1))
    done = np.concatenate([[0.0], np.cumsum(steps)])
    share = done / done[-1] if done[-1] > 0 else np.linspace(0.0, 1.0, len(points))
    whole = first + share[:, None] * (last - first)
    whole[0], whole[-1] = first, last
    whole[:, list(used)] = points
    return whole
