"""Derivatives of tapes, which are tapes again: reverse mode for many given numbers, forward mode along a direction.

Reverse: starting from an output, each entry's adjoint (the output's derivative with respect to it) is passed to its
arguments. What the tape worked out already is used again, so that a gradient with respect to everything costs a small
multiple of the tape. Forward: the tape over dual numbers whose parts are recorded.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from assur.errors import UnknownNameError
from assur.numerics.recording.tape import LOGICAL, Recorded, Recorder, Tape


def gradient(tape: Tape, outputs: Sequence[str], names: Sequence[str], *, keep: bool = True) -> Tape:
    """The tape with derivatives of outputs with respect to varying and uniform numbers, by reverse mode.

    Args:
        tape: the program.
        outputs: which of its outputs, numbers all.
        names: with respect to which of its varying and uniform numbers.
        keep: whether the outputs of the tape remain outputs, beside the derivatives.

    Returns:
        A tape of the same given numbers, with an output `derivative(output, name)` for each of both: the partial
        derivative at each element. Where a root's radicand is zero or negative they are not finite or mean nothing, as
        the branch's margins say; the derivative of a magnitude at zero is 0.

    Errors:
        UnknownNameError: an output that the tape lacks, or that is true or false; a number that is not given to it.

    Example:
        >>> recorder = Recorder()
        >>> x, p = recorder.varying("x"), recorder.uniform("p")
        >>> slopes = gradient(recorder.tape({"y": x * x * p}), ["y"], ["x", "p"])
        >>> {name: float(value) for name, value in slopes.evaluate([3.0], [2.0]).items()}
        {'y': 18.0, 'dy/dx': 12.0, 'dy/dp': 9.0}
    """
    numeric = [name for name in tape.outputs if name not in tape.logical]
    for name in outputs:
        if name not in numeric:
            raise UnknownNameError("output of a tape with a derivative", name, numeric)
    for name in names:
        if name not in (*tape.varying, *tape.uniform):
            raise UnknownNameError("given number of a tape", name, (*tape.varying, *tape.uniform))
    recorder, values = _replayed(tape)
    places = _given_places(tape)
    numbers: dict[str, Any] = {name: values[k] for name, k in tape.outputs.items()} if keep else {}
    for output in outputs:
        adjoints = _adjoints(tape, values, tape.outputs[output], {places[name] for name in names})
        for name in names:
            numbers[derivative(output, name)] = adjoints.get(places[name], 0.0)
    return recorder.tape(numbers)


def derivative(output: str, name: str) -> str:
    """How a derivative is called among the outputs of a gradient."""
    return f"d{output}/d{name}"


def directional(tape: Tape, direction: str = "d") -> Tape:
    """The tape with the derivative of every output along a direction in its varying numbers, by forward mode.

    Args:
        tape: the program.
        direction: before the name of a varying number, the name of its rate, which is given too.

    Example:
        >>> recorder = Recorder()
        >>> x, y = recorder.varying("x"), recorder.varying("y")
        >>> moved = directional(recorder.tape({"area": x * y}))
        >>> moved.varying, {name: float(v) for name, v in moved.evaluate([3.0, 2.0, 1.0, 0.0], []).items()}
        (('x', 'y', 'dx', 'dy'), {'area': 6.0, 'darea': 2.0})
    """
    recorder, values = _replayed(tape)
    rates: list[Any] = []
    names = iter(tape.varying)
    for k, operation in enumerate(tape.operations):
        if operation.name == "varying":
            rates.append(recorder.varying(f"{direction}{next(names)}"))
            continue
        parts = [
            _times(slope, rates[a])
            for a, slope in zip(
                operation.arguments, _slopes(operation.name, values, operation.arguments, k), strict=True
            )
        ]
        rates.append(_sum(parts))
    numbers: dict[str, Any] = {name: values[k] for name, k in tape.outputs.items()}
    for name, k in tape.outputs.items():
        if name not in tape.logical:
            numbers[f"{direction}{name}"] = 0.0 if rates[k] is None else rates[k]
    return recorder.tape(numbers)


def _replayed(tape: Tape) -> tuple[Recorder, list[Recorded]]:
    """A recorder that holds the tape, and the numbers of its entries."""
    recorder = Recorder()
    values: list[Recorded] = []
    given = {"varying": (recorder.varying, iter(tape.varying)), "uniform": (recorder.uniform, iter(tape.uniform))}
    for operation in tape.operations:
        if operation.name in given:
            make, names = given[operation.name]
            values.append(make(next(names)))
        elif operation.name == "number":
            values.append(recorder.number(operation.number))
        else:
            values.append(recorder.apply(operation.name, *(values[k] for k in operation.arguments)))
    return recorder, values


def _given_places(tape: Tape) -> dict[str, int]:
    names = {"varying": iter(tape.varying), "uniform": iter(tape.uniform)}
    return {next(names[operation.name]): k for k, operation in enumerate(tape.operations) if operation.name in names}


def _adjoints(tape: Tape, values: Sequence[Recorded], output: int, places: set[int]) -> dict[int, Any]:
    """Entry -> derivative of the output with respect to it, for the entries between the wanted ones and the output."""
    between = _leading_to(tape, places)
    parts: dict[int, list[Any]] = {output: [1.0]} if output in between else {}
    adjoints: dict[int, Any] = {}
    for k in range(output, -1, -1):
        if k not in parts:
            continue
        operation = tape.operations[k]
        adjoints[k] = _sum(parts[k])
        for a, slope in zip(operation.arguments, _slopes(operation.name, values, operation.arguments, k), strict=True):
            if a in between and (part := _times(slope, adjoints[k])) is not None:
                parts.setdefault(a, []).append(part)
    return adjoints


def _leading_to(tape: Tape, places: set[int]) -> set[int]:
    """Entries that depend on a wanted one."""
    leading = set(places)
    for k, operation in enumerate(tape.operations):
        if operation.name not in LOGICAL and leading.intersection(operation.arguments):
            leading.add(k)
    return leading


def _slopes(name: str, values: Sequence[Recorded], arguments: Sequence[int], k: int) -> Iterator[Any]:
    """Derivative of an entry with respect to each argument; None where it has none."""
    if name == "+":
        yield from (1.0, 1.0)
    elif name == "-":
        yield from (1.0, -1.0)
    elif name == "*":
        first, second = (values[a] for a in arguments)
        yield from (second, first)
    elif name == "/":
        share = 1.0 / values[arguments[1]]
        yield from (share, -(values[k] * share))
    elif name == "negative":
        yield -1.0
    elif name == "magnitude":
        number = values[arguments[0]]
        yield number / (values[k] + SMALLEST)
    elif name == "root":
        yield 0.5 / values[k]
    else:
        yield from (None for _ in arguments)


SMALLEST = 1e-300
"""Added to a magnitude before division, so that the slope of |x| is 0 at 0."""


def _times(slope: Any, number: Any) -> Any:
    """Their product; 1, -1 and None cost nothing."""
    if slope is None or number is None:
        return None
    for factor, rest in ((slope, number), (number, slope)):
        if isinstance(factor, float) and abs(factor) == 1.0:
            return rest if factor == 1.0 else -rest
    return slope * number


def _sum(parts: Sequence[Any]) -> Any:
    total: Any = None
    for part in parts:
        if part is not None:
            total = part if total is None else total + part
    return total
