"""A file of kernels, read: its names and what they stand for. Nothing of it is executed by Python."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from assur.model.kernels import values as data
from assur.model.kernels.expressions import FORM
from assur.model.kernels.faults import BYTES, NODES, FormFault, KernelFault, Meter
from assur.model.kernels.functions import UNSET, CallFrame, problem_of
from assur.model.kernels.library import imported
from assur.model.kernels.scope import KernelScope, assigned_names, checked_name, known
from assur.model.kernels.statements import function, statement


@lru_cache(maxsize=64)
def names_of(text: str, file: Path) -> Mapping[str, data.Value]:
    r"""The names that a file of kernels defines; its functions can be called like any others.

    A text is read once in a process, and what its functions have learned by being called serves every reader.

    Args:
        text: what stands in the file.
        file: its path, for messages.

    Errors:
        FormFault: Python, but not the form that is read here (docs/closed-form.md); with its line.
        MechanismFileError: no Python, or a value that cannot be worked out.

    Example:
        >>> names = names_of("def twice(ns, x):\n    return 2 * ns.sqrt(x**2)\n", Path("closed_form.py"))
        >>> from assur.numerics.number_types import Floats
        >>> float(names["twice"](Floats(), 3.0))
        6.0
    """
    tree = _tree(text, file)
    shared: dict[str, data.Value] = {}
    scope, meter = KernelScope(shared), Meter()
    for node in tree.body:
        meter.line = node.lineno
        try:
            for name, value in _defined(node, scope, file, meter):
                data.parts_of(value)
                shared[name] = data.frozen(value)
        except FormFault as fault:
            fault.line = fault.line or node.lineno
            raise
        except KernelFault as fault:
            raise problem_of(file, fault, meter.line) from fault
        except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError, RecursionError) as error:
            wrong = KernelFault(f"{type(error).__name__}: {error}"[:300], "see docs/closed-form.md")
            raise problem_of(file, wrong, meter.line) from error
    try:
        known(scope)
    except FormFault:
        raise
    except KernelFault as fault:
        raise problem_of(file, fault) from fault
    return MappingProxyType(shared)


def _tree(text: str, file: Path) -> ast.Module:
    if len(text.encode()) > BYTES:
        raise FormFault(f"{len(text.encode())} bytes", f"a closed form of at most {BYTES}", line=1)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SyntaxWarning)  # of texts that are refused anyway, or harmless
            tree = ast.parse(text, str(file))
    except SyntaxError as error:
        fault = KernelFault(f"SyntaxError: {error.msg}", "Python")
        raise problem_of(file, fault, error.lineno) from error
    except (ValueError, RecursionError, MemoryError) as error:
        fault = KernelFault("a text that Python cannot read", "Python, not nested too deep")
        raise problem_of(file, fault, None) from error
    if sum(1 for _ in ast.walk(tree)) > NODES:
        raise FormFault("a text of very many parts", f"a syntax tree of at most {NODES} nodes", line=1)
    return tree


def _defined(node: ast.stmt, scope: KernelScope, file: Path, meter: Meter) -> Iterator[tuple[str, data.Value]]:
    """What a statement of the file defines: names and values."""
    if isinstance(node, ast.ImportFrom):
        yield from _imports(node)
    elif isinstance(node, ast.Import):
        raise FormFault(f"import {node.names[0].name[:60]}", "from ... import ...", line=node.lineno)
    elif isinstance(node, ast.FunctionDef):
        yield node.name, function(node, KernelScope(scope.shared), scope.asked, file, meter)
    elif isinstance(node, ast.Return):
        raise FormFault("return outside a function", FORM, line=node.lineno)
    else:
        own = KernelScope(scope.shared)
        for name in assigned_names([node]):
            own.named(checked_name(name, node.lineno))
        run = statement(node, own, 0)
        known(own)
        frame = CallFrame(own.size, meter)
        for name, place in own.places.items():  # what the statement may read before it gives it a new value
            if name in scope.shared:
                frame.values[place] = scope.shared[name]
        meter.spend(sum(1 for _ in ast.walk(node)))
        run(frame)
        for name, place in own.places.items():
            if frame.values[place] is not UNSET:
                yield name, frame.values[place]


def _imports(node: ast.ImportFrom) -> Iterator[tuple[str, data.Value]]:
    module = "." * node.level + (node.module or "")
    if module == "__future__":
        return
    for item in node.names:
        try:
            value = imported(module, item.name)
        except FormFault as fault:
            fault.line = node.lineno
            raise
        yield checked_name(item.asname or item.name, node.lineno), value
