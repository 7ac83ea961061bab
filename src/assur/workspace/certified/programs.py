"""Radicands among the outputs of a tape: below zero they mean that a pose is not reached."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from assur.numerics.recording.tape import Tape


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
