"""Reasons in words: why a link does not turn."""

from __future__ import annotations

from collections.abc import Iterator

from assur.derivation.orientations import ConstraintReason, LinkOrientations
from assur.derivation.phrases import direction
from assur.numerics.vectors import Vector


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
    third = "" if first or reason.third is None else f"{direction(reason.third)} and "
    return f"axes along {third}{direction(axis)} ({', '.join(joints)})"
