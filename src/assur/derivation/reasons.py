"""Reasons in words: why a link does not turn."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from assur.derivation.orientations import ConstraintReason, LinkOrientations
from assur.numerics.vectors import Vector

AXES = {(1, 0, 0): "x", (0, 1, 0): "y", (0, 0, 1): "z"}


def sentences(placed: LinkOrientations) -> Iterator[str]:
    """One sentence for each link that does not turn against another, in the order in which they follow.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> print(*sentences(analytic_solution(load_record("zeng2019"), "direct").placed))
    link11 hangs on base by axes along x (B1, C1) and by axes along y (D2, D1), so it does not turn against it
    """
    for reason in placed.reasons:
        first, second = (_chain(reason, *way) for way in ((reason.first, True), (reason.second, False)))
        yield f"{reason.link} hangs on {reason.carrier} by {first} and by {second}, so it does not turn against it"


def _chain(reason: ConstraintReason, axis: Vector, first: bool) -> str:
    joints = reason.first_joints if first else reason.second_joints
    return f"axes along {direction(axis)} ({', '.join(joints)})"


def direction(axis: Vector) -> str:
    """A direction in words: a letter, or its parts."""
    x, y, z = (sympy.sympify(part) for part in axis)
    return AXES.get((x, y, z), f"({x}, {y}, {z})")
