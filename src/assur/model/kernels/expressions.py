"""Expressions of a kernel's text, each turned into a function of the frame once, when the file is read."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from assur.model.kernels import values as data
from assur.model.kernels.faults import NESTING, FormFault, KernelFault, checked_length, checked_whole
from assur.model.kernels.functions import UNSET, CallFrame, Run, called
from assur.model.kernels.library import BUILTINS
from assur.model.kernels.operations import BINARY, COMPARISONS, UNARY, entry
from assur.model.kernels.scope import KernelScope, checked_name, target_names
from assur.model.kernels.values import Value
from assur.numerics.expanded import Expanded

NONE: Mapping[str, Value] = {}
FORM = "assignments, functions, for over a tuple, if on whole numbers, comprehensions, + - * / ** and calls"


def expression(node: ast.expr, scope: KernelScope, depth: int = 0) -> Run:
    """An expression as work on a frame.

    Errors:
        FormFault: not in the form that the evaluator reads.
    """
    reader = _READERS.get(type(node).__name__)
    if reader is None:
        word = _WORDS.get(type(node).__name__, type(node).__name__)
        raise FormFault(word, FORM, _HINTS.get(type(node).__name__, ""), node.lineno)
    if depth > NESTING:
        raise FormFault("expressions in one another, too deep", f"at most {NESTING} levels", line=node.lineno)
    return reader(node, scope, depth + 1)


def _constant(node: ast.Constant, scope: KernelScope, depth: int) -> Run:
    value = node.value
    if not isinstance(value, bool | int | float | str | type(None)):
        raise FormFault(f"a constant of type {type(value).__name__}", "numbers, texts, None", line=node.lineno)
    if isinstance(value, str):
        checked_length(len(value))
    if type(value) is int:
        checked_whole(value)
    return lambda frame: value


def _name(node: ast.Name, scope: KernelScope, depth: int) -> Run:
    name, place = node.id, scope.place(node.id)
    if place is not None:

        def local(frame: CallFrame) -> Value:
            value = frame.values[place]
            if value is UNSET:
                raise KernelFault(f"'{name}' is used before it has a value")
            return value

        return local
    shared = scope.shared
    scope.asked.setdefault(name, node.lineno)

    def of_file(frame: CallFrame) -> Value:
        if name in shared:
            return shared[name]
        if name in BUILTINS:
            return BUILTINS[name]
        raise KernelFault(f"'{name[:60]}' is used before it has a value")

    return of_file


def _attribute(node: ast.Attribute, scope: KernelScope, depth: int) -> Run:
    name, of, attribute = node.attr, expression(node.value, scope, depth), data.attribute
    if name.startswith("_"):
        raise FormFault(f"the attribute '{name[:60]}'", "names that do not begin with an underscore", line=node.lineno)
    return lambda frame: attribute(of(frame), name)


def _subscript(node: ast.Subscript, scope: KernelScope, depth: int) -> Run:
    of, index = expression(node.value, scope, depth), expression(node.slice, scope, depth)
    return lambda frame: entry(of(frame), index(frame))


def _slice(node: Any, scope: KernelScope, depth: int) -> Run:
    ends = [None if end is None else expression(end, scope, depth) for end in (node.lower, node.upper, node.step)]

    def cut(frame: CallFrame) -> slice:
        numbers = [None if end is None else end(frame) for end in ends]
        if any(number is not None and type(number) is not int for number in numbers) or numbers[2] == 0:
            raise KernelFault("a slice of something else than whole numbers")
        return slice(*numbers)

    return cut


def _binary(node: ast.BinOp, scope: KernelScope, depth: int) -> Run:
    operation = BINARY.get(type(node.op).__name__)
    if operation is None:
        raise FormFault(f"the operator {type(node.op).__name__}", "+ - * / **", line=node.lineno)
    left, right = expression(node.left, scope, depth), expression(node.right, scope, depth)

    def run(frame: CallFrame) -> Value:
        result = operation(left(frame), right(frame))
        if type(result) is Expanded:
            frame.meter.spend(len(result.terms) ** 2)  # at least as many as were multiplied
        return result

    return run


def _unary(node: ast.UnaryOp, scope: KernelScope, depth: int) -> Run:
    of = expression(node.operand, scope, depth)
    if isinstance(node.op, ast.Not):
        return lambda frame: not data.truth(of(frame))
    operation = UNARY.get(type(node.op).__name__)
    if operation is None:
        raise FormFault("the operator ~", "+ - * / **", line=node.lineno)
    return lambda frame: operation(of(frame))


def _comparison(node: ast.Compare, scope: KernelScope, depth: int) -> Run:
    sides = [expression(side, scope, depth) for side in (node.left, *node.comparators)]
    tests = [COMPARISONS[type(op).__name__] for op in node.ops]

    def compare(frame: CallFrame) -> bool:
        left = sides[0](frame)
        for test, side in zip(tests, sides[1:], strict=True):
            right = side(frame)
            if not test(left, right):
                return False
            left = right
        return True

    return compare


def _boolean(node: ast.BoolOp, scope: KernelScope, depth: int) -> Run:
    parts, stops = [expression(part, scope, depth) for part in node.values], isinstance(node.op, ast.Or)

    def first(frame: CallFrame) -> Value:
        value = None
        for part in parts:
            value = part(frame)
            if data.truth(value) is stops:
                break
        return value

    return first


def _choice(node: ast.IfExp, scope: KernelScope, depth: int) -> Run:
    test, yes, no = (expression(part, scope, depth) for part in (node.test, node.body, node.orelse))
    return lambda frame: yes(frame) if data.truth(test(frame)) else no(frame)


def _text(node: ast.JoinedStr, scope: KernelScope, depth: int) -> Run:
    parts: list[Run] = []
    for part in node.values:
        if isinstance(part, ast.FormattedValue):
            if part.conversion != -1 or part.format_spec is not None:
                raise FormFault("a format in a text", "{name} alone", line=node.lineno)
            parts.append(expression(part.value, scope, depth))
        else:
            parts.append(expression(part, scope, depth))

    def join(frame: CallFrame) -> str:
        text = "".join(data.text_of(part(frame)) for part in parts)
        checked_length(len(text))
        return text

    return join


def _row(node: ast.Tuple | ast.List, scope: KernelScope, depth: int) -> Run:
    make = tuple if isinstance(node, ast.Tuple) else list
    if not any(isinstance(part, ast.Starred) for part in node.elts):
        parts = [expression(part, scope, depth) for part in node.elts]
        return lambda frame: make([part(frame) for part in parts])
    spread = _spread(node.elts, scope, depth)
    return lambda frame: make(spread(frame))


def _spread(nodes: Sequence[ast.expr], scope: KernelScope, depth: int) -> Callable[[CallFrame], list[Value]]:
    """Values of a row in which some have a star."""
    starred = [isinstance(node, ast.Starred) for node in nodes]
    parts = [expression(node.value if isinstance(node, ast.Starred) else node, scope, depth) for node in nodes]

    def collect(frame: CallFrame) -> list[Value]:
        row: list[Value] = []
        for part, star in zip(parts, starred, strict=True):
            if star:
                row.extend(data.entries(part(frame)))
            else:
                row.append(part(frame))
            checked_length(len(row))
        return row

    return collect


def _table(node: ast.Dict, scope: KernelScope, depth: int) -> Run:
    parts = [
        (None if name is None else expression(name, scope, depth), expression(value, scope, depth))
        for name, value in zip(node.keys, node.values, strict=True)
    ]

    def make(frame: CallFrame) -> dict[Any, Value]:
        table: dict[Any, Value] = {}
        for name, value in parts:
            if name is None:
                table.update(_as_table(value(frame)))
            else:
                table[data.key(name(frame))] = value(frame)
            checked_length(len(table))
        return table

    return make


def _as_table(value: Value) -> Mapping[Any, Value]:
    if not isinstance(value, data.TABLES):
        raise KernelFault(f"two stars before {data.kind_of(value)}", "a table")
    return value


def _call(node: ast.Call, scope: KernelScope, depth: int) -> Run:
    function, spread = _callee(node.func, scope, depth), _arguments(node.args, scope, depth)
    named = [(keyword.arg, expression(keyword.value, scope, depth)) for keyword in node.keywords]

    if not named:
        return lambda frame: called(function(frame), spread(frame), NONE, frame.meter)

    def call(frame: CallFrame) -> Value:
        keywords: dict[str, Value] = {}
        for name, value in named:
            for key, part in data.spread(value(frame)) if name is None else ((name, value(frame)),):
                if key in keywords:
                    raise KernelFault(f"'{key[:40]}' is given twice")
                keywords[key] = part
        return called(function(frame), spread(frame), keywords, frame.meter)

    return call


def _callee(node: ast.expr, scope: KernelScope, depth: int) -> Run:
    """What is called: methods of lists, texts and tables are looked up here alone."""
    if not isinstance(node, ast.Attribute) or node.attr.startswith("_"):
        return expression(node, scope, depth)
    of, name, method = expression(node.value, scope, depth + 1), node.attr, data.method
    return lambda frame: method(of(frame), name)


def _arguments(nodes: list[ast.expr], scope: KernelScope, depth: int) -> Callable[[CallFrame], list[Value]]:
    if any(isinstance(node, ast.Starred) for node in nodes):
        return _spread(nodes, scope, depth)
    parts = [expression(node, scope, depth) for node in nodes]
    return lambda frame: [part(frame) for part in parts]


def _comprehension(node: ast.GeneratorExp | ast.ListComp, scope: KernelScope, depth: int) -> Run:
    make = list if isinstance(node, ast.ListComp) else tuple

    def finish(frame: CallFrame, loop: Callable[[CallFrame, Callable[[], None]], None], element: Run) -> Value:
        row: list[Value] = []

        def step() -> None:
            checked_length(len(row) + 1)
            row.append(element(frame))

        loop(frame, step)
        return make(row)

    return _looped(node.generators, [node.elt], scope, depth, lambda frame, loop, of: finish(frame, loop, of[0]))


def _table_comprehension(node: ast.DictComp, scope: KernelScope, depth: int) -> Run:
    def finish(frame: CallFrame, loop: Callable[[CallFrame, Callable[[], None]], None], of: list[Run]) -> Value:
        table: dict[Any, Value] = {}

        def step() -> None:
            table[data.key(of[0](frame))] = of[1](frame)
            checked_length(len(table))

        loop(frame, step)
        return table

    return _looped(node.generators, [node.key, node.value], scope, depth, finish)


def _looped(
    generators: list[ast.comprehension],
    elements: list[ast.expr],
    scope: KernelScope,
    depth: int,
    finish: Callable[[CallFrame, Any, list[Run]], Value],
) -> Run:
    """The loops of a comprehension, whose names are its own."""
    size = sum(1 for part in elements for _ in ast.walk(part)) + 2
    opened: list[tuple[Run, Callable[[CallFrame, Value], None], list[Run]]] = []
    for generator in generators:
        if generator.is_async:
            raise FormFault("an async loop", FORM, line=elements[0].lineno)
        source = expression(generator.iter, scope, depth)  # read where its own names do not count yet
        scope.inner.append({name: scope.new() for name in _targets(generator.target)})
        opened.append(
            (source, target(generator.target, scope, depth), [expression(test, scope, depth) for test in generator.ifs])
        )
    of = [expression(part, scope, depth) for part in elements]
    del scope.inner[len(scope.inner) - len(generators) :]

    def loop(frame: CallFrame, step: Callable[[], None], level: int = 0) -> None:
        if level == len(opened):
            frame.meter.spend(size)
            step()
            return
        source, assign, tests = opened[level]
        for value in data.entries(source(frame)):
            frame.meter.spend(2)
            assign(frame, value)
            if all(data.truth(test(frame)) for test in tests):
                loop(frame, step, level + 1)

    return lambda frame: finish(frame, loop, of)


def _targets(node: ast.expr) -> list[str]:
    return [checked_name(name, node.lineno) for name in target_names(node)]


def target(node: ast.expr, scope: KernelScope, depth: int = 0) -> Callable[[CallFrame, Value], None]:
    """What gives a value to a name, to a row of names or to an entry of a table."""
    if depth > NESTING:
        raise FormFault("names in one another, too deep", f"at most {NESTING} levels", line=node.lineno)
    if isinstance(node, ast.Name):
        place = scope.named(checked_name(node.id, node.lineno))

        def assign(frame: CallFrame, value: Value) -> None:
            frame.values[place] = value

        return assign
    if isinstance(node, ast.Tuple | ast.List):
        return _row_of_targets(node.elts, scope, depth)
    if isinstance(node, ast.Subscript):
        of, index = expression(node.value, scope, depth + 1), expression(node.slice, scope, depth + 1)
        return lambda frame, value: _put(of(frame), index(frame), value)
    raise FormFault(
        f"a value is given to {'an attribute' if isinstance(node, ast.Attribute) else type(node).__name__}",
        "values are given to names and to entries of a table",
        line=node.lineno,
    )


def _row_of_targets(nodes: list[ast.expr], scope: KernelScope, depth: int) -> Callable[[CallFrame, Value], None]:
    stars = [k for k, node in enumerate(nodes) if isinstance(node, ast.Starred)]
    parts = [target(node.value if isinstance(node, ast.Starred) else node, scope, depth + 1) for node in nodes]
    if len(stars) > 1:
        raise FormFault("two stars in a row of names", "one", line=nodes[0].lineno)

    def assign(frame: CallFrame, value: Value) -> None:
        given = list(data.entries(value))
        if stars:
            first, rest = stars[0], len(nodes) - stars[0] - 1
            if len(given) >= len(nodes) - 1:
                given[first : len(given) - rest] = [given[first : len(given) - rest]]
        if len(given) != len(parts):
            raise KernelFault(f"{len(given)} values for {len(parts)} names")
        for part, one in zip(parts, given, strict=True):
            part(frame, one)

    return assign


def _put(table: Value, index: Value, value: Value) -> None:
    if type(table) is dict:
        table[data.key(index)] = value
        checked_length(len(table))
    elif type(table) is list and type(index) is int and -len(table) <= index < len(table):
        table[index] = value
    else:
        raise KernelFault(
            f"an entry of {data.kind_of(table)} is given a value", "entries of a table or list of its own"
        )


_READERS: Mapping[str, Callable[[Any, KernelScope, int], Run]] = {
    "Constant": _constant, "Name": _name, "Attribute": _attribute, "Subscript": _subscript, "Slice": _slice,
    "BinOp": _binary, "UnaryOp": _unary, "Compare": _comparison, "BoolOp": _boolean, "IfExp": _choice,
    "JoinedStr": _text, "Tuple": _row, "List": _row, "Dict": _table, "Call": _call, "GeneratorExp": _comprehension,
    "ListComp": _comprehension, "DictComp": _table_comprehension,
}  # fmt: skip
_WORDS = {
    "Lambda": "a lambda", "Await": "await", "Yield": "yield", "YieldFrom": "yield from", "NamedExpr": ":=",
    "Set": "a set", "SetComp": "a set", "Starred": "a star",
}  # fmt: skip
_HINTS = {"Lambda": "write it as a function, with def", "Set": "write a tuple", "SetComp": "write a tuple"}
