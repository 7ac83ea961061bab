"""Names of numbers in straight-line code, used again once their number is no longer needed.

So a long tape over arrays stays in the processor's cache, and its text short.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NamedTuple

from assur.numerics.recording.tape import Operation, Tape


class Assignment(NamedTuple):
    """One statement: an operation on numbers in registers, whose result goes into a register.

    One is made for every operation, thousands for a program.

    Attributes:
        entry: of the tape.
        operation: what it does.
        register: where the result goes.
        arguments: registers of the numbers that it takes.
        given: of a number that is given, its place among those of its kind.
    """

    entry: int
    operation: Operation
    register: int
    arguments: tuple[int, ...]
    given: int


def assignments(tape: Tape, kept: Collection[int] = ()) -> Iterator[Assignment]:
    """The statements of a tape in their order; entries that are kept stay in their registers to the end.

    Other outputs are there from their own statement to the last one that takes them. What no output needs is left out.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> [(item.operation.name, item.register) for item in assignments(recorder.tape({"y": -(x * x)}))]
    [('varying', 0), ('*', 0), ('negative', 0)]
    """
    last = {k: k for k in tape.outputs.values()}
    last |= {argument: k for k, item in enumerate(tape.operations) for argument in item.arguments}
    last |= dict.fromkeys(kept, len(tape.operations))
    register, free, given = dict[int, int](), list[int](), {"varying": 0, "uniform": 0}
    for k, item in enumerate(tape.operations):
        name, taken, _ = item
        arguments = tuple([register[argument] for argument in taken])
        for argument in dict.fromkeys(taken):
            if last[argument] == k:
                free.append(register.pop(argument))
        place = given.get(name, 0)
        if name in given:
            given[name] += 1
        if k not in last:
            continue
        register[k] = free.pop() if free else len(register)
        yield Assignment(k, item, register[k], arguments, place)
        if last[k] == k:
            free.append(register.pop(k))
