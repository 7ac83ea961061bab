"""What the margins and the factors of a derived closed form mean, and the self-motion where circles coincide."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.definitions import Definition
from assur.derivation.direct_pose import TILT, UPRIGHT
from assur.derivation.elimination import SolvedSet
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.joint_formulas import Tilt
from assur.derivation.linear import tidy
from assur.derivation.parasitic_rate import RIGHT_ANGLE
from assur.derivation.phrases import GeometricPhrase, NamedDirection, phrase
from assur.derivation.reach_meanings import ReachMeanings
from assur.kinematics.modes import Problem
from assur.numerics.vectors import Vector, scaled, subtract


@dataclass(frozen=True)
class CoincidenceMotion:
    """A self-motion: two circles or spheres of a set coincide where a condition fails, and an angle is free.

    Attributes:
        condition: what vanishes.
        part: the set.
        definitions: what follows of the inputs and the angle, without the set's root.
        gaps: of circles without a line in common, what vanishes where their centres coincide; else none.
        centres: of three spheres those of the second and third, in radii from the first; else none.
    """

    condition: sympy.Expr
    part: SolvedSet
    definitions: tuple[Definition, ...]
    gaps: tuple[sympy.Symbol, ...] = ()
    centres: tuple[Vector, ...] = ()


@dataclass(frozen=True, eq=False)
class ClosedFormMeanings:
    """The meanings of a closed form's quantities."""

    formulas: ClosedFormFormulas

    @cached_property
    def reach(self) -> dict[Problem, ReachMeanings]:
        """Of the radicands and conditions of both problems."""
        return {"direct": ReachMeanings(self.formulas.direct), "inverse": ReachMeanings(self.formulas.inverse)}

    @cached_property
    def _factors(self) -> FactorMeanings:
        return FactorMeanings(self.formulas.inverse)

    def margin(self, problem: Problem, name: str, value: sympy.Expr) -> GeometricPhrase:
        """What it means that a margin fails."""
        own = self.reach[problem]
        if value in own.radicands:
            return own.radicands[value]
        for part in self.formulas.solution(problem).sets:
            three = self.formulas.three_quadrics if part.eliminant is not None else None
            if value in part.conditions or (three is not None and value in three.conditions):
                return own.condition(part, value)
        if (rod := self.formulas.joints.leaning.get(value)) is not None:
            own = self.reach["inverse"]
            direction = next(each for each in own.lines.loops.directions if each.name == rod.name)
            return own.leaning(direction, rod.axis, too_far=value == rod.room)
        if value in (TILT, UPRIGHT):
            return phrase(RIGHT_ANGLE)
        return self._upright(next(tilt for tilt in self.formulas.joints.tilts if name.endswith(tilt.name[5:])))

    def _upright(self, tilt: Tilt) -> GeometricPhrase:
        lines = self.reach["inverse"].lines
        direction = next(own for own in lines.loops.directions if own.unknowns == tilt.direction)
        return phrase("{} points along {}", lines.name(direction), NamedDirection(scaled(tilt.line, -1)))

    def factor(self, kind: str, value: sympy.Expr) -> GeometricPhrase:
        """What it means that a factor vanishes."""
        if kind == "other" and self.self_motion is not None:
            if self.self_motion.centres:
                return phrase("a component of the distance of two spheres' centres")
            return self.reach["direct"].condition(self.self_motion.part, self.self_motion.condition)
        return self._factors.of(value, kind, shared=self.formulas.is_shared(value))

    @cached_property
    def self_motion(self) -> CoincidenceMotion | None:
        """The curve of poses where two circles or spheres of a set coincide, if a set has such a condition."""
        solution = self.formulas.direct
        for part in solution.sets:
            if solution.eliminant is not None or len(part.roots) != 1:
                continue
            if centres := self._centres(part):
                (condition,) = {*part.conditions} & {own.symbol for own in part.definitions}
                motion = CoincidenceMotion(condition, part, self._along(part, centres), centres=centres)
                if self._gap_groups(motion):
                    return motion
            if part.directions[0].kind != "circle":
                continue
            if len(part.shared) == len(part.lines) == 1:
                return CoincidenceMotion(part.shared[0], part, self._along(part))
            if not part.shared and (gaps := self._gaps(part)):
                (condition,) = {*part.conditions} & {own.symbol for own in part.definitions}
                return CoincidenceMotion(condition, part, self._along(part), gaps)
        return None

    def _centres(self, part: SolvedSet) -> tuple[Vector, ...]:
        """Of three unit vectors that differ by known ones the centres of the spheres about which the first one runs."""
        first, *others = part.directions
        if len(first.unknowns) != 3 or len(others) != len(part.lines) or len(others) != 2 or part.shared:
            return ()
        formulas = {own.symbol: own.formula for own in part.definitions}
        apart = [
            [
                sympy.expand(own - formulas.get(other, other))
                for own, other in zip(first.unknowns, rod.unknowns, strict=True)
            ]
            for rod in others
        ]
        unknown = {*first.unknowns, *others[0].unknowns, *others[1].unknowns}
        known = all(not part.free_symbols & unknown for vector in apart for part in vector)
        return tuple(tuple(vector) for vector in apart) if known else ()

    def _gaps(self, part: SolvedSet) -> tuple[sympy.Symbol, ...]:
        """J and K of a circle's line J c + K s = L but for dimensions, where L vanishes with both: the line is none.

        Then N = J^2 + K^2, by which the root is divided, vanishes where two circles of one radius have one centre.
        """
        formulas = {own.symbol: own.formula for own in part.definitions}
        dimensions = {*self.formulas.direct.symbols.parameters.values()}
        (root,) = part.roots
        known = [own for own in part.conditions if own in formulas]
        if len(known) != 1 or root.radicand not in formulas:
            return ()
        sides = sorted(formulas[known[0]].free_symbols, key=str)
        rest = formulas[root.radicand].free_symbols - {*known}
        if len(sides) != 2 or len(rest) != 1 or not {*sides, *rest} <= formulas.keys():
            return ()
        gaps = [formulas[side].free_symbols - dimensions for side in sides]
        at_centre = formulas[rest.pop()].subs({symbol: 0 for gap in gaps for symbol in gap})
        if any(len(gap) != 1 for gap in gaps) or sympy.expand(at_centre) != 0:
            return ()
        return tuple(gap.pop() for gap in gaps)

    def _along(self, part: SolvedSet, centres: tuple[Vector, ...] = ()) -> tuple[Definition, ...]:
        """Definitions without those that only the set's own root is worked out by."""
        given = {*part.directions[0].unknowns}
        left = [own for own in self.formulas.direct.definitions if own.symbol not in given]
        wanted = {symbol for _, value in self.formulas.rest("direct") for symbol in value.free_symbols}
        wanted |= {*self.formulas.unknowns}
        wanted |= {symbol for centre in centres for entry in centre for symbol in entry.free_symbols}
        wanted |= {root.radicand for root in self.formulas.direct.roots if root not in part.roots}
        kept: list[Definition] = []
        for own in reversed(left):
            if own.symbol in wanted:
                kept.insert(0, own)
                wanted |= own.formula.free_symbols
        return tuple(kept)

    @cached_property
    def gaps(self) -> list[tuple[str, str, sympy.Expr]]:
        """Name, kind and value of each gap between centres that coincide on the curve, as factors of no determinant."""
        motion = self.self_motion
        if motion is None:
            return []
        return [(name, "other", value) for group in self._gap_groups(motion) for name, value in group.items()]

    def _gap_groups(self, motion: CoincidenceMotion) -> list[dict[str, sympy.Expr]]:
        """Gaps between two centres each, by name, in the unknowns of the inverse problem."""
        dimensions = {*self.formulas.inverse.symbols.parameters.values()}
        pairs: list[tuple[sympy.Expr, ...]] = [motion.gaps] if motion.gaps else []
        if motion.centres:
            second, third = motion.centres
            pairs = [second, third, subtract(third, second)]
        groups: list[dict[str, sympy.Expr]] = []
        for pair in pairs:
            values = [sympy.factor_terms(tidy(self.formulas.of_direct(gap))) for gap in pair]
            varying = [own for own in values if own.free_symbols - dimensions]
            start = sum(map(len, groups)) + 1
            if all(own == 0 for own in values if own not in varying):  # else these centres never are one
                groups.append({f"h{start + k}": value for k, value in enumerate(varying)})
        return groups

    @cached_property
    def self_motion_groups(self) -> tuple[tuple[str, ...], ...]:
        """Groups of factors all of which vanish on a curve: of gaps between two centres, else the one of det Jp."""
        motion = self.self_motion
        if motion is None:
            return ()
        if groups := self._gap_groups(motion):
            return tuple(map(tuple, groups))
        value = self.formulas.of_direct(motion.condition)
        return tuple(
            (name,) for name, kind, factor in self.formulas.factors
            if kind == "parallel" and self._factors.proportional(value, factor)
        )[:1]  # fmt: skip
