"""Groups of numbers moved between the buffer of a loop and memory, also past the caches (non-temporal stores).

An ordinary store first reads the line of memory that it changes. An answer that is larger than the caches is therefore
moved twice; stored past the caches, whole lines at a time, it is moved once. This module is imported by generated
loops only: it needs numba.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

GROUP = 16
"""Numbers that are moved at a time: two lines of the caches."""
WIDE = 4
"""Numbers of one instruction."""


def _mover(past: bool, truth: bool) -> Any:
    """An intrinsic `move(source, at, target, to)`: target[to:to + 16] = source[at:at + 16]; nothing is checked."""

    def typed(_: Any, source: Any, at: Any, target: Any, to: Any) -> Any:
        signature = types.void(source, at, target, to)

        def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            source, target = (context.make_array(signature.args[k])(context, builder, arguments[k]) for k in (0, 2))
            for k in range(0, GROUP, WIDE):
                at, to = (builder.add(arguments[j], ir.Constant(arguments[j].type, k)) for j in (1, 3))
                _move_wide(builder, builder.gep(source.data, [at]), builder.gep(target.data, [to]), past, truth)
            return context.get_dummy_value()

        return signature, code

    return intrinsic(typed)


def _move_wide(builder: Any, source: Any, target: Any, past: bool, truth: bool) -> None:
    numbers = ir.VectorType(ir.DoubleType(), WIDE)
    kind = ir.VectorType(ir.IntType(8), WIDE) if truth else numbers
    value = builder.load(builder.bitcast(source, numbers.as_pointer()))
    value.align = 8
    if truth:
        value = builder.zext(builder.fcmp_ordered(">", value, ir.Constant(numbers, [0.5] * WIDE)), kind)
    stored = builder.store(value, builder.bitcast(target, kind.as_pointer()))
    stored.align = 1 if truth else 8 * WIDE if past else 8
    if past:
        stored.set_metadata("nontemporal", builder.module.add_metadata([ir.Constant(ir.IntType(32), 1)]))


moved = _mover(past=False, truth=False)
"""target[to:to + 16] = source[at:at + 16], in a compiled function."""
streamed = _mover(past=True, truth=False)
"""The same past the caches, to a place that is a multiple of 64 bytes."""
judged = _mover(past=False, truth=True)
"""The same with 1.0 and 0.0 as true and false."""
