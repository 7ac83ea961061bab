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
