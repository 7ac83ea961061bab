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
"""Elements of a group where there are few outputs, and elements that are moved at a time."""
LONG, MANY = 256, 20
"""Elements of a group where there are more outputs: each then goes on for a while in one page of memory."""
PAD = 8
"""Elements between rows of a long group, which would share few places in the cache if they began at powers of two."""

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
    size, pitch = group_size(tape)
    before, inside = _statements(tape)
    for k, place in {tape.outputs[name]: place for name, place in places.items()}.items():
        value = f"1.0 if v{k} else 0.0" if tape.operations[k].name in LOGICAL else f"v{k}"
        inside.append(f"group[{place * pitch} + i] = {value}")
    height = varying + len(set(places.values()))
    return _FRAME.format(
        version=_storing_version(),
        size=height * pitch,
        before="\n    ".join(before),
        inside="\n            ".join(inside),
        varying=varying,
        count=size,
        pitch=pitch,
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
    for first in range(start, stop, {count}):
        count = min({count}, stop - first)
        whole = count // {step} * {step}
        for row in range({varying}):
            for k in range(0, whole, {step}):
                moved(given, row * width + first + k, group, row * {pitch} + k)
            for i in range(whole, count):
                group[row * {pitch} + i] = given[row * width + first + i]
        for i in range({count}):
            {inside}
        begin = shift + first
        for row in range(len(number_rows)):
            at, to = number_rows[row] * {pitch}, row * length + begin
            if streaming:
                for k in range(0, whole, {step}):
                    streamed(group, at + k, numbers, to + k)
            else:
                for k in range(0, whole, {step}):
                    moved(group, at + k, numbers, to + k)
            for i in range(whole, count):
                numbers[to + i] = group[at + i]
        for row in range(len(truth_rows)):
            at, to = truth_rows[row] * {pitch}, row * length + begin
            for k in range(0, whole, {step}):
                judged(group, at + k, truths, to + k)
            for i in range(whole, count):
                truths[to + i] = group[at + i] > 0.5
    return odd
"""


def group_size(tape: Tape) -> tuple[int, int]:
    """Elements of a group, and places from one row of its buffer to the next.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> group_size(recorder.tape({"x": recorder.varying("x")}))
    (16, 16)
    """
    return (GROUP, GROUP) if len(tape.outputs) <= MANY else (LONG, LONG + PAD)


def _statements(tape: Tape) -> tuple[list[str], list[str]]:
    """Lines before the loop, of what is the same for all elements, and lines inside."""
    once, pitch = _uniform_entries(tape), group_size(tape)[1]
    before, inside = [], []
    varying, uniform = 0, 0
    for k, operation in enumerate(tape.operations):
        if operation.name == "varying":
            inside += [f"v{k} = group[{varying * pitch} + i]", f"odd += 0 if abs(v{k}) < inf else 1"]
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
