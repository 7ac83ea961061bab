"""Straight-line programs made ready for many boxes: constants worked out once, radicands among the outputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.recording.tape import Operation, Tape
from assur.workspace.certified.sloped import ClampedIntervals


def with_radicands(tape: Tape, margins: Sequence[str]) -> tuple[Tape, tuple[str, ...], tuple[str, ...]]:
    """The tape with every radicand for an output, the names of those added, and the names of all radicands.

    Args:
        tape: outputs of any kind.
        margins: names of the outputs that are known not to be negative where a pose is reached.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> tape = recorder.tape({"m": x - 1, "f": recorder.sqrt(x - 1) + recorder.sqrt(x)})
    >>> with_radicands(tape, ["m"])[1:]
    (('radicand 0',), ('m', 'radicand 0'))
    """
    places = sorted({item.arguments[0] for item in tape.operations if item.name == "root"})
    known = {tape.outputs[name]: name for name in margins}
    added = {f"radicand {place}": place for place in places if place not in known and not _plain(tape, place)}
    outputs = {**tape.outputs, **added}
    roots = tuple(name for name in (*margins, *added) if outputs[name] in places)
    return replace(tape, outputs=outputs), tuple(added), roots


def _plain(tape: Tape, place: int) -> bool:
    """Whether an entry is a number that is not negative, such as the 3 of a cosine of 30 deg."""
    item = tape.operations[place]
    return item.name == "number" and item.number >= 0


def folded(tape: Tape, uniform: Sequence[Interval]) -> tuple[Tape, tuple[Interval, ...]]:
    """The same program with everything that does not vary worked out, and the enclosures that it is given now.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x, p = recorder.varying("x"), recorder.uniform("p")
    >>> program, numbers = folded(recorder.tape({"f": x + p * p}), [as_interval(3.0)])
    >>> [item.name for item in program.operations], bool(numbers[0].contains(9.0))
    (['varying', 'uniform', '+'], True)
    """
    varies: list[bool] = []
    for item in tape.operations:
        varies.append(item.name == "varying" or any(varies[k] for k in item.arguments))
    every = replace(tape, outputs={str(k): k for k in range(len(varies))})
    values = every.evaluate([as_interval(0.0)] * len(tape.varying), uniform, ClampedIntervals())
    needed = {*tape.outputs.values()}
    needed.update(k for item, own in zip(tape.operations, varies, strict=True) if own for k in item.arguments)
    operations: list[Operation] = []
    numbers: list[Interval] = []
    place: dict[int, int] = {}
    for k, item in enumerate(tape.operations):
        if varies[k]:
            operations.append(Operation(item.name, tuple(place[argument] for argument in item.arguments)))
        elif k not in needed:
            continue
        elif item.name == "number":
            operations.append(item)
        else:
            operations.append(Operation("uniform"))
            numbers.append(as_interval(values[str(k)]))
        place[k] = len(operations) - 1
    names = tuple(f"constant {k}" for k in range(len(numbers)))
    outputs = {name: place[k] for name, k in tape.outputs.items()}
    return Tape(tuple(operations), tape.varying, names, outputs), tuple(numbers)
