"""Tapes as statements of a language with assignments: one for each operation, in the same order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from assur.numerics.recording.registers import assignments
from assur.numerics.recording.tape import Tape


def statements(
    tape: Tape,
    given: Mapping[str, Sequence[str]],
    targets: Mapping[str, Sequence[str]],
    texts: Mapping[str, str],
    number_text: Callable[[float], str],
) -> Iterator[tuple[int | None, str]]:
    """Each statement, and the register that it changes; the last use of a number needs none.

    Args:
        tape: the program.
        given: "varying" and "uniform" -> expressions of the numbers that are given, in the tape's order.
        targets: output -> what its number is assigned to.
        texts: operation -> the language's expression of it, arguments as {0} and {1}.
        number_text: a number as the language writes it.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> [*statements(recorder.tape({"y": x + x}), {"varying": ["x"]}, {"y": ["y"]}, {"+": "{0} + {1}"}, repr)]
    [(0, 'v0=x;'), (None, 'y=v0 + v0;')]
    """
    goals: dict[int, list[str]] = {}
    for name, entry in tape.outputs.items():
        goals.setdefault(entry, []).extend(targets[name])
    taken = {argument for operation in tape.operations for argument in operation.arguments}
    for step in assignments(tape):
        name = step.operation.name
        if name in given:
            value = given[name][step.given]
        elif name == "number":
            value = number_text(step.operation.number)
        else:
            value = texts[name].format(*(f"v{k}" for k in step.arguments))
        own = [f"v{step.register}"] if step.entry in taken else []
        yield step.register if own else None, f"{'='.join([*goals.get(step.entry, []), *own, value])};"
