"""Straight-line programs: what a kernel did to its numbers, written down once.

A kernel that is read over `Recorded` numbers leaves a `Tape`: a list of operations on earlier results. Equal operations
on equal arguments are one entry. Nothing is reordered or simplified, so that a tape rounds as the kernel over floats
does: its bits are those of NumPy.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from assur.numerics.intervals import rates
from assur.numerics.number_types import Floats
from assur.numerics.powers import whole_power


class Operation(NamedTuple):
    """One entry: an operation on earlier entries, a number, or a place where one is given.

    `name` is one of "varying" and "uniform" (given: one per element, or one for all), "number", "+", "-", "*", "/",
    "negative", "magnitude", "root", ">=", ">", "and", "not"; of intervals alone "sign rate" and "root rate".
    """

    name: str
    arguments: tuple[int, ...] = ()
    number: float = 0.0


@dataclass(frozen=True, eq=False)
class Tape:
    """A straight-line program of many elements at once.

    Attributes:
        operations: entries in the order in which they are worked out.
        varying, uniform: names of what is given for each element, and for all of them.
        outputs: name -> index of its entry.
    """

    operations: tuple[Operation, ...]
    varying: tuple[str, ...]
    uniform: tuple[str, ...]
    outputs: Mapping[str, int]

    @property
    def logical(self) -> frozenset[str]:
        """Outputs that are true or false."""
        return frozenset(name for name, k in self.outputs.items() if self.operations[k].name in LOGICAL)

    def evaluate(self, varying: Sequence[Any], uniform: Sequence[Any], ns: Any = None) -> dict[str, Any]:
        """Outputs at given numbers of any type, entry by entry.

        Args:
            varying: one number per name in `varying`: arrays (...), intervals, duals, numbers of another recorder.
            uniform: one number per name in `uniform`.
            ns: the namespace of the type, for its root; floats where none is given.

        Over float arrays a compiled loop agrees with this to the last bit.
        """
        root = (ns or Floats()).sqrt
        values: list[Any] = []
        given = {"varying": iter(varying), "uniform": iter(uniform)}
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for operation in self.operations:
                if operation.name in given:
                    values.append(next(given[operation.name]))
                elif operation.name == "number":
                    values.append(operation.number)
                elif operation.name == "root":
                    values.append(root(values[operation.arguments[0]]))
                else:
                    values.append(MEANING[operation.name](*(values[k] for k in operation.arguments)))
        return {name: values[k] for name, k in self.outputs.items()}

    def dependence(self) -> dict[str, frozenset[str]]:
        """On which varying numbers each output depends.

        >>> recorder = Recorder()
        >>> x, y = recorder.varying("x"), recorder.varying("y")
        >>> found = recorder.tape({"both": x * y, "one": y + 1}).dependence()
        >>> sorted(found["both"]), sorted(found["one"])
        (['x', 'y'], ['y'])
        """
        names_by_entry: list[frozenset[str]] = []
        names = iter(self.varying)
        for operation in self.operations:
            own_name = frozenset([next(names)]) if operation.name == "varying" else frozenset[str]()
            names_by_entry.append(own_name.union(*(names_by_entry[k] for k in operation.arguments)))
        return {name: names_by_entry[k] for name, k in self.outputs.items()}


MEANING: Mapping[str, Callable[..., Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "negative": operator.neg,
    "magnitude": abs,
    ">=": operator.ge,
    ">": operator.gt,
    "and": operator.and_,
    "not": np.logical_not,
    "sign rate": rates.sign_rate,
    "root rate": rates.root_rate,
}
"""What the operations mean over every number type, rates over intervals; the root is that of its namespace."""

LOGICAL = frozenset({">=", ">", "and", "not"})
"""Operations whose result is true or false."""


class Recorder:
    """Namespace for a kernel over recorded numbers; it collects their operations.

    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> tape = recorder.tape({"y": recorder.sqrt(x * x + 1)})
    >>> [item.name for item in tape.operations], float(tape.evaluate([0.75], [])["y"])
    (['varying', '*', 'number', '+', 'root'], 1.25)
    """

    def __init__(self) -> None:
        self._operations: list[Operation] = []
        self._places: dict[Operation, int] = {}
        self._varying: list[str] = []
        self._uniform: list[str] = []

    def __len__(self) -> int:
        """How many operations were recorded, equal ones once."""
        return len(self._operations)

    def varying(self, name: str) -> Recorded:
        """A number that is given for each element."""
        self._varying.append(name)
        return self._append(Operation("varying"))

    def uniform(self, name: str) -> Recorded:
        """A number that is given once for all elements."""
        self._uniform.append(name)
        return self._append(Operation("uniform"))

    def sqrt(self, radicand: Any, /) -> Recorded:
        """Root of max(radicand, 0)."""
        return self.apply("root", radicand)

    def apply(self, name: str, *arguments: Any) -> Recorded:
        """The result of an operation, found again where it was done before."""
        indices = tuple([self._number(argument).index for argument in arguments])
        return self.shared(Operation(name, indices))

    def tape(self, outputs: Mapping[str, Any]) -> Tape:
        """What was recorded, with the numbers that are wanted of it; what these do not need is left out."""
        entries = {name: self._number(value).index for name, value in outputs.items()}
        return pruned(self._operations, tuple(self._varying), tuple(self._uniform), entries)

    def number(self, value: float) -> Recorded:
        """A number that is written into the program."""
        return self.shared(Operation("number", number=float(value)))

    def _number(self, value: Any) -> Recorded:
        return value if isinstance(value, Recorded) else self.number(value)

    def shared(self, operation: Operation) -> Recorded:
        """The result of an operation on entries, found again where it was done before."""
        place = self._places.setdefault(operation, len(self._operations))
        if place == len(self._operations):
            self._operations.append(operation)
        return Recorded(self, place)

    def _append(self, operation: Operation) -> Recorded:
        self._operations.append(operation)
        return Recorded(self, len(self._operations) - 1)


def _forward(name: str) -> Callable[[Recorded, Any], Any]:
    """A binary operator."""

    def operation(self: Recorded, other: Any) -> Any:
        if type(other) is Recorded:
            return self.recorder.shared(Operation(name, (self.index, other.index)))
        return NotImplemented if _takes_over(other) else self.recorder.apply(name, self, other)

    return operation


def _backward(name: str) -> Callable[[Recorded, Any], Recorded]:
    """A binary operator whose left side is a plain number."""
    return lambda self, other: self.recorder.apply(name, other, self)


class Recorded:
    """A number of a kernel that is being recorded; plain numbers may stand on either side of an operator.

    One is made for every operation, thousands for a program: so it has slots, and its operators do little.
    """

    __slots__ = ("index", "recorder")

    def __init__(self, recorder: Recorder, index: int) -> None:
        self.recorder, self.index = recorder, index

    # an array on the left must leave the operator to the recorded number on the right
    __array_ufunc__ = None

    __add__, __radd__ = _forward("+"), _backward("+")
    __sub__, __rsub__ = _forward("-"), _backward("-")
    __mul__, __rmul__ = _forward("*"), _backward("*")
    __truediv__, __rtruediv__ = _forward("/"), _backward("/")

    def __pos__(self) -> Recorded:
        return self

    def __neg__(self) -> Recorded:
        return self.recorder.apply("negative", self)

    def __abs__(self) -> Recorded:
        return self.recorder.apply("magnitude", self)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __ge__(self, other: Any) -> Recorded:
        return self.recorder.apply(">=", self, other)

    def __gt__(self, other: Any) -> Recorded:
        return self.recorder.apply(">", self, other)

    def __and__(self, other: Any) -> Recorded:
        return self.recorder.apply("and", self, other)

    def __invert__(self) -> Recorded:
        return self.recorder.apply("not", self)


def _takes_over(other: Any) -> bool:
    """Whether the other side of an operator is a number type around this one, as a polynomial over recorded numbers."""
    return not isinstance(other, Recorded) and getattr(type(other), "__array_ufunc__", True) is None


def pruned(
    operations: Sequence[Operation], varying: tuple[str, ...], uniform: tuple[str, ...], outputs: Mapping[str, int]
) -> Tape:
    """The entries that the outputs need, and those that are given, in their order."""
    needed = set(outputs.values())
    for k in range(len(operations) - 1, -1, -1):
        if k in needed:
            needed.update(operations[k].arguments)
    kept = [k for k, operation in enumerate(operations) if k in needed or operation.name in ("varying", "uniform")]
    place = {k: new for new, k in enumerate(kept)}
    return Tape(
        _moved([operations[k] for k in kept], place), varying, uniform, {name: place[k] for name, k in outputs.items()}
    )


def _moved(operations: Sequence[Operation], place: Mapping[int, int]) -> tuple[Operation, ...]:
    """Operations whose arguments have gone to other places."""
    return tuple([Operation(name, tuple([place[k] for k in own]), number) for name, own, number in operations])


def without_unused(tape: Tape) -> tuple[Tape, tuple[int, ...]]:
    """The tape without varying numbers that no output needs, and the places of the others among them.

    >>> recorder = Recorder()
    >>> x, y = recorder.varying("x"), recorder.varying("y")
    >>> fewer, places = without_unused(recorder.tape({"twice": y + y}))
    >>> fewer.varying, places
    (('y',), (1,))
    """
    used = {argument for operation in tape.operations for argument in operation.arguments} | set(tape.outputs.values())
    given = [k for k, operation in enumerate(tape.operations) if operation.name == "varying"]
    places = tuple(place for place, k in enumerate(given) if k in used)
    dropped = {k for k in given if k not in used}
    kept = [k for k in range(len(tape.operations)) if k not in dropped]
    new = {k: place for place, k in enumerate(kept)}
    operations = _moved([tape.operations[k] for k in kept], new) if dropped else tape.operations
    outputs = {name: new[k] for name, k in tape.outputs.items()}
    return Tape(operations, tuple(tape.varying[place] for place in places), tape.uniform, outputs), places
