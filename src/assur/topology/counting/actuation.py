"""Actuation: whether the chosen inputs determine the mechanism, and which other choices would.

Inputs determine it where locking them leaves no freedom but internal ones. Where they are more than it takes, they are
redundant: some of them determine it, the others follow, and all can be preloaded against each other. The choices that
determine it and are no more than it takes are the bases of a matroid: sets of rows, one for each joint component, of a
basis of the mechanism's motions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from math import comb
from typing import Literal

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.topology.counting.mobility import AT_REST, motions
from assur.topology.screws.edges import Edge, column_names, graph, input_columns, rank

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

Verdict = Literal["valid", "redundant", "too few", "dependent"]

SETS = 20_000
"""Sets of inputs that are tried."""

DETERMINANT = 1e-9
"""Below this the determinant of unit rows counts as zero."""


@dataclass(frozen=True)
class Actuation:
    """The chosen inputs, judged, and the admissible ones.

    Attributes:
        inputs: names of the chosen components.
        needed: F less internal freedoms, how many inputs it takes.
        left: freedoms of the platform when the inputs are locked.
        redundancy: inputs less their rank: how many fewer are enough to lock what these lock, and the dimension of the
            forces with which the inputs can be preloaded against each other, the platform at rest.
        determining: subsets of the inputs that determine the mechanism, without redundancy, of the first ones tried;
            none where all of them do not.
        superfluous: inputs without which the others lock as much; those that a preload can act in.
        helpful: components that would lock a freedom that is left.
        sets: admissible sets of components, those near the base first.
        tried, possible: sets that were tried, of so many that there are.
        in_some, in_every: components that are in some, and in every, admissible set (of all possible ones).
    """

    inputs: tuple[str, ...]
    needed: int
    left: int
    redundancy: int
    determining: tuple[tuple[str, ...], ...]
    superfluous: tuple[str, ...]
    helpful: tuple[str, ...]
    sets: tuple[tuple[str, ...], ...]
    tried: int
    possible: int
    in_some: tuple[str, ...]
    in_every: tuple[str, ...]

    @property
    def verdict(self) -> Verdict:
        """Whether the chosen inputs determine the mechanism, with as many as it takes or more, or what is wrong."""
        if self.left:
            return "too few" if len(self.inputs) < self.needed else "dependent"
        return "redundant" if self.redundancy else "valid"

    @property
    def hint(self) -> str:
        """What to change; empty where the inputs are valid."""
        add = f"lock also {self.left} of {', '.join(self.helpful)}" if self.helpful else ""
        drop = f"leave out {self.redundancy} of {', '.join(self.superfluous)}" if self.superfluous and self.left else ""
        return " and ".join(part for part in (drop, add) if part)

    @property
    def complete(self) -> bool:
        """Whether `sets` holds every admissible set."""
        return self.tried == self.possible

    def __str__(self) -> str:
        count = f"{len(self.inputs)} input{'' if len(self.inputs) == 1 else 's'} for {self.needed}"
        head = f"{self.verdict}: {count} freedom{'' if self.needed == 1 else 's'}"
        extra = ""
        if self.verdict == "redundant":
            each = "any" if len(self.determining) == comb(len(self.inputs), self.needed) else "some"
            extra = f"{each} {self.needed} of them determine it, {len(self.determining)} sets"
        sets = f"{len(self.sets)} admissible set{'' if len(self.sets) == 1 else 's'}"
        tail = sets if self.complete else f"{sets} among the first {self.tried} of {self.possible}"
        return "; ".join(part for part in (head, extra, self.hint, tail) if part)


def locked_freedoms(edges: Sequence[Edge], inputs: Sequence[int], base: str, platform: str) -> int:
    """Freedoms that are left, beyond internal ones, when the chosen inputs are locked.

    A motion with the inputs at rest that leaves the platform at rest too is internal, so these are the freedoms of
    the platform.

    Args:
        edges: with twists at generic configurations.
        inputs: columns of the closure that are locked.
        base: a link.
        platform: a link.

    >>> slide = lambda name, axis, *links: Edge(name, *links, np.array([0, 0, 0, *axis], float).reshape(1, 6, 1))
    >>> table = [slide("P1", (1, 0, 0), "base", "cart"), slide("P2", (0, 1, 0), "cart", "table")]
    >>> locked_freedoms(table, [0], "base", "table"), locked_freedoms(table, [0, 1], "base", "table")
    (1, 0)
    """
    space = motions(edges, base, platform, inputs)
    freedoms: int = space.useful.shape[-1]
    return freedoms - rank(space.useful[:, list(inputs)], scale=1.0)


def actuation(
    edges: Sequence[Edge], base: str, platform: str, limit: int = SETS, finite: FloatArray | None = None
) -> Actuation:
    """The inputs that the edges name, judged, and every admissible set of components.

    Components of joints but ball joints, and of parallelograms with one freedom may be actuated; those of ball joints
    may not, nor those that an internal freedom moves. With too many combinations the first `limit` are tried;
    `in_some` and `in_every` are exact all the same.

    Args:
        edges: with twists at generic configurations.
        base: a link.
        platform: a link.
        limit: sets to try.
        finite: as for `motions`.

    >>> turn = lambda *point: np.array([0, 0, 1, *np.cross(point, (0, 0, 1))], float).reshape(1, 6, 1)
    >>> links = ("base", "crank", "rod", "rocker", "base")
    >>> points = ((0, 0, 0), (1, 2, 0), (4, 2.5, 0), (5, 0, 0))
    >>> driven = ((0,), (), (), ())
    >>> bars = [Edge(f"R{i + 1}", *links[i : i + 2], turn(*points[i]), (), driven[i]) for i in range(4)]
    >>> print(actuation(bars, "base", "rod"))
    valid: 1 input for 1 freedom; 4 admissible sets
    """
    space = motions(edges, base, platform, finite=finite)
    names, chosen = column_names(edges), input_columns(edges)
    needed = space.useful.shape[-1]
    rows = driven_columns(edges, space.internal)
    locked = rank(space.useful[:, chosen], scale=1.0)
    near = _from_base(edges, base)
    nearest = sorted(rows, key=lambda column: near[column])
    sets, possible = _admissible(space.useful[:, nearest], limit)
    columns = sorted(
        (sorted(nearest[index] for index in subset) for subset in sets),
        key=lambda subset: (sum(near[column] for column in subset), subset),
    )
    determining, _ = _admissible(space.useful[:, chosen], limit) if locked == needed else ([], 0)
    some, every = _in_sets(space.useful[:, rows])
    return Actuation(
        inputs=tuple(names[column] for column in chosen),
        needed=needed,
        left=needed - locked,
        redundancy=len(chosen) - locked,
        determining=tuple(tuple(names[chosen[index]] for index in subset) for subset in determining),
        superfluous=tuple(
            names[column]
            for column in chosen
            if rank(space.useful[:, [other for other in chosen if other != column]], scale=1.0) == locked
        ),
        helpful=tuple(names[column] for column in rows if rank(space.useful[:, [*chosen, column]], scale=1.0) > locked)
        if locked < needed
        else (),
        sets=tuple(tuple(names[column] for column in subset) for subset in columns),
        tried=min(limit, possible),
        possible=possible,
        in_some=tuple(names[rows[index]] for index in some),
        in_every=tuple(names[rows[index]] for index in every),
    )


def _from_base(edges: Sequence[Edge], base: str) -> list[int]:
    """How many joints stand between each column's joint and the base."""
    away = nx.single_source_shortest_path_length(graph(edges), base)
    return [min(away[edge.parent], away[edge.child]) for edge in edges for _ in range(edge.freedoms)]


def driven_columns(edges: Sequence[Edge], internal: FloatArray) -> list[int]:
    """Columns that may be actuated: of edges whose freedoms are single, where internal freedoms (N, c, i) rest."""
    rests = np.max(np.abs(internal), axis=(0, 2), initial=0.0) < AT_REST
    single = np.repeat([edge.single for edge in edges], [edge.freedoms for edge in edges])
    return [int(column) for column in np.flatnonzero(rests & single)]


def spanning(rows: FloatArray, sets: IndexArray) -> NDArray[np.bool_]:
    """Whether sets (k, d) of rows (N, m, d) span everything, (k,)."""
    rows = rows[:2]
    lengths = np.linalg.norm(rows, axis=-1, keepdims=True)
    unit = rows / np.where(lengths > AT_REST, lengths, np.inf)
    spans: NDArray[np.bool_] = np.any(np.abs(np.linalg.det(unit[:, sets])) > DETERMINANT, axis=0)
    return spans


def _admissible(rows: FloatArray, limit: int) -> tuple[list[tuple[int, ...]], int]:
    """Sets of rows (N, m, d) that span everything, of the first sets of d, and how many sets of d there are."""
    count, size = rows.shape[1:]
    possible = comb(count, size)
    tried = np.array(list(islice(combinations(range(count), size), limit)), dtype=int)
    tried = tried.reshape(min(possible, limit), size)
    return [tuple(columns) for columns in tried[spanning(rows, tried)].tolist()], possible


def _in_sets(rows: FloatArray) -> tuple[list[int], list[int]]:
    """Rows (N, m, d) that are in some set that spans everything, and those that are in every one.

    If any set spans at all, a row is in one unless it is zero, and in every one if the others do not span.
    """
    count, size = rows.shape[1:]
    if not size or rank(rows, scale=1.0) < size:
        return [], []
    some = [index for index in range(count) if np.max(np.abs(rows[:, index])) > AT_REST]
    return some, [index for index in some if rank(np.delete(rows, index, axis=1), scale=1.0) < size]
