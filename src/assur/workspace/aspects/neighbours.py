"""Neighbours: which boxes of a search meet, kept up to date where some of them are cut.

A part of a box meets nothing that the box did not meet: so after a cut only the neighbours of what was cut are compared
with the parts, however many boxes there are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.workspace.aspects.adjacency import contacts, shared_faces
from assur.workspace.aspects.turning import Ends
from assur.workspace.certified.boxes import Boxes, together

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Neighbours:
    """Which of N certain and M undecided boxes meet; the undecided ones are numbered from N on.

    Attributes:
        certain, undecided: the boxes.
        faces: (n, 2) certain boxes that share a part of a face.
        touching: (m, 2) boxes that have a point in common.
        ends: of coordinates that turn.
    """

    certain: Boxes
    undecided: Boxes
    faces: IntArray
    touching: IntArray
    ends: Ends = ()

    def cut(self, chosen: BoolArray, certain: Boxes, undecided: Boxes) -> Neighbours:
        """What meets when chosen undecided boxes (M,) are replaced by parts, which come after the others.

        >>> whole = Boxes(np.array([[0.0, 2.0]]), np.array([[2.0, 4.0]]))
        >>> left, right, nothing = whole[:1], whole[1:], whole[:0]
        >>> found = neighbours(left, right).cut(np.array([True]), nothing, right.halved(np.array([0])))
        >>> found.touching.tolist()
        [[0, 1], [1, 2]]
        """
        before, after = len(self.certain), len(self.certain) + len(certain)
        boxes = together([self.certain, certain, self.undecided[~chosen], undecided])
        number = np.full(before + len(chosen), -1)  # of what is left, from now on
        number[:before] = np.arange(before)
        number[before:][~chosen] = after + np.arange(int(np.sum(~chosen)))
        gone = np.any(number[self.touching] < 0, axis=1)
        beside = number[self.touching[gone]]
        fresh, near = np.zeros(len(boxes), dtype=bool), np.zeros(len(boxes), dtype=bool)
        fresh[before:after] = fresh[len(boxes) - len(undecided) :] = True
        near[beside[beside >= 0]] = True
        rows = np.flatnonzero(near | fresh)
        pairs = rows[contacts(boxes[rows], self.ends)]
        rows = rows[rows < after]
        faces = rows[shared_faces(boxes[rows], self.ends)[0]]
        return Neighbours(
            boxes[:after],
            boxes[after:],
            np.concatenate([self.faces, faces[np.any(fresh[faces], axis=1)]]),
            np.concatenate([number[self.touching[~gone]], pairs[np.any(fresh[pairs], axis=1)]]),
            self.ends,
        )


def neighbours(certain: Boxes, undecided: Boxes, ends: Ends = ()) -> Neighbours:
    """Which of all boxes meet.

    >>> boxes = Boxes(np.array([[0.0, 1.0, 2.0]]), np.array([[1.0, 2.0, 3.0]]))
    >>> found = neighbours(boxes[:2], boxes[2:])
    >>> found.faces.tolist(), found.touching.tolist()
    ([[0, 1]], [[0, 1], [1, 2]])
    """
    touching = contacts(together([certain, undecided]), ends)
    return Neighbours(certain, undecided, shared_faces(certain, ends)[0], touching, ends)
