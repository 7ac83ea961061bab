"""Knees: where the sense of a bend names a branch of a limb, and the formula whose sign it is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeGuard

from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.synthesis.drafting.tables import Knee
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector, parallel

DUST = 1e-12


def knee(chain: Chain, letters: Sequence[str]) -> Knee | None:
    """The knee of a limb, if something simple tells the two branches for one place of its end apart; else None.

    That is the sense in which it bends about its first axis, which stays where it is, where its first joints (P aside)
    are two parallel R and an R, C or S, or an R and a P(4S) or P(2US). After P and such a parallelogram alone it is
    whether the rods lead along the P or against it.

    >>> from assur.topology.notation import parse_chain
    >>> knee(parse_chain("P[x] R[y] R[y] S"), list("ABCD"))
    Knee(points=('B', 'C', 'D'), axis=(0.0, 1.0, 0.0))
    """
    elements = chain.elements
    if any(isinstance(element, InnerLoop) for element in elements):
        return None
    rest = list(zip(elements, letters, strict=True))
    if len(rest) == 2 and _is_sliding(elements[0]) and isinstance(elements[1], Parallelogram):
        rods = f"{letters[1]}a", f"{letters[1]}b"
        return Knee(rods, elements[0].axes[0]) if elements[1].kind in ("4S", "2US") else None
    while rest and _is_sliding(rest[0][0]):
        rest.pop(0)
    if len(rest) < 2 or not _turns(rest[0][0]):
        return None
    first, second = rest[0][0], rest[1][0]
    axis = first.axes[0] if isinstance(first, ChainJoint) else (0.0, 0.0, 0.0)
    if isinstance(second, Parallelogram):
        if second.kind in ("4S", "2US") and parallel(second.axis, axis):
            return Knee((rest[0][1], f"{rest[1][1]}a", f"{rest[1][1]}b"), axis)
        return None
    if len(rest) < 3 or not _turns(second) or not isinstance(second, ChainJoint) or not parallel(second.axes[0], axis):
        return None
    third = rest[2][0]
    if not isinstance(third, ChainJoint) or third.type not in (REVOLUTE, CYLINDRICAL, SPHERICAL):
        return None
    labels = [joint.point for joint in (first, second, third) if isinstance(joint, ChainJoint) and joint.point]
    return None if len(set(labels)) < len(labels) else Knee((rest[0][1], rest[1][1], rest[2][1]), axis)


def knee_formula(bent: Knee, limb: str, angle: float, turn: str = "") -> str:
    """The formula whose sign is the sense of a knee, for a limb at an angle (deg), or at the parameter `turn`.

    Of three points it is (q - p) x (s - q) along the axis, of two q - p along it.

    >>> knee_formula(Knee(("A", "B", "C"), (0.0, 0.0, 1.0)), "leg1", 0.0)
    '(leg1.B.x - leg1.A.x)*(leg1.C.y - leg1.B.y) - (leg1.B.y - leg1.A.y)*(leg1.C.x - leg1.B.x)'
    >>> knee_formula(Knee(("Ba", "Bb"), (0.0, 0.6, -0.8)), "leg1", 0.0)
    '0.6*(leg1.Bb.y - leg1.Ba.y) - 0.8*(leg1.Bb.z - leg1.Ba.z)'
    >>> knee_formula(Knee(("Ba", "Bb"), (0.0, 1.0, 0.0)), "leg2", 26.6, "gamma2")
    '-sin(gamma2)*(leg2.Bb.x - leg2.Ba.x) + cos(gamma2)*(leg2.Bb.y - leg2.Ba.y)'
    """
    points = [f"{limb}.{name}" for name in bent.points]
    parts = [
        _cross(points, across, aside) if len(points) > 2 else f"{points[1]}.{along} - {points[0]}.{along}"
        for along, across, aside in zip("xyz", "yzx", "zxy", strict=True)
    ]
    terms = [
        (size, factor, part)
        for shares, part in zip(_turned(bent.axis, angle, turn), parts, strict=True)
        for size, factor in shares
        if abs(size) > DUST
    ]
    if len(terms) == 1 and abs(terms[0][0] - 1.0) < DUST and not terms[0][1]:
        return terms[0][2]
    formula = ""
    for size, factor, part in terms:
        number = "" if abs(abs(size) - 1.0) < DUST else f"{round(abs(size), 12):.12g}*"
        sign = (" - " if size < 0 else " + ") if formula else ("-" if size < 0 else "")
        formula += f"{sign}{number}{factor}({part})"
    return formula


def _cross(points: Sequence[str], across: str, aside: str) -> str:
    p, q, s = points
    return f"({q}.{across} - {p}.{across})*({s}.{aside} - {q}.{aside})" + (
        f" - ({q}.{aside} - {p}.{aside})*({s}.{across} - {q}.{across})"
    )


def _is_sliding(element: Element) -> TypeGuard[ChainJoint]:
    return isinstance(element, ChainJoint) and element.type is PRISMATIC and not element.general


def turned_round(bent: Knee) -> Knee:
    """The same knee, its sense counted the other way.

    >>> turned_round(Knee(("A", "B", "C"), (0.0, 0.0, 1.0))).axis
    (0.0, 0.0, -1.0)
    """
    x, y, z = bent.axis
    return Knee(bent.points, (0.0 - x, 0.0 - y, 0.0 - z))


def _turns(element: object) -> bool:
    return isinstance(element, ChainJoint) and element.type is REVOLUTE and not element.general


def _turned(axis: Vector, angle: float, turn: str) -> tuple[Sequence[tuple[float, str]], ...]:
    """Components along x, y and z of an axis turned about z, each a sum of numbers with factors."""
    x, y, z = axis
    if turn:
        cosine, sine = f"cos({turn})*", f"sin({turn})*"
        return ((x, cosine), (-y, sine)), ((x, sine), (y, cosine)), ((z, ""),)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return ((c * x - s * y, ""),), ((s * x + c * y, ""),), ((z, ""),)
