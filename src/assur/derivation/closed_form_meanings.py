"""What the margins and the factors of a derived closed form mean, and the self-motion where circles coincide."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.definitions import Definition
from assur.derivation.elimination import SolvedSet
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.joint_formulas import Tilt
from assur.derivation.phrases import GeometricPhrase, NamedDirection, phrase
from assur.derivation.reach_meanings import ReachMeanings
from assur.kinematics.modes import Problem
from assur.numerics.vectors import scaled


@dataclass(frozen=True)
class CoincidenceMotion:
    """A self-motion: two circles of a set coincide where a condition fails, and their angle is free.

    Attributes:
        condition: what vanishes.
        part: the set.
        definitions: what follows of the inputs and the angle, without the set's root.
        gaps: of circles without a line in common, what vanishes where their centres coincide; else none.
    """

    condition: sympy.Expr
    part: SolvedSet
    definitions: tuple[Definition, ...]
    gaps: tuple[sympy.Symbol, ...] = ()


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
            if value in part.conditions:
                return own.condition(part, value)
        if (rod := self.formulas.joints.leaning.get(value)) is not None:
            lines = self.reach["inverse"].lines
            direction = next(own for own in lines.loops.directions if own.name == rod.name)
            return phrase("{} points too far along {}", lines.name(direction), NamedDirection(rod.axis))
        return self._upright(next(tilt for tilt in self.formulas.joints.tilts if name.endswith(tilt.name[5:])))

    def _upright(self, tilt: Tilt) -> GeometricPhrase:
        lines = self.reach["inverse"].lines
        direction = next(own for own in lines.loops.directions if own.unknowns == tilt.direction)
        return phrase("{} points along {}", lines.name(direction), NamedDirection(scaled(tilt.line, -1)))

    def factor(self, kind: str, value: sympy.Expr) -> GeometricPhrase:
        """What it means that a factor vanishes."""
        if kind == "other" and self.self_motion is not None:
            return self.reach["direct"].condition(self.self_motion.part, self.self_motion.condition)
        return self._factors.of(value, kind)

    @cached_property
    def self_motion(self) -> CoincidenceMotion | None:
        """The curve of poses where the two circles of a set coincide, if a set has such a condition."""
        solution = self.formulas.direct
        for part in solution.sets:
            if part.directions[0].kind != "circle" or solution.eliminant is not None or len(part.roots) != 1:
                continue
            if len(part.shared) == len(part.lines) == 1:
                return CoincidenceMotion(part.shared[0], part, self._along(part))
            if not part.shared and (gaps := self._gaps(part)):
                (condition,) = {*part.conditions} & {own.symbol for own in part.definitions}
                return CoincidenceMotion(condition, part, self._along(part), gaps)
        return None

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

    def _along(self, part: SolvedSet) -> tuple[Definition, ...]:
        """Definitions without those that only the set's own root is worked out by."""
        given = {*part.directions[0].unknowns}
        left = [own for own in self.formulas.direct.definitions if own.symbol not in given]
        wanted = {symbol for _, value in self.formulas.rest("direct") for symbol in value.free_symbols}
        wanted |= {*self.formulas.unknowns}
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
        values = () if motion is None else [self.formulas.of_direct(gap) for gap in motion.gaps]
        return [(f"h{number}", "other", value) for number, value in enumerate(values, start=1)]

    @cached_property
    def self_motion_factors(self) -> tuple[str, ...]:
        """The factor of det Jp that vanishes with the condition, or the gaps that do."""
        motion = self.self_motion
        if motion is None:
            return ()
        if self.gaps:
            return tuple(name for name, _, _ in self.gaps)
        value = self.formulas.in_unknowns(self.formulas.direct, motion.condition).subs(self.formulas.inputs_in_unknowns)
        return next(
            ((name,) for name, kind, factor in self.formulas.factors
             if kind == "parallel" and self._factors.proportional(value, factor)), (),
        )  # fmt: skip
