"""Where a graph of links and joints stands on the page: limbs as columns from the base up to the platform.

A graph that reduces in series and in parallel is drawn with upright lines only: branches side by side, a link
that joins several of them as a bar over all. Any other graph is put on layers with few crossings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.figures.layers import layout, rows
from assur.figures.series_parallel import Beside, Series, Tree, levels, tree

FloatArray = NDArray[np.float64]
ROW = 42.0
GAP = 10.0
OVERHANG = 10.0
PORT = 10.0
"""Height of a joint with its link, gap between columns, what a bar has beyond its lines, their distance; points."""


@dataclass(frozen=True)
class Bond:
    """A joint between two links, with the room (left, right) in points that its symbol and its letters need."""

    name: str
    start: str
    end: str
    room: tuple[float, float]


@dataclass(frozen=True, eq=False)
class GraphLayout:
    """Places in points, the base at height 0.

    Attributes:
        joints: (2,) middle of each joint's symbol.
        links: (left, right, height) of each link's bar.
        lines: of each joint, points (k, 2) from one bar to the other, to be run through upright.
        upright: whether every line is straight, so that none cross.
    """

    joints: Mapping[str, FloatArray]
    links: Mapping[str, tuple[float, float, float]]
    lines: Mapping[str, FloatArray]
    upright: bool


def plan(bonds: Sequence[Bond], base: str, platform: str, widths: Mapping[str, float]) -> GraphLayout:
    """Places for a connected graph; the same input gives the same output.

    Args:
        bonds: in the order in which columns stand from left to right.
        base: link at the bottom.
        platform: link at the top.
        widths: of the links' boxes, in points.

    >>> crank, rod = Bond("A", "base", "crank", (9.0, 9.0)), Bond("B", "crank", "rod", (9.0, 9.0))
    >>> found = plan([crank, rod], "base", "rod", {"base": 30.0, "crank": 30.0, "rod": 30.0})
    >>> found.links["rod"], found.joints["A"].tolist()
    ((-15.0, 15.0, 84.0), [0.0, 21.0])
    """
    reduced = tree({bond.name: (bond.start, bond.end) for bond in bonds}, base, platform)
    if reduced is None:
        return _layered(bonds, base, platform, widths)
    return _Upright({bond.name: bond for bond in bonds}, base, platform, widths).plan(reduced)


@dataclass(frozen=True, eq=False)
class _Upright:
    """Columns of a series-parallel graph."""

    bonds: Mapping[str, Bond]
    base: str
    platform: str
    widths: Mapping[str, float]

    def plan(self, reduced: Tree) -> GraphLayout:
        """Every place."""
        height = ROW * levels(reduced)
        x = dict(self._columns(reduced, 0.0))
        level = {self.base: 0.0, self.platform: height, **dict(self._heights(reduced, 0.0, height))}
        lines = {}
        for name, bond in self.bonds.items():
            ends = sorted((level[bond.start], level[bond.end]))
            lines[name] = np.array([[x[name], end] for end in ends])
        links = {
            link: self._bar(link, [x[b.name] for b in self.bonds.values() if link in (b.start, b.end)], level[link])
            for link in level
        }
        return GraphLayout({name: line.mean(axis=0) for name, line in lines.items()}, links, lines, upright=True)

    def _bar(self, link: str, columns: Sequence[float], height: float) -> tuple[float, float, float]:
        middle = (min(columns) + max(columns)) / 2
        half = max(self.widths[link] / 2, (max(columns) - min(columns)) / 2 + OVERHANG)
        return middle - half, middle + half, height

    def _room(self, part: Tree) -> tuple[float, float]:
        """Room (left, right) of a part about its axis."""
        if isinstance(part, str):
            return self.bonds[part].room
        if isinstance(part, Series):
            sides = [self._room(item) for item in part.parts] + [(self.widths[n] / 2,) * 2 for n in part.nodes]
            return max(left for left, _ in sides), max(right for _, right in sides)
        axes = self._axes(part)
        return self._room(part.parts[0])[0] - axes[0], self._room(part.parts[-1])[1] + axes[-1]

    def _axes(self, part: Beside) -> FloatArray:
        """Axes of parts side by side, about the middle of the first and the last."""
        rooms = [self._room(item) for item in part.parts]
        steps = [before[1] + GAP + after[0] for before, after in pairwise(rooms)]
        axes = np.concatenate([[0.0], np.cumsum(steps)])
        return np.asarray(axes - axes[-1] / 2)

    def _columns(self, part: Tree, axis: float) -> Iterator[tuple[str, float]]:
        """(joint, its place along the page)."""
        if isinstance(part, str):
            yield part, axis
            return
        shifts = self._axes(part) if isinstance(part, Beside) else np.zeros(len(part.parts))
        for item, shift in zip(part.parts, shifts, strict=True):
            yield from self._columns(item, axis + float(shift))

    def _heights(self, part: Tree, low: float, high: float) -> Iterator[tuple[str, float]]:
        """(link between parts, its height)."""
        if isinstance(part, Beside):
            for item in part.parts:
                yield from self._heights(item, low, high)
        if isinstance(part, Series):
            ends = low + (high - low) * np.cumsum([0, *map(levels, part.parts)]) / levels(part)
            yield from zip(part.nodes, map(float, ends[1:-1]), strict=True)
            for item, (bottom, top) in zip(part.parts, pairwise(ends), strict=True):
                yield from self._heights(item, float(bottom), float(top))


# ---- any other graph --------------------------------------------------------------------------------------


def _layered(bonds: Sequence[Bond], base: str, platform: str, widths: Mapping[str, float]) -> GraphLayout:
    """Links and joints as boxes on layers, every line from a link near the base to one farther up."""
    near = _near(bonds, base, platform)
    ends = {bond.name: sorted((bond.start, bond.end), key=near.index) for bond in bonds}
    node = {name: f"joint {name}" for name in ends}  # no link has such a name
    needs: dict[str, list[str]] = {link: [node[name] for name in ends if ends[name][1] == link] for link in near}
    needs |= {node[name]: [below] for name, (below, _) in ends.items()}
    boxes = {link: max(widths[link], PORT * sum(link in pair for pair in ends.values())) for link in near}
    sizes = boxes | {node[bond.name]: 2 * max(bond.room) for bond in bonds}
    row = rows(needs, [base], [platform])
    placed = layout(needs, row, sizes, GAP)
    level = dict(row)
    for (start, _), steps in placed.routes.items():
        level |= {step: row[start] + 1 + k for k, step in enumerate(steps)}
    at = {name: np.array([x, ROW / 2 * level[name]]) for name, x in placed.centre.items()}
    lines = {}
    for name, (below, above) in ends.items():
        way = (below, *placed.routes[below, node[name]], node[name], *placed.routes[node[name], above], above)
        lines[name] = np.array([at[step] for step in way])
    for link in near:
        _spread([lines[name] for name in ends if ends[name][0] == link], 0, 1, boxes[link])
        _spread([lines[name] for name in ends if ends[name][1] == link], -1, -2, boxes[link])
    bars = {link: (at[link][0] - boxes[link] / 2, at[link][0] + boxes[link] / 2, at[link][1]) for link in near}
    return GraphLayout({name: at[node[name]] for name in ends}, bars, lines, upright=False)


def _near(bonds: Sequence[Bond], base: str, platform: str) -> list[str]:
    """Links in the order of their distance from the base, the platform last."""
    graph: nx.Graph[str] = nx.Graph()
    graph.add_edges_from((bond.start, bond.end) for bond in bonds)
    far = nx.single_source_shortest_path_length(graph, base)
    return sorted(far, key=lambda link: (link == platform, far[link]))


def _spread(lines: Sequence[FloatArray], end: int, aim: int, width: float) -> None:
    """Lines on one side of a bar end at places of their own, in the order of where they come from."""
    step = min(PORT, width / max(len(lines), 1))
    for place, line in enumerate(sorted(lines, key=lambda points: float(points[aim, 0]))):
        line[end, 0] += step * (place - (len(lines) - 1) / 2)
