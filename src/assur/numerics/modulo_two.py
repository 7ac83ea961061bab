"""Linear algebra modulo 2: which rows are sums of others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

BoolArray = NDArray[np.bool_]


def independent(rows: BoolArray) -> list[int]:
    """Rows (N, k) that are no sum modulo 2 of rows before them.

    >>> independent(np.array([[True, True], [True, True], [False, False], [True, False]]))
    [0, 3]
    """
    basis: list[BoolArray] = []
    answer = []
    for number, row in enumerate(rows):
        left = row.copy()
        for known in basis:
            if left[np.argmax(known)]:
                left ^= known
        if np.any(left):
            basis.append(left)
            answer.append(number)
    return answer


def vanishing_sums(rows: BoolArray) -> list[list[int]]:
    """Sets of rows (N, k) whose sum modulo 2 vanishes: one of each row that is a sum of rows before it.

    >>> vanishing_sums(np.array([[True, True], [True, True], [False, False], [True, False]]))
    [[0, 1], [2]]
    """
    basis: list[tuple[BoolArray, set[int]]] = []
    answer = []
    for number, row in enumerate(rows):
        left, chosen = row.copy(), {number}
        for known, own in basis:
            if left[np.argmax(known)]:
                left, chosen = left ^ known, chosen ^ own
        if np.any(left):
            basis.append((left, chosen))
        else:
            answer.append(sorted(chosen))
    return answer


def residues_of_sums(rows: BoolArray, width: int) -> BoolArray:
    """Of rows (N, k) that are sums of rows before them in the first columns what is left in the others (N, k - width).

    Of rows that are no such sums nothing is.

    >>> residues_of_sums(np.array([[True, True], [True, False], [True, True]]), 1).ravel()
    array([False,  True, False])
    """
    basis: list[BoolArray] = []
    answer = np.zeros((len(rows), rows.shape[1] - width), dtype=bool)
    for number, row in enumerate(rows):
        left = row.copy()
        for known in basis:
            if left[np.argmax(known)]:
                left ^= known
        if np.any(left[:width]):
            basis.append(left)
        else:
            answer[number] = left[width:]
    return answer
