"""Tapes as JavaScript: the same operations in the same order, each of which IEEE 754 defines, so with the same bits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from assur.numerics.recording.statements import statements
from assur.numerics.recording.tape import Tape

_TEXT = {
    "+": "{0}+{1}",
    "-": "{0}-{1}",
    "*": "{0}*{1}",
    "/": "{0}/{1}",
    "negative": "-{0}",
    "magnitude": "Math.abs({0})",
    "root": "Math.sqrt({0}<0?0:{0})",
    ">=": "{0}>={1}",
    ">": "{0}>{1}",
    "and": "{0}&&{1}",
    "not": "!{0}",
}


def javascript(
    tape: Tape, varying: Sequence[str], uniform: Sequence[str], targets: Mapping[str, Sequence[str]]
) -> list[str]:
    """Statements that work out a tape.

    Args:
        tape: the program.
        varying: expressions of the numbers that are given for each element, in the tape's order.
        uniform: of those that are given once.
        targets: output -> what its number is assigned to.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> javascript(recorder.tape({"y": x * x + 2}), ["given[0]"], [], {"y": ["answer[0]", "answer[4]"]})
    ['let v0,v1;', 'v0=given[0];', 'v0=v0*v0;', 'v1=2.0;', 'answer[0]=answer[4]=v0+v1;']
    """
    texts = list(statements(tape, {"varying": varying, "uniform": uniform}, targets, _TEXT, number_text))
    names = sorted({register for register, _ in texts if register is not None})
    return [f"let {','.join(f'v{k}' for k in names)};", *(text for _, text in texts)] if names else []


def number_text(number: float) -> str:
    """A float as JavaScript writes it, to its last bit.

    >>> number_text(0.1), number_text(float("-inf"))
    ('0.1', '-Infinity')
    """
    return repr(float(number)).replace("inf", "Infinity").replace("nan", "NaN")
