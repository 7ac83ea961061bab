"""Tapes as JavaScript: the same operations in the same order, each of which IEEE 754 defines, so with the same bits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from assur.numerics.recording.registers import assignments
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
    texts = list(_statements(tape, {"varying": varying, "uniform": uniform}, targets))
    names = sorted({register for register, _ in texts if register is not None})
    return [f"let {','.join(f'v{k}' for k in names)};", *(text for _, text in texts)] if names else []


def number_text(number: float) -> str:
    """A float as JavaScript writes it, to its last bit.

    >>> number_text(0.1), number_text(float("-inf"))
    ('0.1', '-Infinity')
    """
    return repr(float(number)).replace("inf", "Infinity").replace("nan", "NaN")


def _statements(
    tape: Tape, given: Mapping[str, Sequence[str]], targets: Mapping[str, Sequence[str]]
) -> Iterator[tuple[int | None, str]]:
    """Each statement, and the register that it changes; the last use of a number needs none."""
    goals: dict[int, list[str]] = {}
    for name, entry in tape.outputs.items():
        goals.setdefault(entry, []).extend(targets[name])
    taken = {argument for item in tape.operations for argument in item.arguments}
    for item in assignments(tape):
        name = item.operation.name
        if name in given:
            value = given[name][item.given]
        elif name == "number":
            value = number_text(item.operation.number)
        else:
            value = _TEXT[name].format(*(f"v{k}" for k in item.arguments))
        own = [f"v{item.register}"] if item.entry in taken else []
        yield item.register if own else None, f"{'='.join([*goals.get(item.entry, []), *own, value])};"
