"""Functions of a kernel's text: how they are called, by each other and from outside."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from assur.errors import MechanismFileError, Problem
from assur.model.kernels.faults import KernelFault, LimitFault, Meter
from assur.model.kernels.library import numeric
from assur.model.kernels.programs import KernelProgram, Shapeless, program, shape_of
from assur.model.kernels.values import Function, OfferedFunction, Value, frozen, kind_of, parts_of
from assur.numerics.number_types import Extended, Floats, Intervals

UNSET: Any = object()
"""Stands for a name that has no value yet."""
ARITHMETIC = (TypeError, ValueError, ZeroDivisionError, OverflowError, RecursionError, AttributeError, LookupError)
"""What goes wrong between numbers: no fault of ours, but of the kernel's text, which is told its line."""


PLAIN_NUMBERS = (Floats, Extended, Intervals)
"""Number types over which a program is the same as the text: they have + - * / and a root, and keep nothing."""
REPAID = 6
"""Calls after which a program is made: recording and compiling take as long as some ten walks through the text."""
MOST_SHAPES = 64
"""Of one kernel's arguments for which there is a program."""


class CallFrame:
    """The names of one call, by their places, and what is left of the budget."""

    __slots__ = ("meter", "values")

    def __init__(self, size: int, meter: Meter) -> None:
        self.values: list[Value] = [UNSET] * size
        self.meter = meter


Run = Callable[[CallFrame], Value]
"""What an expression or a statement became: work on a frame. A statement that returns gives its value, else UNSET."""


@dataclass(eq=False)
class Use:
    """How often a kernel was called with arguments of one shape, and its program where that is often."""

    calls: int = 0
    program: KernelProgram | None = None


@dataclass(frozen=True, eq=False)
class KernelFunction(Function):
    """A function of a kernel's text. It can be called like any other, and keeps nothing from one call to the next.

    Attributes:
        name, line, file: where it is defined.
        parameters: names of its arguments.
        defaults: what the last arguments are where they are not given.
        size: places of its frame.
        body: its statements.
        shapes: shape of arguments -> what there is for it.

    Errors of a call:
        MechanismFileError: the text cannot be worked out with these arguments, or takes too long.
    """

    name: str
    line: int
    file: Path
    parameters: tuple[str, ...]
    defaults: Mapping[str, Value]
    size: int
    body: Run
    shapes: dict[Any, Use] = field(default_factory=dict)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """The value at given arguments, with a budget of its own."""
        if arguments and type(arguments[0]) in PLAIN_NUMBERS:
            answer = self._by_program(arguments[0], arguments[1:], named)
            if answer is not UNSET:
                return answer
        return self.evaluated(*arguments, **named)

    def evaluated(self, *arguments: Any, **named: Any) -> Any:
        """The value by a walk through the text."""
        meter = Meter()
        meter.line = self.line
        return guarded(self.file, meter, lambda: self._answered(arguments, named, meter))

    def _answered(self, arguments: Sequence[Value], named: Mapping[str, Value], meter: Meter) -> Value:
        """The value at arguments that the text cannot change, itself of a size that can be walked through."""
        given = {name: frozen(value) for name, value in named.items()}
        value = self.run([frozen(value) for value in arguments], given, meter)
        parts_of(value)
        return value

    def _by_program(self, ns: Any, arguments: Sequence[Value], named: Mapping[str, Value]) -> Value:
        """The value by straight-line code, where there is some for arguments of this shape; else UNSET."""
        numbers: list[Value] = []
        try:
            shapes = tuple(shape_of(value, numbers) for value in arguments)
            by_name = {name: shape_of(value, numbers) for name, value in named.items()}
        except Shapeless:
            return UNSET
        key = shapes, tuple(by_name.items())
        if key not in self.shapes and len(self.shapes) == MOST_SHAPES:
            return UNSET
        use = self.shapes.setdefault(key, Use())
        use.calls += 1
        if use.calls == REPAID:
            use.program = program(self.evaluated, shapes, by_name)
        if use.program is None:
            return UNSET
        try:
            return use.program(numbers, ns.sqrt)
        except ARITHMETIC:
            return UNSET  # the walk through the text says where

    def run(self, arguments: Sequence[Value], named: Mapping[str, Value], meter: Meter) -> Value:
        """The value at given arguments, within the budget of a call that is under way."""
        frame = CallFrame(self.size, meter)
        self._bind(frame, arguments, named)
        line, meter.calls = meter.line, meter.calls - 1
        if meter.calls < 0:
            raise LimitFault("functions that call each other too deep", "straight-line algebra, without recursion")
        value = self.body(frame)
        meter.line, meter.calls = line, meter.calls + 1
        return None if value is UNSET else value

    def _bind(self, frame: CallFrame, arguments: Sequence[Value], named: Mapping[str, Value]) -> None:
        names = self.parameters
        if len(arguments) > len(names):
            raise KernelFault(f"{self.name} is given {len(arguments)} arguments", f"{len(names)}: {', '.join(names)}")
        frame.values[: len(arguments)] = arguments
        for name, value in named.items():
            place = names.index(name) if name in names else -1
            if place < len(arguments):
                raise KernelFault(f"{self.name} is given '{name[:40]}'", f"each of {', '.join(names)} once")
            frame.values[place] = value
        for place, name in enumerate(names):
            if frame.values[place] is UNSET:
                if name not in self.defaults:
                    raise KernelFault(f"{self.name} is not given '{name}'", f"its arguments: {', '.join(names)}")
                frame.values[place] = self.defaults[name]


def called(function: Value, arguments: Sequence[Value], named: Mapping[str, Value], meter: Meter) -> Value:
    """What a call inside a kernel's text gives."""
    if isinstance(function, KernelFunction):
        return function.run(arguments, named, meter)
    if isinstance(function, OfferedFunction):
        if function.takes == "numbers":
            count = sum(map(numeric, arguments)) + sum(map(numeric, named.values()))
            meter.spend(count * count)  # the costliest multiply each number with each
        else:
            meter.spend(sum(map(parts_of, arguments)) + sum(map(parts_of, named.values())))
        return function.function(*arguments, **named)
    raise KernelFault(f"{kind_of(function)} is called", "functions of this file, of the imports and of Python's own")


def guarded(file: Path, meter: Meter, work: Callable[[], Value]) -> Value:
    """What work gives; its faults as faults of the file, with the line.

    Errors:
        MechanismFileError: a fault.
    """
    try:
        return work()
    except KernelFault as fault:
        raise problem_of(file, fault, meter.line) from fault
    except ARITHMETIC as error:
        reason = "too deep" if isinstance(error, RecursionError) else f"{type(error).__name__}: {error}"[:300]
        wrong = KernelFault(reason, "straight-line algebra that works over every number type")
        raise problem_of(file, wrong, meter.line) from error


def problem_of(file: Path, fault: KernelFault, line: int | None = None) -> MechanismFileError:
    """The error that a user sees."""
    allowed = f"allowed: {fault.allowed}" if fault.allowed else "a kernel's text must be read without this"
    return MechanismFileError([Problem(str(file), fault.line or line, "", fault.reason, allowed, fault.hint)])
