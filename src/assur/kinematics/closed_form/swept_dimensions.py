"""Sweeps over dimensions: each mechanism of a grid is made from the file anew, or it is said why there is none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.home import home_values
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord

REASONS = 4
"""Reasons that are told of a block; each names its dimensions, and of fine grids there are as many as places."""
OTHERS = "other dimensions, for a like reason"


def runs(dimensions: NDArray[np.float64]) -> Iterator[slice]:
    """Where dimensions (k, b) stay the same.

    >>> list(runs(np.array([[1.0, 1.0, 2.0], [5.0, 5.0, 5.0]])))
    [slice(0, 2, None), slice(2, 3, None)]
    """
    changes = np.flatnonzero(np.any(np.diff(dimensions, axis=1) != 0.0, axis=0)) + 1
    ends = [0, *(int(place) for place in changes), dimensions.shape[1]]
    return map(slice, ends[:-1], ends[1:])


@lru_cache(maxsize=64)
def mechanism_of(record: MechanismRecord, names: tuple[str, ...], values: tuple[float, ...]) -> MechanismRecord:
    """A mechanism with other dimensions, in the units of its file; without a closed form its home is found.

    Errors:
        UsageError: the file does not allow them, or the loops of its home do not close.
    """
    changed = with_parameters(record, **dict(zip(names, values, strict=True)))
    if changed.closed_form is None:
        home_values(changed)
    return changed


def reasons(refused: Mapping[str, int]) -> dict[str, int]:
    """How many problems have no mechanism, by what is said of its dimensions; those beyond a few are counted together.

    >>> reasons({f"l = {-k}": 2 for k in range(6)})["other dimensions, for a like reason"]
    4
    """
    told: Counter[str] = Counter()
    for k, (reason, count) in enumerate(refused.items()):
        told[reason if k < REASONS else OTHERS] += count
    return dict(told)


def refusal(error: UsageError) -> str:
    """The reason in one line."""
    return " ".join(error.message.split())
