"""Layers: a directed graph without cycles on rows, with few crossings and short arrows (after Sugiyama).

An arrow over several rows is given a waypoint on each row between; waypoints are placed like boxes without width.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError

FloatArray = NDArray[np.float64]
SWEEPS = 24


@dataclass(frozen=True)
class Layout:
    """Rows and places of the nodes.

    Attributes:
        row: node -> row, 0 at the top.
        centre: node or waypoint -> its middle along the row.
        routes: (from, to) -> the waypoints between, from the top.
    """

    row: Mapping[str, int]
    centre: Mapping[str, float]
    routes: Mapping[tuple[str, str], tuple[str, ...]]


def rows(needs: Mapping[str, Sequence[str]], first: Sequence[str], last: Sequence[str]) -> dict[str, int]:
    """Row of every node: below all it needs; `first` at the top, `last` at the bottom, other sources just above use.

    >>> rows({"a": (), "b": ("a",), "c": ("b", "k"), "k": ()}, ["a"], ["c"])
    {'a': 0, 'b': 1, 'c': 2, 'k': 1}
    """
    row: dict[str, int] = {}
    waiting = dict(needs)
    while waiting:
        ready = [name for name, wants in waiting.items() if all(want in row for want in wants)]
        if not ready:
            raise UsageError(f"these steps need one another or what is not there: {', '.join(waiting)}")
        for name in ready:
            wants = waiting.pop(name)
            floor = 0 if name in first else 1
            row[name] = max([floor, *(row[want] + 1 for want in wants)])
    bottom = max(row.values())
    for name, wants in needs.items():
        users = [row[user] for user, used in needs.items() if name in used]
        if name in last and not users:
            row[name] = bottom
        elif not wants and name not in first and users:
            row[name] = max(0, min(users) - 1)
    return {name: row[name] for name in needs}


def layout(
    needs: Mapping[str, Sequence[str]], row: Mapping[str, int], width: Mapping[str, float], gap: float
) -> Layout:
    """Places along the rows, no two nodes nearer than `gap`.

    >>> found = layout({"a": (), "b": ("a",)}, {"a": 0, "b": 1}, {"a": 10.0, "b": 10.0}, 5.0)
    >>> found.centre["a"] == found.centre["b"]
    True
    """
    level, arrows, routes = dict(row), [], {}
    for name, wants in needs.items():
        for want in wants:
            steps = tuple(f"{want}>{name}@{k}" for k in range(row[want] + 1, row[name]))
            level |= {step: row[want] + 1 + k for k, step in enumerate(steps)}
            routes[want, name] = steps
            path = (want, *steps, name)
            arrows += list(pairwise(path))
    order = _ordered(level, arrows)
    sizes = {name: width.get(name, 0.0) for name in level}
    return Layout(dict(row), _placed(order, arrows, sizes, gap), routes)


def _ordered(level: Mapping[str, int], arrows: Sequence[tuple[str, str]]) -> list[list[str]]:
    """Each row in the order with the fewest crossings that sweeps of barycentres find."""
    count = max(level.values()) + 1
    order = [[name for name in level if level[name] == k] for k in range(count)]
    best, fewest = order, _crossings(order, arrows)
    for sweep in range(SWEEPS):
        down = sweep % 2 == 0
        for k in range(1, count) if down else range(count - 2, -1, -1):
            fixed = {name: place for place, name in enumerate(order[k - 1 if down else k + 1])}
            near = {
                name: [
                    fixed[a if down else b]
                    for a, b in arrows
                    if (b if down else a) == name and (a if down else b) in fixed
                ]
                for name in order[k]
            }
            key = {
                name: float(np.mean(near[name])) if near[name] else float(place) for place, name in enumerate(order[k])
            }
            order = [*order[:k], sorted(order[k], key=lambda name, key=key: key[name]), *order[k + 1 :]]  # type: ignore[misc]
        found = _crossings(order, arrows)
        if found < fewest:
            best, fewest = order, found
    return best


def _crossings(order: Sequence[Sequence[str]], arrows: Sequence[tuple[str, str]]) -> int:
    place = {name: (k, j) for k, names in enumerate(order) for j, name in enumerate(names)}
    ends = [(place[a], place[b]) for a, b in arrows]
    total = 0
    for i, (a, b) in enumerate(ends):
        for c, d in ends[i + 1 :]:
            total += a[0] == c[0] and (a[1] - c[1]) * (b[1] - d[1]) < 0
    return total


def _placed(
    order: Sequence[Sequence[str]], arrows: Sequence[tuple[str, str]], width: Mapping[str, float], gap: float
) -> dict[str, float]:
    """Centres that draw connected nodes together, kept apart by least squares on each row."""
    near: dict[str, list[str]] = {name: [] for names in order for name in names}
    for a, b in arrows:
        near[a].append(b)
        near[b].append(a)
    offsets = []
    for names in order:
        steps = [0.0]
        for left, right in pairwise(names):
            room = gap if width[left] or width[right] else gap / 2
            steps.append(steps[-1] + (width[left] + width[right]) / 2 + room)
        offsets.append(np.array(steps) - steps[-1] / 2)
    centre = {
        name: float(x)
        for names, steps in zip(order, offsets, strict=True)
        for name, x in zip(names, steps, strict=True)
    }
    for sweep in range(4 * SWEEPS):
        for k in range(len(order)) if sweep % 2 == 0 else range(len(order) - 1, -1, -1):
            wanted = np.array([np.mean([centre[other] for other in near[name]] or [centre[name]]) for name in order[k]])
            moved = _increasing(wanted - offsets[k]) + offsets[k]
            centre |= {name: float(x) for name, x in zip(order[k], moved, strict=True)}
    return centre


def _increasing(values: FloatArray) -> FloatArray:
    """The nearest sequence that never decreases (pool adjacent violators).

    >>> _increasing(np.array([1.0, 3.0, 2.0])).tolist()
    [1.0, 2.5, 2.5]
    """
    pools: list[tuple[float, int]] = []
    for value in values:
        pools.append((float(value), 1))
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (a, n), (b, m) = pools[-2:]
            pools[-2:] = [((a * n + b * m) / (n + m), n + m)]
    return np.concatenate([np.full(count, value) for value, count in pools] or [np.zeros(0)])
