"""The plan of a program over intervals: a tape as rows of numbers, each result in a place that is free by then."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.recording.tape import Tape

STEPS = ("varying", "store", "+", "-", "*", "/", "negative", "magnitude", "root", "sign rate", "root rate")
"""What a program is made of: numbers fetched, answers stored, operations."""

GIVEN = ("varying", "uniform", "number")


@dataclass(frozen=True, eq=False)
class IntervalPlan:
    """A tape as numbers.

    Attributes:
        steps: (S, 5) place in `STEPS`, place of the result, those of the arguments, and of a product the row of its
            second factor among what is given, or -1.
        places: how many results are kept at a time; in the first ones is what does not vary, uniform numbers first: no
            step writes there.
        rows: entry -> row of the answer.
        numbers: the written ones.
    """

    steps: NDArray[np.int64]
    places: int
    rows: dict[int, int]
    numbers: list[float]


def interval_plan(tape: Tape) -> IntervalPlan:
    """Steps in the order of the tape; a place is used again once nothing needs what is there."""
    operations = tape.operations
    rows = {k: row for row, k in enumerate(dict.fromkeys(tape.outputs.values()))}
    last = {argument: k for k, operation in enumerate(operations) for argument in operation.arguments}
    varying, *same = ([k for k, operation in enumerate(operations) if operation.name == kind] for kind in GIVEN)
    fixed = [k for part in same for k in part]
    given = {k: row for row, k in enumerate([*varying, *fixed])}
    place = {k: at for at, k in enumerate(fixed)}
    steps: list[tuple[int, ...]] = []
    free: list[int] = []
    places = len(fixed)
    for k, operation in enumerate(operations):
        arguments = operation.arguments
        if operation.name == "*" and operations[arguments[0]].name == "number":
            arguments = arguments[::-1]  # as NumPy does it
        if k not in place:
            place[k], places = (free.pop(), places) if free else (places, places + 1)
            first, second = (place[arguments[0]], place[arguments[-1]]) if arguments else (given[k], 0)
            factor = given.get(arguments[-1], -1) if operation.name == "*" else -1
            steps.append((STEPS.index(operation.name), place[k], first, second, factor))
        if k in rows:
            steps.append((STEPS.index("store"), rows[k], place[k], 0, -1))
        free += [place[entry] for entry in {k, *arguments} if last.get(entry, k) == k and place[entry] >= len(fixed)]
    written = [operations[k].number for k in same[1]]
    return IntervalPlan(np.array(steps, dtype=np.int64).reshape(-1, 5), places, rows, written)
