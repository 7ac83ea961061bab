"""What a closed form has beside its formulas: a polynomial, a curve of self-motion, angles that the file names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.closed_form_meanings import ClosedFormMeanings, CoincidenceMotion
from assur.derivation.definitions import FreeNames


@dataclass(frozen=True, eq=False)
class ClosedFormParts:
    """The parts of the closed form of a mechanism whose direct and inverse problems were solved.

    Attributes:
        formulas: of both problems.
        meanings: of its quantities; of a form that is worked out and not read by anyone there are none.
        constraint_singular: groups of factors where the closure loses rank.
        couples: name -> what vanishes where couples no longer keep the platform from turning.
    """

    formulas: ClosedFormFormulas
    meanings: ClosedFormMeanings | None = None
    constraint_singular: tuple[tuple[str, ...], ...] = ()
    couples: Mapping[str, sympy.Expr] = field(default_factory=dict)

    @property
    def motion(self) -> CoincidenceMotion | None:
        """The curve on which the platform moves while the inputs stand, if the form has one."""
        if self.meanings is None or self.formulas.products:  # on the curve fewer signs are left, and products have more
            return None
        return self.meanings.self_motion

    @property
    def factors(self) -> list[tuple[str, str, sympy.Expr]]:
        """Name, kind and value of the factors of both determinants, of couples, and of what says where the curve is."""
        couples = [(name, "other", value) for name, value in self.couples.items()]
        return [*self.formulas.factors, *couples, *(self.meanings.gaps if self.motion and self.meanings else ())]

    @property
    def motion_angle(self) -> str:
        """The angle that runs along the curve: the file's name for it, else the link's."""
        if self.motion is None:
            return ""
        if self.motion.centres:
            return "turn"
        base = self.motion.part.directions[0]
        names = [name for name, own in self.angles.items() if own == base.unknowns]
        return names[0] if names else base.name

    @property
    def motion_signs(self) -> tuple[str, ...]:
        """The signs that are left on the curve."""
        if self.motion is None:
            return ()
        roots = [root for root in self.formulas.direct.roots if root not in self.motion.part.roots]
        return tuple(self.formulas.signs["direct", root.symbol][0] for root in roots)

    @cached_property
    def angles(self) -> dict[str, tuple[sympy.Expr, sympy.Expr]]:
        """The angles that the file names, where a formula says them: cosine and sine."""
        record = self.formulas.inverse.symbols.record
        values = self.formulas.joints.values
        pairs = {
            name: values.get(own.joint, values.get(f"{own.joint}.{own.component}"))
            for name, own in record.angles.items()
        }
        return {name: pair for name, pair in pairs.items() if isinstance(pair, tuple)}

    @cached_property
    def eliminant(self) -> AngleEliminant | None:
        """The polynomial of the direct problem, if it has one."""
        return self.formulas.direct.eliminant

    @property
    def unknown(self) -> str:
        """What the polynomial is in, as a quantity: an askew coordinate, the platform's angle, or that of a link."""
        record, eliminant = self.formulas.direct.symbols.record, self.eliminant
        if eliminant is None:
            return ""
        if self.formulas.mirrored is not None:
            return str(self.formulas.mirrored.unknown)
        if self.formulas.three_quadrics is not None:
            return str(FreeNames({*record.platform.pose, *record.angles, *record.parameters}).named("t"))
        posed = "phi" in record.platform.pose and record.platform.link in eliminant.direction.links
        return "phi" if posed else eliminant.direction.name
