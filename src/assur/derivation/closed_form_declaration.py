"""What a closed form declares at its end: its kernels, signs, margins and factors, with their scales and meanings."""

from __future__ import annotations

from collections.abc import Iterator

from assur.derivation.closed_form_formulas import APART, ASIDE
from assur.derivation.closed_form_meanings import CoincidenceMotion
from assur.derivation.closed_form_parts import ClosedFormParts
from assur.derivation.constraint_couples import COPLANAR
from assur.derivation.kernel_text import sign_attribute
from assur.kinematics.modes import Problem, written_quantities
from assur.kinematics.naming import sign_meanings
from assur.model.kernels.declarations import LONGEST_TEXT


class ClosedFormDeclaration(ClosedFormParts):
    """Writes the declaration."""

    def text(self) -> str:
        """The lines of `CLOSED_FORM`."""
        reduced = [*self._assumptions()]
        lines = ["CLOSED_FORM = ClosedForm("]
        lines.append(f'    complete_for="{"reduced" if reduced else "joint_graph"}",')
        if reduced:
            lines.append(f'    reduced_because="{"; ".join(reduced)}",')
        if relations := self.formulas.relations:
            lines.append(f"    relations={relations!r},  # with other numbers no loop closes")
        eliminant = self.eliminant
        if eliminant is None:
            lines.append("    direct=direct,")
        else:
            signs = tuple(self.formulas.signs["direct", own.symbol][0] for own in self.formulas.direct.roots)
            mirrored = self.formulas.mirrored
            signs = signs if mirrored is None else mirrored.signs
            extra = f", {signs!r}" if signs else ""
            degree = self.formulas.direct.branches
            kind = "angle" if self.formulas.three_quadrics is None and mirrored is None else "plain"
            extra += ", left_over=left_over" if kind == "angle" else ""
            lines.append(f'    direct=Eliminant("{self.unknown}", "{kind}", {degree}, coefficients, back{extra}),')
        lines += [f"    {name}={name}," for name in ("inverse", "joints", "factors", "jacobians")]
        quantities = [*self._quantity_list()]
        if quantities:
            lines.append("    quantities=quantities,")
            lines += ["    quantity_list=(", *(f"        {text}," for text in quantities), "    ),"]
        lines.append("    signs={")
        scales = {name: self.formulas.scale(value) for name, value in self.formulas.sign_values.items()}
        lines += [f'        "{name}": Sign("{sign_attribute(name)}", "{scale}"),' for name, scale in scales.items()]
        lines.append("    },")
        lines += [f"    {kind}={names!r}," for kind, names in self._names_of_graph().items()]
        for problem in ("direct", "inverse"):
            lines.append(f"    {problem}_margins=(")
            lines += [f"        {text}," for text in self._margin_list(problem)]
            lines.append("    ),")
        lines.append("    factor_list=(")
        for name, kind, value in self.factors:
            unit, scale = self.formulas.unit(value), self.formulas.scale(value)
            scale = "1" if scale == "0" else scale  # of a dimension that is zero in this file
            meaning = f"{name} vanishes"
            if name in self.couples:
                meaning = COPLANAR
            elif self.meanings is not None:
                meaning = self.meanings.factor(kind, value).text
            meaning = meaning if len(meaning) <= LONGEST_TEXT else f"{name} vanishes"
            lines.append(f'        Factor("{name}", "{kind}", "{scale}", "{meaning}", unit={unit}),')
        lines.append("    ),")
        if self.constraint_singular:
            lines.append(f"    constraint_singular={self.constraint_singular!r},")
        if self.motion is not None:
            lines += self._motion_declaration(self.motion)
        lines.append(")")
        return "\n".join(lines)

    def _assumptions(self) -> Iterator[str]:
        """What is left out, in words."""
        if self.formulas.inverse.symbols.record.generalised or self.formulas.joints.pointings:
            yield "parallelograms stay such, and what they keep from turning is not turned over"
        reasons = (own for part in (self.formulas.direct, self.formulas.inverse) for own in part.placed.reasons)
        if self.formulas.one_sided:
            yield "a leg of negative length is left out: the same pose with that leg turned half round"
        if any(own.other_way is not None for own in reasons):
            yield "links that axes along three directions keep from turning stand as at home"

    def _motion_declaration(self, motion: CoincidenceMotion) -> Iterator[str]:
        if self.meanings is not None and self.meanings.self_motion_groups:
            yield f"    self_motion_singular={self.meanings.self_motion_groups!r},"
        margin = next(name for name, value in self.formulas.margins("direct") if value == motion.condition)
        yield f'    self_motion=SelfMotion("{margin}", "{self.motion_angle}", {self.motion_signs!r}, self_motion),'

    def _names_of_graph(self) -> dict[str, tuple[str, ...]]:
        """Names of modes that are the joint graph's, where the file has none for a problem, in its order."""
        record = self.formulas.inverse.symbols.record
        kinds: dict[Problem, str] = {"inverse": "working", "direct": "assembly"}
        names: dict[str, tuple[str, ...]] = {}
        for problem, kind in kinds.items():
            if not written_quantities(record, problem):
                meanings = sign_meanings(record, problem)
                names[kind] = tuple(name for name in meanings if name in self.formulas.sign_values)
        return {kind: own for kind, own in names.items() if own}

    def _margin_list(self, problem: Problem) -> Iterator[str]:
        solution = self.formulas.solution(problem)
        roots = {root.radicand: root for root in solution.roots}
        for name, value in self.formulas.margins(problem):
            if value == APART:
                yield f'Margin("{name}", "1", "two poses share the unknown {self.unknown}", unit=2, zero="degenerate")'
                continue
            if value == ASIDE:
                meaning = f"{self.unknown} is no more than 1: two solutions that are mirror images meet"
                signs = self.formulas.mirrored.signs[-1:] if self.formulas.mirrored else ()
                yield f'Margin("{name}", "1", "{meaning}", unit=0, signs={signs!r})'
                continue
            whole = self.formulas.in_unknowns(solution, value)
            unit, scale = self.formulas.unit(whole), self.formulas.margin_scale(problem, value)
            meaning = name if self.meanings is None else self.meanings.margin(problem, name, value).text
            meaning = meaning if len(meaning) <= LONGEST_TEXT else name
            kind = 'zero="degenerate"'
            if value in roots and (problem == "direct" or self.formulas.signs[problem, roots[value].symbol][0]):
                kind = f"signs={self.formulas.merging(problem, roots[value].symbol)!r}"
            elif (rod := self.formulas.joints.leaning.get(value)) is not None and value == rod.room:
                kind = "signs=()"
            yield f'Margin("{name}", "{scale}", "{meaning}", unit={unit}, {kind})'

    def _quantity_list(self) -> Iterator[str]:
        own = {
            name: f"angle of joint {coordinate.joint}"
            for name, coordinate in self.formulas.inverse.symbols.record.angles.items()
            if name in self.angles
        }
        three = self.formulas.three_quadrics
        if three is not None:
            names = ", ".join(map(str, three.unknowns))
            yield f'Quantity("{self.unknown}", "number", "", (), "", "direct", "(6, 2, 3)/7 . ({names})")'
        elif self.formulas.mirrored is not None:
            yield f'Quantity("{self.unknown}", "number", "", (), "", "direct", "the unknown of the direct problem")'
        elif self.eliminant is not None:
            own[self.unknown] = f"angle of {self.eliminant.direction.links[0]}, the unknown of the direct problem"
        yield from (f'Quantity("{name}", "angle", "", meaning="{meaning}")' for name, meaning in own.items())
