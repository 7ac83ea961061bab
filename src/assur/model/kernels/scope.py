"""Names of a kernel's text: each is a place in a frame, a name of the file, or one of Python's own."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator
from dataclasses import dataclass, field

from assur.model.kernels.faults import FormFault, KernelFault
from assur.model.kernels.library import BUILTINS
from assur.model.kernels.values import Value


@dataclass
class KernelScope:
    """The names of one function, or of one statement of the file.

    Attributes:
        shared: names of the file, filled as the file is read.
        places: name -> place in the frame.
        asked: names that are no local ones -> the line where each is asked for first.
        inner: names of the comprehensions that are being read, the innermost last.
        size: places that are needed.
    """

    shared: dict[str, Value]
    asked: dict[str, int] = field(default_factory=dict)
    places: dict[str, int] = field(default_factory=dict)
    inner: list[dict[str, int]] = field(default_factory=list)
    size: int = 0

    def place(self, name: str) -> int | None:
        """Where a name stands in the frame; None where it is one of the file."""
        for names in reversed(self.inner):
            if name in names:
                return names[name]
        return self.places.get(name)

    def new(self) -> int:
        """A further place."""
        self.size += 1
        return self.size - 1

    def named(self, name: str) -> int:
        """The place of a name that is given a value; a new one where it has none."""
        if self.inner and name in self.inner[-1]:
            return self.inner[-1][name]
        if name not in self.places:
            self.places[name] = self.new()
        return self.places[name]


def checked_name(name: str, line: int) -> str:
    """A name that may be given a value: not one of Python's inner ones."""
    if name.startswith("__"):
        raise FormFault(f"the name '{name[:60]}'", "names that do not begin with two underscores", line=line)
    return name


def known(scope: KernelScope) -> None:
    """Check that every name that is asked for is one of the file, so far, or one of Python's that the form has.

    Errors:
        FormFault: it is one of Python's that the form does not have.
        KernelFault: it is nobody's.
    """
    for name, line in scope.asked.items():
        if name not in scope.shared and name not in BUILTINS:
            fault = FormFault if name in vars(builtins) else KernelFault
            raise fault(f"the name '{name[:60]}'", f"names of this file, and {', '.join(BUILTINS)}", line=line)


def assigned_names(body: list[ast.stmt]) -> Iterator[str]:
    """Names that a function's statements give a value to, comprehensions left out: these have their own."""
    for statement in body:
        yield from _of_statement(statement)


def _of_statement(node: ast.stmt) -> Iterator[str]:
    if isinstance(node, ast.Assign):
        for target in node.targets:
            yield from target_names(target)
    elif isinstance(node, ast.AnnAssign | ast.AugAssign):
        yield from target_names(node.target)
    elif isinstance(node, ast.For):
        yield from target_names(node.target)
        yield from assigned_names(node.body)
    elif isinstance(node, ast.If):
        yield from assigned_names([*node.body, *node.orelse])


def target_names(target: ast.expr) -> Iterator[str]:
    """Names on the left of an assignment."""
    if isinstance(target, ast.Name):
        yield target.id
    elif isinstance(target, ast.Tuple | ast.List):
        for part in target.elts:
            yield from target_names(part)
    elif isinstance(target, ast.Starred):
        yield from target_names(target.value)
