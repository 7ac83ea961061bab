"""A kernel's text as straight-line code of ours: what it does to numbers, without the walk through its text.

The evaluator works a kernel out over recorded numbers once; the operations that it recorded are written down as lines
like `v7 = v3 * v5`. These have the bits of the evaluator's answer, and take a third of its time where arrays are short.
Nothing of the kernel's text is in them but its operations and numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from assur.model.closed_form import Branch
from assur.model.kernels.values import TABLES, Value, is_number
from assur.numerics.recording.tape import Recorded, Recorder, Tape

Shape = tuple[Any, ...]
"""How a value is made of numbers: nested, with a mark for each number; plain data stands for itself."""

NUMBER: Shape = ("number",)
LONGEST = 20_000
"""Operations of a program. Longer ones are left to the evaluator: Python would take seconds to read their lines."""


class Shapeless(Exception):  # noqa: N818  # no error: the evaluator takes what is not of numbers alone
    """A value that is made of something else than numbers and plain data."""


def shape_of(value: Value, numbers: list[Value]) -> Shape:
    """How a value is made of numbers, which are appended in order.

    Errors:
        Shapeless: it is made of something else too.

    >>> numbers = []
    >>> shape_of((1.5, (2, 2.5)), numbers), numbers
    (('tuple', ('number',), ('tuple', ('plain', 2, 'int'), ('number',))), [1.5, 2.5])
    """
    kind = type(value)
    if kind is tuple:
        return ("tuple", *[shape_of(part, numbers) for part in value])
    if kind is SimpleNamespace:
        parts = vars(value)
        return ("record", tuple(parts), *[shape_of(part, numbers) for part in parts.values()])
    if kind is int or kind is str or kind is bool or value is None:
        return ("plain", value, kind.__name__)  # True is 1 where they are compared
    if is_number(value):
        numbers.append(value)
        return NUMBER
    if kind in TABLES:
        return ("table", tuple(value), *[shape_of(part, numbers) for part in value.values()])
    if kind is list:
        return ("list", *[shape_of(part, numbers) for part in value])
    if kind is Branch:
        return ("branch", *[shape_of(part, numbers) for part in (value.pose, value.inputs, value.margins, value.core)])
    if isinstance(value, tuple):
        return ("named", kind, *[shape_of(part, numbers) for part in value])
    raise Shapeless


def made(shape: Shape, numbers: Iterator[Value]) -> Value:
    """A value of a shape, of these numbers."""
    kind, *parts = shape
    if kind == "number":
        return next(numbers)
    if kind == "plain":
        return parts[0]
    if kind in ("record", "table"):
        entries = {name: made(part, numbers) for name, part in zip(parts[0], parts[1:], strict=True)}
        return SimpleNamespace(**entries) if kind == "record" else entries
    if kind == "named":
        return parts[0](*(made(part, numbers) for part in parts[1:]))
    values = [made(part, numbers) for part in parts]
    return Branch(*values) if kind == "branch" else values if kind == "list" else tuple(values)


@dataclass(frozen=True, eq=False)
class KernelProgram:
    """A kernel over numbers of one shape.

    Attributes:
        run: (numbers, root) -> the numbers of the answer.
        answer: the shape of the answer.
    """

    run: Callable[[list[Value], Callable[[Value], Value]], list[Value]]
    answer: Shape

    def __call__(self, numbers: list[Value], root: Callable[[Value], Value]) -> Value:
        """The kernel's answer."""
        return made(self.answer, iter(self.run(numbers, root)))


def program(
    kernel: Callable[..., Value], shapes: tuple[Shape, ...], named: Mapping[str, Shape]
) -> KernelProgram | None:
    """The program of a kernel at arguments of these shapes, after the namespace; None where it has none.

    Args:
        kernel: evaluates the text: (namespace, *arguments) -> answer.
        shapes: of the arguments by place.
        named: of those by name.
    """
    recorder = Recorder()
    count = sum(_count(shape) for shape in (*shapes, *named.values()))
    given = [recorder.varying(f"v{k}") for k in range(count)]
    numbers = iter(given)
    arguments = [made(shape, numbers) for shape in shapes]
    answer = kernel(recorder, *arguments, **{name: made(shape, numbers) for name, shape in named.items()})
    results: list[Value] = []
    try:
        shape = shape_of(answer, results)
    except Shapeless:
        return None
    if not all(isinstance(result, Recorded | float) for result in results):
        return None  # a number type of the kernel's own, as a polynomial
    tape = recorder.tape({str(k): result for k, result in enumerate(results)})
    return KernelProgram(_compiled(tape, len(results)), shape) if len(tape.operations) <= LONGEST else None


def _count(shape: Shape) -> int:
    if shape is NUMBER or shape == NUMBER:
        return 1
    return sum(_count(part) for part in shape[1:] if isinstance(part, tuple) and part and isinstance(part[0], str))


_TEXT = {"+": "{} + {}", "-": "{} - {}", "*": "{} * {}", "/": "{} / {}", "negative": "-{}", "root": "root({})"}


def _compiled(tape: Tape, count: int) -> Callable[..., Any]:
    """The tape as a function of Python, of lines that are written here.

    A name is given anew once its value has no more use, so that long arrays are given back while they are at hand.
    """
    results = [tape.outputs[str(k)] for k in range(count)]
    last = {argument: k for k, operation in enumerate(tape.operations) for argument in operation.arguments}
    last |= dict.fromkeys(results, len(tape.operations))
    lines, free, names = ["def run(given, root):"], list[str](), dict[int, str]()
    varying = 0
    for k, operation in enumerate(tape.operations):
        used = [names[n] for n in operation.arguments]
        free += dict.fromkeys(names[n] for n in operation.arguments if last[n] == k)
        names[k] = free.pop() if free else f"v{k}"
        if operation.name == "varying":
            text = f"given[{varying}]"
            varying += 1
        elif operation.name == "number":
            text = repr(operation.number)
        else:
            text = _TEXT[operation.name].format(*used)
        lines.append(f"    {names[k]} = {text}")
        if k not in last:
            free.append(names[k])
    lines.append(f"    return [{', '.join(names[k] for k in results)}]")
    known: dict[str, Any] = {"inf": float("inf"), "nan": float("nan")}
    exec(compile("\n".join(lines), "<kernel>", "exec"), known)
    run: Callable[..., Any] = known["run"]
    return run
