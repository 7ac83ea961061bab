"""Couples by which parallelograms of ball-jointed rods keep the platform from turning, and where these lose their rank.

Two parallel rods u with the short sides t bear forces along u, and so a couple along t x u. A limb in which nothing
else turns, but about t, keeps the platform from turning about that direction alone. Three such limbs hold it unless
the three couples are parallel to one plane; then it may turn at first order, whatever the inputs do.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import sympy

from assur.derivation.hinges import point_on, rods_of
from assur.derivation.link_lines import LinkLines
from assur.derivation.solution import AnalyticSolution
from assur.model.mechanism import GeneralisedJoint, Joint
from assur.numerics.vectors import Vector, apply, cross, subtract, triple

COPLANAR = "the couples that the parallelograms bear are parallel to one plane"
"""What it means that all of the formulas vanish."""


def coplanar_couples(solution: AnalyticSolution) -> dict[str, sympy.Expr]:
    """Name -> formula: all vanish where couples no longer keep the platform from turning. None where others hold it.

    Args:
        solution: of the inverse problem, in whose unknowns the formulas are.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> [*coplanar_couples(analytic_solution(load_record("linear_delta_4s"), "inverse"))]
    ['couples']
    >>> coplanar_couples(analytic_solution(load_record("fivebar"), "inverse"))
    {}
    """
    couples = [*_couples(solution)]
    if len(couples) != len(solution.symbols.record.chains):
        return {}
    volumes = [sympy.factor_terms(sympy.expand(triple(*three))) for three in combinations(couples, 3)]
    names = ["couples"] if len(volumes) == 1 else [f"couples{k}" for k in range(1, len(volumes) + 1)]
    return {name: own for name, own in zip(names, volumes, strict=True) if own != 0}


def _couples(solution: AnalyticSolution) -> Iterator[Vector]:
    """Of each limb that has one parallelogram of rods, about whose short sides alone it turns besides."""
    record = solution.symbols.record
    lines = LinkLines(solution.symbols, solution.placed, solution.loops)
    for limb in record.chains.values():
        groups = [record.generalised[name] for name in limb.serial if name in record.generalised]
        if limb.loop or len(groups) != 1 or groups[0].kind not in ("P(4S)", "P(2US)"):
            continue
        side = _short_side(lines, groups[0])
        turning = [record.joints[name] for name in limb.serial if name in record.joints]
        if side is None or not all(_about(lines, joint, side) for joint in turning if joint.type.turning):
            continue
        rod = next(own for own in solution.loops.directions if {*rods_of(record, groups[0])} & {*own.links})
        if (line := lines.of(rod)) is not None:
            yield cross(side, line.vector)


def _short_side(lines: LinkLines, group: GeneralisedJoint) -> Vector | None:
    """From one rod to the other, in the base's frame; None where what they hang on turns it."""
    joints, parent = lines.symbols.record.joints, lines.placed.links[group.parent]
    near = [joints[name] for name in group.joints if group.parent in (joints[name].parent, joints[name].child)]
    first, second = (point_on(lines.symbols, joint, group.parent) for joint in near)
    side = lines.exact.unit(apply(parent.constant, subtract(second, first)))
    if parent.rod is not None or parent.hinge is not None:
        return None
    return side if parent.axis is None or lines.exact.along(parent.axis, side) else None


def _about(lines: LinkLines, joint: Joint, side: Vector) -> bool:
    """Whether a joint turns about one direction alone, that of the short sides."""
    parent, axes = lines.placed.links[joint.parent], lines.symbols.geometry.joints[joint.name].axes
    return joint.type.turns == 1 and all(lines.exact.along(apply(parent.constant, axis), side) for axis in axes)
