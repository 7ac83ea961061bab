"""The closed form as a file: both problems, joints, velocity equations and what vanishes, as kernels that are read."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.closed_form_declaration import ClosedFormDeclaration
from assur.derivation.closed_form_parts import ClosedFormParts
from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.elimination import Root
from assur.derivation.joint_formulas import BallRotation, Pointing
from assur.derivation.kernel_text import KernelPrinter, sign_attribute, sign_text
from assur.derivation.symbols import circle_of
from assur.kinematics.modes import Problem

CODE_HEAD = '''"""Closed form of {name}, derived from its joint graph: {sets}."""

from types import SimpleNamespace

from assur.model.closed_form import {declared}
{imports}
'''

OVER_CIRCLE = '''
def _over_circle(values):
    """A polynomial in t, over 1 + t^2, which divides it."""
    quotient = []
    for k in range(len(values) - 2):
        quotient.append(values[k] - quotient[k - 2] if k > 1 else values[k])
    return tuple(quotient)
'''


ACROSS = (3, 1, 0)
"""A direction along which no line through coinciding centres lies but by chance: machines have axes along x, y, z."""


class ClosedFormText(ClosedFormParts):
    """Writes the closed form of a mechanism whose direct and inverse problems were solved."""

    def text(self) -> str:
        """The file."""
        declared = ClosedFormDeclaration(self.formulas, self.meanings, self.constraint_singular, self.couples)
        parts = [self._head(), self._problem("inverse"), self._problem("direct"), self._self_motion(), self._core(),
                 self._joints(), self._factors(), self._jacobians(), self._quantities(), declared.text()]  # fmt: skip
        return "\n\n".join(part.strip("\n") + "\n" for part in parts if part)

    @cached_property
    def printer(self) -> KernelPrinter:
        """Prints formulas."""
        return KernelPrinter(self.formulas.inverse.symbols.record.parameters)

    def _head(self) -> str:
        record = self.formulas.inverse.symbols.record
        sets = "; ".join(part.name for part in self.formulas.direct.sets)
        imports = []
        declared = ["Branch", "ClosedForm", "Factor", "Margin", "Sign"]
        if self.angles or self.eliminant is not None:
            declared.append("Quantity")
        if self.motion is not None:
            declared.append("SelfMotion")
        if self.eliminant is not None:
            declared.append("Eliminant")
            imports.append("from assur.numerics.expanded import coefficients_of, unknowns")
        if any(own.lean == 0 for own in self.formulas.joints.pointings):
            imports.append("from assur.numerics.legs import pointing")
        used = {"taking": bool(self.formulas.joints.tilts), "product": self._many, "transposed": self._turned}
        if self.motion is not None and self.motion.centres:
            imports.append("from assur.numerics.meetings import coincident_spheres")
        vectors = sorted(name for name, needed in used.items() if needed)
        if vectors:
            imports.append(f"from assur.numerics.vectors import {', '.join(vectors)}")
        own = {
            "name": record.name,
            "sets": sets,
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

    def _problem(self, problem: Problem) -> str:
        if problem == "direct" and self.eliminant is not None:
            return "\n\n".join(part.strip("\n") + "\n" for part in self._polynomial(self.eliminant))
        solution = self.formulas.solution(problem)
        names = [self.formulas.signs[problem, root.symbol][0] for root in solution.roots]
        title = "Pose at given inputs" if problem == "direct" else "Inputs at a pose"
        given = "inputs" if problem == "direct" else "pose"
        lines = [f"def {problem}(ns, p, {given}, sign):"]
        lines.append(f'    """{title}. Signs: {", ".join(names) or "none"}."""')
        lines += self._given(problem)
        lines += self._lines(problem, solution.definitions)
        return "\n".join([*lines, *self._branch(problem)])

    def _lines(self, problem: Problem, definitions: Iterable[Definition]) -> Iterator[str]:
        roots = {root.symbol: root for root in self.formulas.solution(problem).roots}
        return (self._line(problem, own, roots) for own in definitions)

    def _self_motion(self) -> str:
        """The kernel of the curve on which the platform moves while the inputs stand."""
        motion = self.motion
        if motion is None:
            return ""
        given = motion.part.directions[0].unknowns
        lines = ["def self_motion(ns, p, inputs, angle, sign):"]
        signs = ", ".join(self.motion_signs) or "none"
        lines.append(f'    """Poses at {motion.condition} = 0, by {self.motion_angle}. Signs: {signs}."""')
        lines += self._given("direct")
        before, after = _split(motion.definitions, given)
        if motion.centres:
            lines += self._lines("direct", before)
            second, third = map(self._pair_text, motion.centres)
            lines.append(f"    centres = ((0, 0, 0), {second}, {third})")
            call = f"coincident_spheres(ns, centres, 1, {ACROSS!r}, angle)"
            lines.append(f"    ({', '.join(map(str, given))}), radicand = {call}")
            lines += self._lines("direct", after)
        else:
            lines.append(f"    {', '.join(map(str, given))} = angle")
            lines += self._lines("direct", motion.definitions)
        every = {own.symbol for own in self.formulas.direct.definitions}
        left_out = every - {own.symbol for own in motion.definitions} - {*given}
        radicand = motion.part.roots[0].radicand if motion.centres else None
        return "\n".join([*lines, *self._branch("direct", left_out, radicand)])

    def _branch(
        self, problem: Problem, left_out: Collection[sympy.Symbol] = (), radicand: sympy.Symbol | None = None
    ) -> list[str]:
        """The rest of a kernel, once its unknowns are known; margins of what is left out are left out too, but for a
        radicand that is called so.
        """
        lines = [f"    {symbol.name} = {self.printer.doprint(value)}" for symbol, value in self.formulas.rest(problem)]
        lines.append(f"    core = _core(ns, p, {', '.join(map(str, [*self.formulas.posed, *self.formulas.unknowns]))})")
        margins = ", ".join(
            f'"{name}": {"radicand" if value == radicand else self.printer.doprint(value)}'
            for name, value in self.formulas.margins(problem)
            if value == radicand or not value.free_symbols & {*left_out}
        )
        pose, inputs = self._pair_text(self.formulas.posed_pairs), self._pair_text(self.formulas.input_pairs)
        lines.append(f"    margins = {{{margins}}}")
        lines.append(f"    return Branch({pose}, {inputs}, margins, core)")
        return lines

    def _polynomial(self, eliminant: AngleEliminant) -> Iterator[str]:
        """The kernels of a direct problem that ends in one polynomial."""
        solution, names = self.formulas.direct, [self.formulas.signs["direct", own.symbol][0] for own in
                                                 self.formulas.direct.roots]  # fmt: skip
        arguments = "ns, p, inputs" + (", sign" if names else "")
        before: list[Definition] = []
        for part in solution.sets:
            if part.eliminant is not None:
                break
            before += part.definitions
        cosine, sine = eliminant.direction.unknowns
        one = FreeNames({*solution.symbols.parameters, str(cosine), str(sine)}).named("one")
        last = eliminant.steps[-1].symbol
        lines = [f"def coefficients({arguments}):"]
        lines.append(f'    """Coefficients, the constant term first, of the polynomial in tan({self.unknown}/2)."""')
        lines += self._given("direct")
        lines += self._lines("direct", (*before, *eliminant.known))
        lines.append("    (t,) = unknowns(1)")
        lines.append(f"    {cosine}, {sine}, {one} = 1 - t * t, 2 * t, 1 + t * t")
        lines += self._lines("direct", eliminant.program(one))
        text = f"coefficients_of({last}, {eliminant.degree + 2 * eliminant.spare + 1})"
        for _ in range(eliminant.spare):
            text = f"_over_circle({text})"
        yield "\n".join([*lines, f"    return {text}"])
        if eliminant.spare:
            yield OVER_CIRCLE
        lines = [f"def back({arguments}, root):" if not names else "def back(ns, p, inputs, root, sign):"]
        lines.append(f'    """The pose at a root, cosine and sine of {self.unknown}."""')
        lines += self._given("direct")
        lines.append(f"    {cosine}, {sine} = root")
        lines += self._lines("direct", solution.definitions)
        yield "\n".join([*lines, *self._branch("direct")])

    def _quantities(self) -> str:
        """The angles that the file names, and the unknown of the polynomial."""
        texts = {name: self._pair_text(pair) for name, pair in self.angles.items()}
        if self.eliminant is not None:
            pair = circle_of("phi") if self.unknown == "phi" else self.eliminant.direction.unknowns
            texts[self.unknown] = f"({', '.join(f'core.{own}' for own in pair)})"
        if not texts:
            return ""
        lines = ["def quantities(ns, p, core):", '    """Angles by their names."""']
        lines += self._taken([part for pair in self.angles.values() for part in pair])
        body = ", ".join(f'"{name}": {text}' for name, text in texts.items())
        return "\n".join([*lines, f"    return {{{body}}}"])

    def _line(self, problem: Problem, own: Definition, roots: Mapping[sympy.Symbol, Root]) -> str:
        text = self.printer.doprint(own.formula)
        if own.symbol in roots:
            name, sense = self.formulas.signs[problem, own.symbol]
            product = self.formulas.sign_product(problem, own.symbol)
            if product.divisors:  # whose signs the root has too
                whole = sympy.prod(product.divisors)
                text = self.printer.doprint(whole * sympy.sqrt(roots[own.symbol].radicand / whole**2))
            names = "".join(f"{sign_text(other)} * " for other in (name, *product.names))
            text = f"{'-' if sense < 0 else ''}{names}{text}"
        return f"    {own.symbol.name} = {text}"

    def _given(self, problem: Problem) -> list[str]:
        pairs = self.formulas.posed_pairs if problem == "inverse" else self.formulas.printed_inputs
        left = self._pair_text(pairs, calls=False)
        return [f"    {left} = {'pose' if problem == 'inverse' else 'inputs'}"]

    def _pair_text(self, values: Sequence[Any], calls: bool = True) -> str:
        def one(value: Any) -> str:
            if isinstance(value, tuple):
                return f"({', '.join(map(one, value))})"
            return self.printer.doprint(value) if calls else str(value)

        text = ", ".join(map(one, values))
        return f"({text},)" if len(values) == 1 else f"({text})"

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
            line, direction = self._pair_text(tilt.line), self._pair_text(tilt.direction)
            lines.append(f"    {tilt.name} = taking({line}, {direction})")
        lines.append("    return {")
        lines += [f'        "{name}": {self._value(value)},' for name, value in self.formulas.joints.values.items()]
        lines.append("    }")
        return "\n".join(lines)

    def _value(self, value: Any) -> str:
        if isinstance(value, BallRotation):
            texts = []
            for part, turned in value.parts:
                text = part if isinstance(part, str) else self._pair_text([tuple(row) for row in part])
                texts.append(f"transposed({text})" if turned else text)
            whole = texts[0] if texts else "((1, 0, 0), (0, 1, 0), (0, 0, 1))"
            for text in texts[1:]:
                whole = f"product({whole}, {text})"
            return whole
        return self._pair_text(value) if isinstance(value, tuple) else self.printer.doprint(value)

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
            lines += [f"        {self._pair_text(row)}," for row in matrix.tolist()]
            lines.append("    )")
        lines.append("    return jp, jq")
        return "\n".join(lines)


def _split(
    definitions: Iterable[Definition], given: Collection[sympy.Symbol]
) -> tuple[list[Definition], list[Definition]]:
    """Definitions that do not need some symbols, and those that do."""
    before: list[Definition] = []
    after: list[Definition] = []
    late = {*given}
    for own in definitions:
        if own.formula.free_symbols & late:
            after.append(own)
            late.add(own.symbol)
        else:
            before.append(own)
    return before, after
