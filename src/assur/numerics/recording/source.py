"""The text of a loop: generated source that numba compiles.

Elements are worked on in groups. The inputs and outputs of a group lie in one small buffer, row after row, so that the
compiler knows that they do not overlap and vectorises the loop; from there they go to the answer.
"""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from assur.numerics.recording.tape import LOGICAL, Operation, Tape

GROUP = 16
"""Elements of a group: the rows of all inputs and outputs then lie in the nearest cache, also where there are many."""

_TEXT = {
    "+": "{0} + {1}",
    "-": "{0} - {1}",
    "*": "{0} * {1}",
    "/": "{0} / {1}",
    "negative": "-{0}",
    "magnitude": "abs({0})",
    "root": "sqrt(0.0 if {0} < 0.0 else {0})",
    ">=": "{0} >= {1}",
    ">": "{0} > {1}",
    "and": "{0} & {1}",
    "not": "not {0}",
}


def source(tape: Tape) -> str:
    """The loop as Python source for numba: `loop(given, uniform, numbers, truths, rows, rows, start, stop, ...)`.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> "v1 = v0 * v0" in source(recorder.tape({"y": x * x}))
    True
    """
    places, varying = places_of(tape), len(tape.varying)
    before, inside = _statements(tape)
    for k, place in {tape.outputs[name]: place for name, place in places.items()}.items():
        value = f"1.0 if v{k} else 0.0" if tape.operations[k].name in LOGICAL else f"v{k}"
        inside.append(f"group[{place * GROUP} + i] = {value}")
    height = varying + len(set(places.values()))
    return _FRAME.format(
        version=_storing_version(),
        size=height * GROUP,
        before="\n    ".join(before),
        inside="\n            ".join(inside),
        varying=varying,
        step=GROUP,
    )


_FRAME = """\
# stored by {version}
from math import inf, nan, sqrt

import numpy as np
from numba import njit

from assur.numerics.recording.storing import judged, moved, streamed


@njit(cache=True, nogil=True, error_model="numpy")
def loop(given, width, uniform, numbers, truths, length, number_rows, truth_rows, part, streaming):
    start, stop, shift = part
    group = np.zeros({size})
    odd = 0
    {before}
    for first in range(start, stop, {step}):
        count = min({step}, stop - first)
        whole = count == {step}
        for row in range({varying}):
            at, to = row * width + first, row * {step}
            if whole:
                moved(given, at, group, to)
            else:
                for i in range(count):
                    group[to + i] = given[at + i]
        for i in range({step}):
            {inside}
        for row in range(len(number_rows)):
            at, to = number_rows[row] * {step}, row * length + shift + first
            if not whole:
                for i in range(count):
                    numbers[to + i] = group[at + i]
            elif streaming:
                streamed(group, at, numbers, to)
            else:
                moved(group, at, numbers, to)
        for row in range(len(truth_rows)):
            at, to = truth_rows[row] * {step}, row * length + shift + first
            if whole:
                judged(group, at, truths, to)
            else:
                for i in range(count):
                    truths[to + i] = group[at + i] > 0.5
    return odd
"""


def _statements(tape: Tape) -> tuple[list[str], list[str]]:
    """Lines before the loop, of what is the same for all elements, and lines inside."""
    once = _uniform_entries(tape)
    before, inside = [], []
    varying, uniform = 0, 0
    for k, operation in enumerate(tape.operations):
        if operation.name == "varying":
            inside += [f"v{k} = group[{varying * GROUP} + i]", f"odd += 0 if abs(v{k}) < inf else 1"]
            varying += 1
        elif operation.name == "uniform":
            before.append(f"v{k} = uniform[{uniform}]")
            uniform += 1
        elif operation.name == "number":
            before.append(f"v{k} = {operation.number!r}")
        else:
            (before if k in once else inside).append(f"v{k} = {_text(operation)}")
    return before, inside


def places_of(tape: Tape) -> dict[str, int]:
    """Output -> row of a group: after the inputs, equal outputs in one row.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> places_of(recorder.tape({"a": x + 1, "b": x * x, "c": x + 1}))
    {'a': 1, 'b': 2, 'c': 1}
    """
    order = {k: len(tape.varying) + place for place, k in enumerate(dict.fromkeys(tape.outputs.values()))}
    return {name: order[k] for name, k in tape.outputs.items()}


def _uniform_entries(tape: Tape) -> set[int]:
    """Entries that are the same for all elements: worked out once, before the loop."""
    once: set[int] = set()
    for k, operation in enumerate(tape.operations):
        if operation.name in ("uniform", "number") or (operation.arguments and once.issuperset(operation.arguments)):
            once.add(k)
    return once


def _text(operation: Operation) -> str:
    return _TEXT[operation.name].format(*(f"v{k}" for k in operation.arguments))


@lru_cache(maxsize=1)
def _storing_version() -> str:
    """Numba compares the file of a loop only; what the loop calls is told by this."""
    return digest(Path(__file__).with_name("storing.py").read_text(encoding="utf-8"))


def digest(text: str) -> str:
    """A short name for a text.

    >>> digest("a") == digest("a"), digest("a") == digest("b")
    (True, False)
    """
    return hashlib.sha256(text.encode()).hexdigest()[:24]
