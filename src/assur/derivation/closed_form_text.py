"""The closed form as a file: both problems, joints, velocity equations and what vanishes, as kernels that are read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.closed_form_declaration import ClosedFormDeclaration
from assur.derivation.closed_form_kernels import ClosedFormKernels
from assur.derivation.joint_formulas import BallRotation, Pointing
from assur.derivation.kernel_text import sign_attribute
from assur.derivation.symbols import circle_of

CODE_HEAD = '''"""Closed form of {name}, derived from its joint graph{sets}."""

from types import SimpleNamespace

from assur.model.closed_form import {declared}
{imports}
'''


class ClosedFormText(ClosedFormKernels):
    """Writes the closed form of a mechanism whose direct and inverse problems were solved."""

    def text(self) -> str:
        """The file."""
        declared = ClosedFormDeclaration(self.formulas, self.meanings, self.constraint_singular, self.couples)
        parts = [self._head(), self.problem("inverse"), self.problem("direct"), self.self_motion_kernel(), self._core(),
                 self._joints(), self._factors(), self._jacobians(), self._quantities(), declared.text()]  # fmt: skip
        return "\n\n".join(part.strip("\n") + "\n" for part in parts if part)

    def _head(self) -> str:
        record = self.formulas.inverse.symbols.record
        sets = "; ".join(part.name for part in self.formulas.direct.sets)
        imports = []
        three = self.formulas.three_quadrics
        declared = ["Branch", "ClosedForm", "Factor", "Margin", "Sign"]
        if self.angles or self.eliminant is not None:
            declared.append("Quantity")
        if self.motion is not None:
            declared.append("SelfMotion")
        if self.eliminant is not None:
            declared.append("Eliminant")
            if self.formulas.mirrored is None:
                imports.append(
                    "from assur.numerics.expanded import coefficients_of, unknowns"
                    if three is None
                    else "from assur.numerics.resultants import ASKEW, eliminant, nearer, other_two, sum_of_squares"
                )
        if self.formulas.three_circles:
            imports.append("from assur.numerics.resultants import nearer_angles")
        if any(own.lean == 0 for own in self.formulas.joints.pointings):
            imports.append("from assur.numerics.legs import pointing")
        used = {
            "apply": three is not None,
            "dot": three is not None,
            "taking": bool(self.formulas.joints.tilts),
            "product": self._many,
            "transposed": self._turned or three is not None,
        }
        if self.motion is not None and self.motion.centres:
            imports.append("from assur.numerics.meetings import coincident_spheres")
        vectors = sorted(name for name, needed in used.items() if needed)
        if vectors:
            imports.append(f"from assur.numerics.vectors import {', '.join(vectors)}")
        own = {
            "name": record.name,
            "sets": f": {sets}" if sets else "",
            "imports": "\n".join(imports),
            "declared": ", ".join(sorted(declared)),
        }
        return CODE_HEAD.format(**own)

    @cached_property
    def _balls(self) -> list[BallRotation]:
        return [value for value in self.formulas.joints.values.values() if isinstance(value, BallRotation)]

    @cached_property
    def _many(self) -> bool:
        return any(len(ball.parts) > 1 for ball in self._balls)

    @cached_property
    def _turned(self) -> bool:
        return any(turned for ball in self._balls for _, turned in ball.parts)

    def _quantities(self) -> str:
        """The angles that the file names, and the unknown of the polynomial."""
        texts = {name: self.pair_text(pair) for name, pair in self.angles.items()}
        used = [part for pair in self.angles.values() for part in pair]
        three = self.formulas.three_quadrics
        if three is not None:
            place = [self.formulas.of_direct(own) for own in three.unknowns]
            texts[self.unknown], used = f"dot(ASKEW[0], {self.pair_text(place)})", [*used, *place]
        elif self.formulas.mirrored is not None:
            texts[self.unknown] = f"core.{self.unknown}"
        elif self.eliminant is not None:
            pair = circle_of("phi") if self.unknown == "phi" else self.eliminant.direction.unknowns
            place = [self.formulas.of_direct(own) for own in pair]
            texts[self.unknown], used = self.pair_text(place), [*used, *place]
        if not texts:
            return ""
        lines = ["def quantities(ns, p, core):", '    """Angles by their names."""']
        lines += self._taken(used)
        body = ", ".join(f'"{name}": {text}' for name, text in texts.items())
        return "\n".join([*lines, f"    return {{{body}}}"])

    def _core(self) -> str:
        names = [str(symbol) for symbol in (*self.formulas.posed, *self.formulas.unknowns)]
        lines = [f"def _core(ns, p, {', '.join(names)}):"]
        lines.append("    return SimpleNamespace(")
        lines += [f"        {name}={name}," for name in names]
        lines += [
            f"        {sign_attribute(name)}={self.printer.doprint(value)},"
            for name, value in self.formulas.sign_values.items()
        ]
        lines.append("    )")
        return "\n".join(lines)

    def _taken(self, expressions: Sequence[Any]) -> list[str]:
        """Lines that take out of the core what formulas need, and angles of links that point somewhere."""
        used = {symbol for part in expressions for symbol in sympy.sympify(part).free_symbols}
        pointings = [own for own in self.formulas.joints.pointings if used & {*own.carrier, *own.hinge}]
        used |= {symbol for own in pointings for part in (own.ahead, own.beside, own.along) for symbol in
                 sympy.sympify(part).free_symbols}  # fmt: skip
        named = [*self.formulas.posed, *self.formulas.unknowns]
        lines = [f"    {symbol} = core.{symbol}" for symbol in named if symbol in used]
        return [*lines, *(line for own in pointings for line in self._pointed(own))]

    def _pointed(self, own: Pointing) -> Iterator[str]:
        """Angles of the carrier and of the hinge of a link that points somewhere."""
        (a, b), (c, d) = own.carrier, own.hinge
        ahead, beside = (self.printer.doprint(-part if own.back else part) for part in (own.ahead, own.beside))
        along = self.printer.doprint(own.along / own.level)
        if own.lean == 0:
            yield f"    ({a}, {b}), ({c}, {d}), _ = pointing(ns, {ahead}, {beside}, {along}, 1e-30)"
        else:
            yield from self._leaning(own, ahead, beside)
            yield f"    {d} = {along}"
        if own.back:
            yield f"    {c} = -{c}"

    def _leaning(self, own: Pointing, ahead: str, beside: str) -> Iterator[str]:
        """Lines for a rod that leans along its hinge; that its line is a unit vector needs no root."""
        (a, b), name, lean = own.carrier, own.hinge[0], self.printer.doprint(-own.lean if own.back else own.lean)
        x, y, square, across = (f"{name}_{part}" for part in ("x", "y", "square", "across"))
        yield f"    {x}, {y} = {ahead}, {beside}"
        yield f"    {square} = {x} * {x} + {y} * {y}"
        yield f"    {across} = ns.sqrt({square} - ({lean}) * ({lean}))"
        yield f"    {a} = ({x} * {across} + {y} * ({lean})) / {square}"
        yield f"    {b} = ({y} * {across} - {x} * ({lean})) / {square}"
        yield f"    {name} = {across} / ({self.printer.doprint(own.level)})"

    def _joints(self) -> str:
        flat: list[Any] = []
        for value in self.formulas.joints.values.values():
            if isinstance(value, BallRotation):
                flat += [entry for part, _ in value.parts if not isinstance(part, str) for row in part for entry in row]
            else:
                flat += [*value] if isinstance(value, tuple) else [value]
        flat += [entry for tilt in self.formulas.joints.tilts for entry in (*tilt.line, *tilt.direction)]
        lines = ["def joints(ns, p, core):", '    """Every joint\'s value."""', *self._taken(flat)]
        for tilt in self.formulas.joints.tilts:
            line, direction = self.pair_text(tilt.line), self.pair_text(tilt.direction)
            lines.append(f"    {tilt.name} = taking({line}, {direction})")
        lines.append("    return {")
        lines += [f'        "{name}": {self._value(value)},' for name, value in self.formulas.joints.values.items()]
        lines.append("    }")
        return "\n".join(lines)

    def _value(self, value: Any) -> str:
        if isinstance(value, BallRotation):
            texts = []
            for part, turned in value.parts:
                text = part if isinstance(part, str) else self.pair_text([tuple(row) for row in part])
                texts.append(f"transposed({text})" if turned else text)
            whole = texts[0] if texts else "((1, 0, 0), (0, 1, 0), (0, 0, 1))"
            for text in texts[1:]:
                whole = f"product({whole}, {text})"
            return whole
        return self.pair_text(value) if isinstance(value, tuple) else self.printer.doprint(value)

    def _factors(self) -> str:
        lines = ["def factors(ns, p, core):", '    """Factors of det Jp and det Jq."""']
        lines += self._taken([value for _, _, value in self.factors])
        lines.append("    return {")
        lines += [f'        "{name}": {self.printer.doprint(value)},' for name, _, value in self.factors]
        lines.append("    }")
        return "\n".join(lines)

    def _jacobians(self) -> str:
        jp, jq = self.formulas.velocities.jp, self.formulas.velocities.jq
        lines = ["def jacobians(ns, p, core):", '    """Rows of Jp and of Jq, with Jp v = Jq q\'."""']
        lines += self._taken([*jp, *jq])
        for name, matrix in (("jp", jp), ("jq", jq)):
            lines.append(f"    {name} = (")
            lines += [f"        {self.pair_text(row)}," for row in matrix.tolist()]
            lines.append("    )")
        lines.append("    return jp, jq")
        return "\n".join(lines)
