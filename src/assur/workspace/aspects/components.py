"""Components: boxes joined by faces lie in one aspect; those that no chain of undecided boxes could join do not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from assur.workspace.aspects.neighbours import Neighbours

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
        seen = np.zeros(graph.shape[0], dtype=bool)
        steps = [np.array([component])]
        seen[component] = True
        while len(steps[-1]) and not (len(steps) > 1 and np.any(steps[-1] < count)):
            steps.append(_beside(graph, steps[-1], ~seen))
            seen[steps[-1]] = True
        found = np.zeros(graph.shape[0] - count, dtype=bool)
        back = steps.pop()
        back = back[back < count]
        while len(steps) > 1:  # the way back, over what was reached a step before
            before = np.zeros(len(seen), dtype=bool)
            before[steps.pop()] = True
            back = _beside(graph, back, before)
            found[back - count] = True
        return found


def components(met: Neighbours) -> IntArray:
    """The component (N,) of each certain box: those joined by shared faces, numbered in the order of their first box.

    >>> import numpy as np
    >>> from assur.workspace.aspects.neighbours import neighbours
    >>> from assur.workspace.certified.boxes import Boxes
    >>> boxes = Boxes(np.array([[0.0, 1.0, 3.0], [0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 4.0], [1.0, 1.0, 2.0]]))
    >>> components(neighbours(boxes, boxes[:0])).tolist()
    [0, 0, 1]
    """
    return _parts(len(met.certain), met.faces)


def links(met: Neighbours, signs: Signs, possible: Signs) -> Links:
    """Components of certain boxes, and which of them undecided boxes may join.

    Args:
        met: certain boxes, in which every pose is reached and none is singular; and undecided ones, of which some poses
            may be so. All others have none.
        signs: (N, f) of the factors in each certain box.
        possible: (M, f) signs of the factors where such a pose has that one for certain, else 0.

    An aspect with given signs lies in the certain boxes with those signs and in undecided boxes that allow them. So two
    components are apart unless a chain of such boxes, of which each touches the next, joins them.
    """
    own = components(met)
    number = int(np.max(own, initial=-1)) + 1
    of_component = np.zeros((number, signs.shape[1]), dtype=np.int8)
    of_component[own] = signs
    # nodes of the graphs: the components, then the undecided boxes
    node = np.concatenate([own, number + np.arange(len(met.undecided))])[met.touching]
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
                graphs[len(reached)] = _graph(len(allowed), np.concatenate([inside, inside[:, ::-1]]))
            reached.append(np.flatnonzero(fits[number:] & (part[number:] == own_part)))
    return Links(own, of_component, group, tuple(reached), graphs)


def _graph(count: int, pairs: IntArray) -> csr_array:
    """The graph of so many nodes with these pairs for edges, each in one direction."""
    return coo_array((np.ones(len(pairs), dtype=bool), (pairs[:, 0], pairs[:, 1])), shape=(count, count)).tocsr()


def _beside(graph: csr_array, nodes: IntArray, allowed: BoolArray) -> IntArray:
    """Allowed nodes that an edge joins to one of some nodes, each once."""
    starts = graph.indptr[nodes]
    counts = graph.indptr[nodes + 1] - starts
    within = np.arange(int(np.sum(counts))) - np.repeat(np.cumsum(counts) - counts, counts)
    found = graph.indices[np.repeat(starts, counts) + within]
    return np.unique(found[allowed[found]]).astype(np.int64)


def _parts(count: int, pairs: IntArray) -> IntArray:
    """The part (count,) of each node of a graph."""
    _, labels = connected_components(_graph(count, pairs), directed=False)
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first)).astype(np.int64)[inverse.reshape(-1)]
