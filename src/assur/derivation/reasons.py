"""Reasons in words: why a link does not turn, and in which other way some of them could stand."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import sympy

from assur.derivation.constraint_reasons import ConstraintReason
from assur.derivation.orientations import LinkOrientations
from assur.derivation.phrases import direction
from assur.derivation.unknown_directions import UnknownDirection
from assur.numerics.vectors import Vector, dot


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


def left_out(placed: LinkOrientations, cranks: Collection[UnknownDirection] = ()) -> Iterator[str]:
    """What no formula says: a sentence for each link that is taken to stand as at home, though its axes close another
    way too, and for each rod oblique to its hinge, which is real for a part of all directions alone, in two ways.

    Args:
        placed: the orientations.
        cranks: circles of links that carry such rods and are solved for, so that both ways are among the branches.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> print(*left_out(analytic_solution(load_record("h4_robot"), "direct").placed))
    bar2 is taken to stand against bar1 as at home; it may also stand turned by half a turn about z
    """
    for reason in placed.reasons:
        if reason.other_way is not None:
            own = f"{reason.link} is taken to stand against {reason.carrier} as at home"
            yield f"{own}; it may also stand turned {_turned(*reason.other_way)} about {direction(reason.first)}"
    yield from _oblique(placed, {placed.links[own.links[0]].circle for own in cranks})


def _oblique(placed: LinkOrientations, solved: Collection[int | None]) -> Iterator[str]:
    """Rods oblique to their hinges: where they are real."""
    said = set[int]()
    for link, own in placed.links.items():
        if own.rod is None or own.rod in said or own.hinge is None or own.axis is None or own.line is None:
            continue
        if own.circle in solved:
            continue
        said.add(own.rod)
        lean = sympy.simplify(dot(own.line, own.hinge))
        if lean != 0:
            level = sympy.sqrt(sympy.factor_terms(sympy.simplify(1 - lean**2)))
            axis = direction(own.axis)
            real = f"{link} is oblique to its hinge, and real only where its direction has at most {level} along {axis}"
            yield f"{real}; it is taken to be on home's side of its hinge, and may point so on the other side too"


def _turned(cosine: sympy.Expr, sine: sympy.Expr) -> str:
    """By which angle."""
    if cosine == -1:
        return "by half a turn"
    if cosine.is_number:
        return f"by {float(sympy.deg(sympy.atan2(sine, cosine))):.4g} deg"
    return f"by the angle whose cosine is {cosine}"


def _chain(reason: ConstraintReason, axis: Vector, first: bool) -> str:
    joints = reason.first_joints if first else reason.second_joints
    third = "" if first or reason.third is None else f"{direction(reason.third)} and "
    return f"axes along {third}{direction(axis)} ({', '.join(joints)})"
