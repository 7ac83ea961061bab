"""Components: boxes joined by faces lie in one aspect; those that no chain of undecided boxes could join do not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra

from assur.workspace.aspects.adjacency import contacts, shared_faces
from assur.workspace.certified.boxes import Boxes, together

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
Signs = NDArray[np.int8]


@dataclass(frozen=True, eq=False)
class Links:
    """What is known of the connection of boxes.

    Attributes:
        component: (N,) of each certain box, from 0; boxes of one are joined by faces.
        signs: (C, f) of the factors in each component.
        group: (C,) of each component, from 0; components of different groups are certainly not connected.
        reached: for each group the undecided boxes into which its aspects may extend.
        graphs: for each group with several components the graph over components and undecided boxes that may join them.
    """

    component: IntArray
    signs: Signs
    group: IntArray
    reached: tuple[IntArray, ...]
    graphs: Mapping[int, csr_array]

    def chains(self, component: int) -> BoolArray:
        """Undecided boxes (M,) on one of the shortest chains that may join a component to another of its group."""
        graph, count = self.graphs[int(self.group[component])], len(self.group)
        others = np.flatnonzero(self.group == self.group[component])
        rest = others[others != component]
        here = dijkstra(graph, indices=np.array([component]), unweighted=True)[0]
        there = dijkstra(graph, indices=rest, unweighted=True, min_only=True)
        least = float(np.min(here[rest]))
        found: BoolArray = (here + there == least)[count:] & np.isfinite(least)
        return found


def components(boxes: Boxes) -> IntArray:
    """The component (N,) of each box: those joined by shared faces, numbered from 0 in the order of their first box.

    >>> boxes = Boxes(np.array([[0.0, 1.0, 3.0], [0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 4.0], [1.0, 1.0, 2.0]]))
    >>> components(boxes).tolist()
    [0, 0, 1]
    """
    pairs, _ = shared_faces(boxes)
    return _parts(len(boxes), pairs)


def links(certain: Boxes, signs: Signs, undecided: Boxes, possible: Signs) -> Links:
    """Components of certain boxes, and which of them undecided boxes may join.

    Args:
        certain: boxes in which every pose is reached and none is singular.
        signs: (N, f) of the factors in each.
        undecided: boxes of which some poses may be so; all others have none.
        possible: (M, f) signs of the factors where such a pose has that one for certain, else 0.

    An aspect with given signs lies in the certain boxes with those signs and in undecided boxes that allow them. So two
    components are apart unless a chain of such boxes, of which each touches the next, joins them.
    """
    own = components(certain)
    number = int(np.max(own, initial=-1)) + 1
    of_component = np.zeros((number, signs.shape[1]), dtype=np.int8)
    of_component[own] = signs
    # nodes of the graphs: the components, then the undecided boxes
    node = np.concatenate([own, number + np.arange(len(undecided))])[contacts(together([certain, undecided]))]
    node = node[node[:, 0] != node[:, 1]]
    allowed = np.concatenate([of_component, possible])
    group = np.zeros(number, dtype=np.int64)
    reached: list[IntArray] = []
    graphs: dict[int, csr_array] = {}
    for value in np.unique(of_component, axis=0):
        fits = np.all((allowed == value) | (allowed == 0), axis=1)
        inner = node[fits[node].all(axis=1)]
        part = _parts(len(allowed), inner)
        mine = np.flatnonzero(fits[:number])
        for own_part in np.unique(part[mine]):
            members = mine[part[mine] == own_part]
            group[members] = len(reached)
            if len(members) > 1:
                # components that touch at a corner are one, but a path wants a face: cut what lies about the corner
                inside = inner[(part[inner[:, 0]] == own_part) & np.any(inner >= number, axis=1)]
                graphs[len(reached)] = _graph(len(allowed), inside)
            reached.append(np.flatnonzero(fits[number:] & (part[number:] == own_part)))
    return Links(own, of_component, group, tuple(reached), graphs)


def _graph(count: int, pairs: IntArray) -> csr_array:
    """The graph of so many nodes with these pairs for edges."""
    both = np.concatenate([pairs, pairs[:, ::-1]])
    return coo_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(count, count)).tocsr()


def _parts(count: int, pairs: IntArray) -> IntArray:
    """The part (count,) of each node of a graph."""
    _, labels = connected_components(_graph(count, pairs), directed=False)
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first)).astype(np.int64)[inverse.reshape(-1)]
