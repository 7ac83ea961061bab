"""Tapes as C99: the same operations in the same order, so with the same bits where nothing is contracted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from assur.numerics.recording.statements import statements
from assur.numerics.recording.tape import Tape

_TEXT = {
    "+": "{0} + {1}",
    "-": "{0} - {1}",
    "*": "{0} * {1}",
    "/": "{0} / {1}",
    "negative": "-{0}",
    "magnitude": "fabs({0})",
    "root": "sqrt({0} < 0.0 ? 0.0 : {0})",
}


def c99(tape: Tape, varying: Sequence[str], uniform: Sequence[str], targets: Mapping[str, Sequence[str]]) -> list[str]:
    """Statements that work out a tape, whose operations are those of closed forms: + - * / and roots.

    Args:
        tape: the program.
        varying: expressions of the numbers that are given for each element, in the tape's order.
        uniform: of those that are given once.
        targets: output -> what its number is assigned to.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> c99(recorder.tape({"y": x * x + 2}), ["given[0]"], [], {"y": ["answer[0]"]})
    ['double v0, v1;', 'v0=given[0];', 'v0=v0 * v0;', 'v1=2.0;', 'answer[0]=v0 + v1;']
    """
    texts = list(statements(tape, {"varying": varying, "uniform": uniform}, targets, _TEXT, number_text))
    names = sorted({register for register, _ in texts if register is not None})
    declared = [f"double {', '.join(f'v{k}' for k in names)};"] if names else []
    return [*declared, *(text for _, text in texts)]


def number_text(number: float) -> str:
    """A float as C writes it, to its last bit.

    >>> number_text(0.1), number_text(float("-inf"))
    ('0.1', '-HUGE_VAL')
    """
    return repr(float(number)).replace("inf", "HUGE_VAL").replace("nan", "NAN")
