"""Tapes made ready for intervals: what does not vary worked out once, and slopes or derivatives beside the values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.rates import ClampedIntervals
from assur.numerics.intervals.sloped import Sloped, SlopedNumbers
from assur.numerics.number_types import Intervals
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.tape import Operation, Recorded, Recorder, Tape, pruned, without_unused


@dataclass(frozen=True, eq=False)
class FoldedTape:
    """A program in two parts, of which the first is worked out once.

    Attributes:
        uniform: what does not vary; its outputs are the uniform numbers of the other part, in their order.
        varying: the rest, with the outputs of the program.
    """

    uniform: Tape
    varying: Tape

    def numbers(self, uniform: Sequence[Interval], *, clamped: bool = True) -> tuple[Interval, ...]:
        """The uniform numbers of the varying part, from those of the program.

        `clamped` says whether the root of a negative number counts as defined.
        """
        values = self.uniform.evaluate([], uniform, ClampedIntervals() if clamped else Intervals())
        return tuple(map(as_interval, values.values()))


def folded(tape: Tape) -> FoldedTape:
    """A program with everything that does not vary apart, to be worked out once.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x, p = recorder.varying("x"), recorder.uniform("p")
    >>> program = folded(recorder.tape({"f": x + p * p}))
    >>> [item.name for item in program.varying.operations], program.numbers([as_interval(3.0)])[0].contains(9.0)
    (['varying', 'uniform', '+'], array(True))
    """
    varies: list[bool] = []
    for operation in tape.operations:
        varies.append(operation.name == "varying" or any(varies[k] for k in operation.arguments))
    needed = {*tape.outputs.values()}
    needed.update(
        k
        for operation, is_varying in zip(tape.operations, varies, strict=True)
        if is_varying
        for k in operation.arguments
    )
    operations: list[Operation] = []
    constants: dict[str, int] = {}
    place: dict[int, int] = {}
    for k, operation in enumerate(tape.operations):
        if varies[k]:
            operations.append(Operation(operation.name, tuple(place[argument] for argument in operation.arguments)))
        elif k not in needed:
            continue
        elif operation.name == "number":
            operations.append(operation)
        else:
            operations.append(Operation("uniform"))
            constants[f"constant {len(constants)}"] = k
        place[k] = len(operations) - 1
    outputs = {name: place[k] for name, k in tape.outputs.items()}
    same, _ = without_unused(pruned(tape.operations, tape.varying, tape.uniform, constants))
    return FoldedTape(same, Tape(tuple(operations), tape.varying, tuple(constants), outputs))


@dataclass(frozen=True, eq=False)
class SlopedProgram:
    """What a tape does to sloped numbers, as a program over intervals.

    Attributes:
        program: its varying numbers are those of the tape, each with its slopes and its middle before it; its outputs
            are "f", "f middle" and "f slope 0", for each output f of the tape, of slopes those that there are.
        size: number of coordinates.
    """

    program: IntervalProgram
    outputs: tuple[str, ...]
    size: int

    def __call__(self, varying: Sequence[Sloped | Interval], uniform: Sequence[Interval]) -> dict[str, Sloped]:
        """Outputs of the tape by name; numbers of the shape that it was made for."""
        outputs = self.program([part for number in varying for part in _parts(number)], uniform)
        return {
            name: Sloped(
                outputs[f"{name} middle"],
                outputs[name],
                tuple(outputs.get(f"{name} slope {k}") for k in range(self.size)),
            )
            for name in self.outputs
        }


def sloped_program(tape: Tape, varying: Sequence[Sloped | Interval], size: int) -> SlopedProgram:
    """The program of a folded tape for numbers of the shape of these: sloped or not, by which of so many coordinates.

    >>> import numpy as np
    >>> from assur.numerics.intervals.sloped import coordinate
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> numbers = [coordinate(Interval.of([1.0], [3.0]), np.array([2.0]), 0, 1)]
    >>> found = sloped_program(recorder.tape({"f": x * x}), numbers, 1)(numbers, [])["f"]
    >>> found.slopes[0].low.round(6), found.slopes[0].high.round(6)
    (array([3.]), array([5.]))
    """
    recorder, nothing = Recorder(), (None,) * size
    new: Callable[[str], Any] = recorder.varying  # it stands for an interval
    numbers: list[Any] = []
    for name, number in zip(tape.varying, varying, strict=True):
        if isinstance(number, Sloped):
            having = enumerate(slope is not None for slope in number.slopes)
            slopes = tuple(new(f"{name} slope {k}") if has else None for k, has in having)
            numbers.append(Sloped(new(f"{name} middle"), new(name), slopes))
        else:
            whole = new(name)
            numbers.append(Sloped(whole, whole, nothing))
    constants: list[Any] = [recorder.uniform(name) for name in tape.uniform]
    values = tape.evaluate(numbers, [Sloped(number, number, nothing) for number in constants], SlopedNumbers())
    outputs: dict[str, Any] = {}
    for name, own in values.items():
        value = own if isinstance(own, Sloped) else Sloped(own, own, nothing)  # a number, as a factor that is one
        outputs |= {f"{name} middle": value.centre, name: value.whole}
        outputs |= {f"{name} slope {k}": slope for k, slope in enumerate(value.slopes) if slope is not None}
    return SlopedProgram(IntervalProgram(recorder.tape(outputs), clamped=True), tuple(values), size)


def _parts(number: Sloped | Interval) -> tuple[Interval, ...]:
    """Slopes, middle and whole, or the number as it is."""
    if not isinstance(number, Sloped):
        return (number,)
    return (*(slope for slope in number.slopes if slope is not None), number.centre, number.whole)


def with_derivatives(tape: Tape, angles: Mapping[str, tuple[str, str]], names: Sequence[str]) -> Tape:
    """The tape with the derivatives of its outputs, "df/dx", by varying numbers; those that are always zero left out.

    Args:
        tape: the program, folded.
        angles: names of angles, each with the varying numbers that are its cosine and its sine.
        names: with respect to which varying numbers or angles.

    Where a root's radicand may be zero or negative its derivative is not defined.

    >>> recorder = Recorder()
    >>> x, y = recorder.varying("x"), recorder.varying("y")
    >>> found = with_derivatives(recorder.tape({"f": x * y, "g": recorder.sqrt(y)}), {}, ["x", "y"])
    >>> {name: float(value) for name, value in found.evaluate([3.0, 4.0], [1.0]).items()}
    {'f': 12.0, 'df/dx': 4.0, 'df/dy': 3.0, 'g': 2.0, 'dg/dy': 0.25}
    """
    recorder = Recorder()
    given: dict[str, Any] = {name: recorder.varying(name) for name in tape.varying}
    constants: list[Any] = [recorder.uniform(name) for name in tape.uniform]
    one = recorder.uniform("one")
    rates: dict[str, list[Any]] = {name: [None] * len(names) for name in tape.varying}
    for k, name in enumerate(names):
        if name in angles:
            cosine, sine = angles[name]
            rates[cosine][k], rates[sine][k] = -given[sine], given[cosine]
        else:
            rates[name][k] = one
    numbers: list[Any] = [Sloped(given[name], given[name], tuple(rates[name])) for name in tape.varying]
    nothing = (None,) * len(names)
    same: list[Any] = [Sloped(number, number, nothing) for number in constants]
    outputs: dict[str, Any] = {}
    for output, value in tape.evaluate(numbers, same, _Derivatives(recorder)).items():
        outputs[output] = value.whole
        outputs |= {f"d{output}/d{names[k]}": rate for k, rate in enumerate(value.slopes) if rate is not None}
    return recorder.tape(outputs)


class _Derivatives:
    """Namespace for sloped numbers whose middle is all of them: their slopes are derivatives."""

    def __init__(self, recorder: Recorder) -> None:
        self.recorder = recorder

    def sqrt(self, radicand: Sloped, /) -> Sloped:
        """Root of max(radicand, 0), with the derivative r' / (2 root)."""
        root: Any = self.recorder.sqrt(radicand.whole)
        rate: Recorded = 0.5 / root
        return Sloped(root, root, tuple(None if slope is None else slope * rate for slope in radicand.slopes))
