"""Statements of a kernel's text."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from assur.model.kernels import values as data
from assur.model.kernels.expressions import FORM, expression, target
from assur.model.kernels.faults import NESTING, FormFault, Meter
from assur.model.kernels.functions import UNSET, CallFrame, KernelFunction, Run
from assur.model.kernels.operations import BINARY
from assur.model.kernels.scope import KernelScope, assigned_names, checked_name, known


def function(
    node: ast.FunctionDef, around: KernelScope, asked: dict[str, int], file: Path, meter: Meter
) -> KernelFunction:
    """A function of the file.

    Args:
        node: its text.
        around: the names that its defaults may use.
        asked: the names of the file that its body asks for are added to these.
        file: its path, which errors name.
        meter: what its defaults may spend.
    """
    arguments = node.args
    if node.decorator_list:
        raise FormFault("a decorator", "functions without", line=node.lineno)
    if arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.posonlyargs:
        raise FormFault(f"stars among the arguments of {node.name}", "a plain list of names", line=node.lineno)
    names = [checked_name(item.arg, node.lineno) for item in arguments.args]
    given = [expression(default, around) for default in arguments.defaults]
    known(around)
    frame = CallFrame(around.size, meter)
    defaults = {
        name: _default(default(frame)) for name, default in zip(names[len(names) - len(given) :], given, strict=True)
    }
    scope = KernelScope(around.shared, asked)
    for name in (*names, *assigned_names(node.body)):
        scope.named(checked_name(name, node.lineno))
    body = block(node.body, scope)
    name = checked_name(node.name, node.lineno)
    return KernelFunction(name, node.lineno, file, tuple(names), defaults, scope.size, body)


def _default(value: data.Value) -> data.Value:
    data.parts_of(value)
    return data.frozen(value)


def block(nodes: list[ast.stmt], scope: KernelScope, depth: int = 0) -> Run:
    """Statements one after the other, up to the first that returns."""
    if depth > NESTING // 3:
        raise FormFault("statements in one another, too deep", f"at most {NESTING // 3} levels", line=nodes[0].lineno)
    steps = [(statement(node, scope, depth), node.lineno, _size(node)) for node in nodes]

    def run(frame: CallFrame) -> data.Value:
        meter = frame.meter
        for step, line, size in steps:
            meter.line = line
            meter.spend(size)
            value = step(frame)
            if value is not UNSET:
                return value
        return UNSET

    return run


def statement(node: ast.stmt, scope: KernelScope, depth: int) -> Run:
    """A statement as work on a frame.

    Errors:
        FormFault: not in the form that the evaluator reads.
    """
    reader = _READERS.get(type(node).__name__)
    if reader is None:
        word = _WORDS.get(type(node).__name__, type(node).__name__)
        raise FormFault(word, FORM, _HINTS.get(type(node).__name__, ""), node.lineno)
    return reader(node, scope, depth)


def _size(node: ast.stmt) -> int:
    """How many nodes are worked out, those of inner statements left out."""
    count, stack = 0, list[ast.AST]([node])
    while stack:
        count += 1
        stack += [part for part in ast.iter_child_nodes(stack.pop()) if not isinstance(part, ast.stmt)]
    return count


def _return(node: ast.Return, scope: KernelScope, depth: int) -> Run:
    return (lambda frame: None) if node.value is None else expression(node.value, scope)


def _assign(node: ast.Assign, scope: KernelScope, depth: int) -> Run:
    value, targets = expression(node.value, scope), [target(item, scope) for item in node.targets]

    def run(frame: CallFrame) -> data.Value:
        result = value(frame)
        for item in targets:
            item(frame, result)
        return UNSET

    return run


def _annotated(node: ast.AnnAssign, scope: KernelScope, depth: int) -> Run:
    if node.value is None:
        return lambda frame: UNSET
    value, item = expression(node.value, scope), target(node.target, scope)

    def run(frame: CallFrame) -> data.Value:
        item(frame, value(frame))
        return UNSET

    return run


def _changed(node: ast.AugAssign, scope: KernelScope, depth: int) -> Run:
    """`a += b` is `a = a + b`: nothing that another name holds is changed."""
    operation = BINARY.get(type(node.op).__name__)
    if operation is None or not isinstance(node.target, ast.Name):
        raise FormFault("an assignment with an operator", "name += value, and - * / |", line=node.lineno)
    old = expression(ast.Name(node.target.id, ast.Load(), lineno=node.lineno, col_offset=0), scope)
    value, item = expression(node.value, scope), target(node.target, scope)

    def run(frame: CallFrame) -> data.Value:
        item(frame, operation(old(frame), value(frame)))
        return UNSET

    return run


def _loop(node: ast.For, scope: KernelScope, depth: int) -> Run:
    if node.orelse:
        raise FormFault("for with else", FORM, line=node.lineno)
    source, item, body = expression(node.iter, scope), target(node.target, scope), block(node.body, scope, depth + 1)

    def run(frame: CallFrame) -> data.Value:
        for value in data.entries(source(frame)):
            frame.meter.spend(1)
            item(frame, value)
            result = body(frame)
            if result is not UNSET:
                return result
        return UNSET

    return run


def _choice(node: ast.If, scope: KernelScope, depth: int) -> Run:
    test, yes = expression(node.test, scope), block(node.body, scope, depth + 1)
    no: Run = block(node.orelse, scope, depth + 1) if node.orelse else lambda frame: UNSET
    return lambda frame: yes(frame) if data.truth(test(frame)) else no(frame)


def _alone(node: ast.Expr, scope: KernelScope, depth: int) -> Run:
    """A call for what it does to a list, or a docstring."""
    value = expression(node.value, scope)

    def run(frame: CallFrame) -> data.Value:
        value(frame)
        return UNSET

    return run


_READERS: Mapping[str, Callable[[Any, KernelScope, int], Run]] = {
    "Return": _return, "Assign": _assign, "AnnAssign": _annotated, "AugAssign": _changed, "For": _loop, "If": _choice,
    "Expr": _alone, "Pass": lambda node, scope, depth: lambda frame: UNSET,
}  # fmt: skip
_WORDS = {
    "While": "while", "With": "with", "AsyncWith": "async", "AsyncFor": "async", "AsyncFunctionDef": "async",
    "Try": "try", "TryStar": "try", "Raise": "raise", "Assert": "assert", "Delete": "del", "Global": "global",
    "Nonlocal": "nonlocal", "ClassDef": "a class", "FunctionDef": "a function inside another", "Match": "match",
    "Break": "break", "Continue": "continue", "Import": "import inside a function",
    "ImportFrom": "import inside a function",
}  # fmt: skip
_HINTS = {
    "While": "loops run over a tuple: for k in range(3)",
    "FunctionDef": "put it beside the other, and hand it what it needs",
    "ClassDef": "group values with SimpleNamespace(x=.., y=..)",
    "Raise": "what cannot be is a margin that is negative",
    "Assert": "what cannot be is a margin that is negative",
}
