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
    """

    condition: sympy.Expr
    part: SolvedSet
    definitions: tuple[Definition, ...]


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
        return self._factors.of(value, kind)

    @cached_property
    def self_motion(self) -> CoincidenceMotion | None:
        """The curve of poses where the two circles of a set coincide, if a set has such a condition."""
        solution = self.formulas.direct
        for part in solution.sets:
            base = part.directions[0]
            if part.shared and base.kind == "circle" and len(part.lines) == 1 and part.eliminant is None:
                (condition, *others) = part.shared
                if not others and solution.eliminant is None and len(part.roots) == 1:
                    return CoincidenceMotion(condition, part, self._along(part))
        return None

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
    def self_motion_factors(self) -> tuple[str, ...]:
        """The factor of det Jp that vanishes with the condition."""
        motion = self.self_motion
        if motion is None:
            return ()
        value = self.formulas.in_unknowns(self.formulas.direct, motion.condition).subs(self.formulas.inputs_in_unknowns)
        return next(
            ((name,) for name, kind, factor in self.formulas.factors
             if kind == "parallel" and self._factors.proportional(value, factor)), (),
        )  # fmt: skip
