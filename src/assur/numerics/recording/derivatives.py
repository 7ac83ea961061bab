"""Tapes recorded once more with what differentiates them: by the rules of calculus, entry by entry.

Numbers 0, 1 and -1 are integers, which leave no trace in what is recorded.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from assur.numerics.recording.tape import Operation, Recorder, Tape
from assur.numerics.vectors import minus, plus, times


def exact(number: float) -> Any:
    """A number, an integer where it is 0, 1 or -1.

    >>> exact(1.0), exact(0.5)
    (1, 0.5)
    """
    return int(number) if number in (0.0, 1.0, -1.0) else float(number)


def is_zero(number: Any) -> bool:
    """Whether a number is the integer 0."""
    return type(number) is int and number == 0


def quotient(number: Any, by: Any) -> Any:
    """A number over another; zero, and what is over one, as they are."""
    return number if is_zero(number) or (type(by) is int and by == 1) else number / by


def again(recorder: Recorder, tape: Tape) -> list[Any]:
    """All entries of a tape, recorded once more.

    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> own = Recorder()
    >>> len(again(own, recorder.tape({"y": x * x})))
    2
    """
    given = {"varying": (iter(tape.varying), recorder.varying), "uniform": (iter(tape.uniform), recorder.uniform)}
    entries: list[Any] = []
    for operation in tape.operations:
        if operation.name in given:
            names, record = given[operation.name]
            entries.append(record(next(names)))
        else:
            entries.append(done(recorder, operation, [entries[k] for k in operation.arguments]))
    return entries


def done(recorder: Recorder, operation: Operation, numbers: Sequence[Any]) -> Any:
    """An operation, with what 0, 1 and -1 make of it left out."""
    name = operation.name
    if name == "number":
        return exact(operation.number)
    if name == "root":
        return recorder.sqrt(numbers[0])
    if name == "negative":
        return minus(0, numbers[0])
    return {"+": plus, "-": minus, "*": times, "/": quotient}[name](*numbers)


def rates(tape: Tape, entries: Sequence[Any], seeds: Sequence[Any]) -> list[Any]:
    """How fast all entries of a tape change where its varying numbers change at the rates `seeds`.

    >>> recorder, own = Recorder(), Recorder()
    >>> x = recorder.varying("x")
    >>> tape = recorder.tape({"y": x * x * x})
    >>> entries = again(own, tape)
    >>> first = rates(tape, entries, [1])
    >>> own.tape({"first": first[-1], "second": second_rates(tape, entries, first)[-1]}).evaluate([2.0], [])
    {'first': 12.0, 'second': 12.0}
    """
    found: list[Any] = []
    given = iter(seeds)
    for k, operation in enumerate(tape.operations):
        a, b = (operation.arguments * 2)[:2] if operation.arguments else (0, 0)
        if operation.name == "varying":
            rate: Any = next(given)
        elif not operation.arguments:
            rate = 0
        elif operation.name in ("+", "-"):
            rate = (plus if operation.name == "+" else minus)(found[a], found[b])
        elif operation.name == "*":
            rate = plus(times(found[a], entries[b]), times(entries[a], found[b]))
        elif operation.name == "/":
            rate = quotient(minus(found[a], times(entries[k], found[b])), entries[b])
        elif operation.name == "root":
            rate = quotient(found[a], 2 * entries[k])
        else:
            rate = minus(0, found[a])
        found.append(rate)
    return found


def second_rates(tape: Tape, entries: Sequence[Any], first: Sequence[Any], seeds: Sequence[Any] = ()) -> list[Any]:
    """The rates of the rates `first`, where those of the varying numbers change by `seeds`; they stay without."""
    found: list[Any] = []
    given = iter(seeds)
    for k, operation in enumerate(tape.operations):
        a, b = (operation.arguments * 2)[:2] if operation.arguments else (0, 0)
        if not operation.arguments:
            rate: Any = next(given, 0) if operation.name == "varying" else 0
        elif operation.name in ("+", "-"):
            rate = (plus if operation.name == "+" else minus)(found[a], found[b])
        elif operation.name == "*":
            both = times(2, times(first[a], first[b]))
            rate = plus(plus(times(found[a], entries[b]), both), times(entries[a], found[b]))
        elif operation.name == "/":
            both = times(2, times(first[k], first[b]))
            rate = quotient(minus(minus(found[a], both), times(entries[k], found[b])), entries[b])
        elif operation.name == "root":
            rate = quotient(minus(found[a], times(2, times(first[k], first[k]))), 2 * entries[k])
        else:
            rate = minus(0, found[a])
        found.append(rate)
    return found
