"""Components: boxes joined by faces lie in one aspect; those that no chain of undecided boxes could join do not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

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
        reached: (C, M) whether an aspect that holds the component may extend into an undecided box.
        touching: (C, M) whether an undecided box touches the component.
    """

    component: IntArray
    signs: Signs
    group: IntArray
    reached: BoolArray
    touching: BoolArray


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
    count, number = len(certain), int(np.max(own, initial=-1)) + 1
    of_component = np.zeros((number, signs.shape[1]), dtype=np.int8)
    of_component[own] = signs
    pairs = contacts(together([certain, undecided]))
    # nodes: the components, then the undecided boxes
    node = np.concatenate([own, number + np.arange(len(undecided))])[pairs]
    node = node[node[:, 0] != node[:, 1]]
    allowed = np.concatenate([of_component, possible])
    group = np.zeros(number, dtype=np.int64)
    reached = np.zeros((number, len(undecided)), dtype=bool)
    for value in np.unique(of_component, axis=0):
        fits = np.all((allowed == value) | ((allowed == 0) & (np.arange(len(allowed)) >= number)[:, None]), axis=1)
        inner = node[fits[node].all(axis=1)]
        part = _parts(len(allowed), inner)
        mine = np.flatnonzero(fits[:number])
        group[mine] = part[mine]
        reached[mine] = (part[mine][:, None] == part[None, number:]) & fits[None, number:]
    touching = np.zeros((number, len(undecided)), dtype=bool)
    mixed = node[(node[:, 0] < number) & (node[:, 1] >= number)]
    touching[mixed[:, 0], mixed[:, 1] - number] = True
    if count == 0:
        return Links(own, of_component, group, reached, touching)
    # components of other signs never share a group, whatever their numbers are
    _, group = np.unique(np.column_stack([of_component, group]), axis=0, return_inverse=True)
    return Links(own, of_component, group.reshape(-1).astype(np.int64), reached, touching & reached)


def _parts(count: int, pairs: IntArray) -> IntArray:
    """The part (count,) of each node of a graph."""
    ones = np.ones(len(pairs), dtype=bool)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    _, labels = connected_components(graph.tocsr(), directed=False)
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first)).astype(np.int64)[inverse.reshape(-1)]
