"""The kernels of a closed form that solve: inverse and direct problem, a polynomial, a curve of self-motion."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import takewhile
from typing import Any

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.closed_form_formulas import APART, ASIDE
from assur.derivation.closed_form_parts import ClosedFormParts
from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.elimination import Root
from assur.derivation.kernel_text import KernelPrinter, sign_text
from assur.derivation.linear import ONE
from assur.derivation.mirror_polynomials import MirrorPolynomials
from assur.derivation.three_quadrics import ThreeQuadrics
from assur.kinematics.modes import Problem

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


class ClosedFormKernels(ClosedFormParts):
    """Writes the kernels that solve."""

    @cached_property
    def printer(self) -> KernelPrinter:
        """Prints formulas."""
        return KernelPrinter(self.formulas.inverse.symbols.record.parameters)

    def problem(self, problem: Problem) -> str:
        """The kernels of one problem."""
        if problem == "direct" and self.eliminant is not None:
            three = self.formulas.three_quadrics
            mirrored = self.formulas.mirrored
            if three is not None:
                parts = self._in_space(three, self.eliminant)
            else:
                parts = self._polynomial(self.eliminant) if mirrored is None else self._mirrored(mirrored)
            return "\n\n".join(part.strip("\n") + "\n" for part in parts)
        solution = self.formulas.solution(problem)
        names = [name for root in solution.roots if (name := self.formulas.signs[problem, root.symbol][0])]
        title = "Pose at given inputs" if problem == "direct" else "Inputs at a pose"
        given = "inputs" if problem == "direct" else "pose"
        lines = [f"def {problem}(ns, p, {given}, sign):"]
        lines.append(f'    """{title}. Signs: {", ".join(names) or "none"}."""')
        lines += self._given(problem)
        lines += self._lines(problem, solution.definitions)
        return "\n".join([*lines, *self._branch(problem)])

    def _polynomial(self, eliminant: AngleEliminant) -> Iterator[str]:
        """The kernels of a direct problem that ends in one polynomial."""
        solution, sign = self.formulas.direct, self._sign_argument
        cosine, sine = eliminant.direction.unknowns
        one = FreeNames({*solution.symbols.parameters, str(cosine), str(sine)}).named("one")
        last = eliminant.steps[-1].symbol
        lines = [f"def left_over(ns, p, inputs, root{sign}):"]
        lines.append(f'    """What vanishes at a root: homogeneous in cosine and sine of {self.unknown} and 1."""')
        lines += self._given("direct")
        lines += self._lines("direct", (*self._before, *eliminant.known))
        lines.append(f"    {cosine}, {sine}, {one} = root")
        lines += self._lines("direct", eliminant.program(one))
        yield "\n".join([*lines, f"    return {last}"])
        lines = [f"def coefficients(ns, p, inputs{sign}):"]
        lines.append(f'    """Coefficients, the constant term first, of the polynomial in tan({self.unknown}/2)."""')
        lines.append("    (t,) = unknowns(1)")
        call = f"left_over(ns, p, inputs, (1 - t * t, 2 * t, 1 + t * t){sign})"
        text = f"coefficients_of({call}, {eliminant.degree + 2 * eliminant.spare + 1})"
        for _ in range(eliminant.spare):
            text = f"_over_circle({text})"
        yield "\n".join([*lines, f"    return {text}"])
        if eliminant.spare:
            yield OVER_CIRCLE
        lines = [f"def back(ns, p, inputs, root{sign}):"]
        lines.append(f'    """The pose at a root, cosine and sine of {self.unknown}."""')
        lines += self._given("direct")
        lines.append(f"    {cosine}, {sine} = root")
        yield "\n".join([*lines, *self._at_root()])

    def _mirrored(self, own: MirrorPolynomials) -> Iterator[str]:
        """The kernels of a direct problem that ends in polynomials in even powers."""
        lines = ["def coefficients(ns, p, inputs, sign):"]
        which = f", of the component that sign.{own.signs[0]} tells" if len(own.polynomials) > 1 else ""
        lines.append(f'    """Coefficients, the constant term first, of the polynomial in {own.unknown}{which}."""')
        lines += self._given("direct")
        for name, row in zip(("first", "second"), own.polynomials, strict=False):
            lines += [f"    {name} = (", *(f"        {self.printer.doprint(part)}," for part in row), "    )"]
        chosen = f"tuple((a + b + sign.{own.signs[0]} * (a - b)) / 2 for a, b in zip(first, second))"
        yield "\n".join([*lines, f"    return {chosen if len(own.polynomials) > 1 else 'first'}"])
        lines = ["def back(ns, p, inputs, root, sign):"]
        side = own.signs[-1]
        lines.append(f'    """The pose at a root {own.unknown}, of which sign.{side} tells two mirror images."""')
        lines += self._given("direct")
        lines += [f"    {own.unknown}, {ASIDE} = root, 1 - root * root"]
        lines += [f"    {own.beside} = sign.{side} * ns.sqrt({ASIDE})"]
        yield "\n".join([*lines, *self._at_root()])

    def _at_root(self) -> list[str]:
        """The lines that follow once cosine and sine of the polynomial's angle are known."""
        solution, lines = self.formulas.direct, list[str]()
        circles, last = self.formulas.three_circles, 0
        if circles:
            names = {unknown for own in circles for unknown in own.unknowns}
            last = max(k for k, own in enumerate(solution.definitions, start=1) if own.symbol in names)
            lines += self._lines("direct", solution.definitions[:last])
            pairs = self.pair_text([own.unknowns for own in circles])
            lines.append(f"    {pairs} = nearer_angles({self.pair_text(self.formulas.sides)}, {pairs})")
        lines += self._lines("direct", solution.definitions[last:])
        return [*lines, *self._branch("direct")]

    @property
    def _sign_argument(self) -> str:
        """Of the kernels of a polynomial."""
        return ", sign" if self.formulas.direct.roots else ""

    @property
    def _before(self) -> list[Definition]:
        """Definitions of the sets before that of the polynomial."""
        sets = takewhile(lambda part: part.eliminant is None, self.formulas.direct.sets)
        return [own for part in sets for own in part.definitions]

    def _in_space(self, three: ThreeQuadrics, eliminant: AngleEliminant) -> Iterator[str]:
        """The kernels of a direct problem that ends in three quadrics, by a coordinate askew to their unknowns."""
        sign, sets = self._sign_argument, self.formulas.direct.sets
        own = next(k for k, part in enumerate(sets) if part.eliminant is eliminant)
        later = [*(own for part in sets[own + 1 :] for own in part.definitions), *self.formulas.direct.lengths]
        ahead = [form for sums in three.sums for form in sums]
        wanted = {symbol for form in ahead for part in form.values() for symbol in part.free_symbols}
        wanted |= {symbol for part in (*three.values, *later) for symbol in part.formula.free_symbols}
        known = _needed(eliminant.known, wanted | {*three.conditions})
        lines = [f"def sums(ns, p, inputs{sign}):"]
        lines.append(f'    """Forms in {", ".join(map(str, three.unknowns))}, of three sums of squares that are 1."""')
        lines += self._given("direct")
        lines += self._lines("direct", _needed((*self._before, *known), wanted))
        lines.append("    return (")
        for sums in three.sums:
            rows = [(form.get(ONE, 0), tuple(form.get(unknown, 0) for unknown in three.unknowns)) for form in sums]
            lines.append(f"        {self.pair_text(rows)},")
        yield "\n".join([*lines, "    )"])
        quadrics = "tuple(sum_of_squares(own) for own in {})"
        call = f"sums(ns, p, inputs{sign})"
        lines = [f"def coefficients(ns, p, inputs{sign}):"]
        lines.append(f'    """Coefficients, the constant term first, of the polynomial in {self.unknown}."""')
        yield "\n".join([*lines, f"    return eliminant({quadrics.format(call)})"])
        lines = [f"def back(ns, p, inputs, root{sign}):", f'    """The pose at a root {self.unknown}."""']
        lines += self._given("direct")
        lines.append(f"    squares = {call}")
        lines.append(f"    first, second, {APART} = other_two({quadrics.format('squares')}, root)")
        unknowns = ", ".join(map(str, three.unknowns))
        lines.append(f"    {unknowns} = nearer(squares, apply(transposed(ASKEW), (root, first, second)))")
        lines += self._lines("direct", (*self._before, *known, *three.values, *later))
        yield "\n".join([*lines, *self._branch("direct")])

    def self_motion_kernel(self) -> str:
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
            second, third = map(self.pair_text, motion.centres)
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
        pose, inputs = self.pair_text(self.formulas.posed_pairs), self.pair_text(self.formulas.input_pairs)
        lines.append(f"    margins = {{{margins}}}")
        lines.append(f"    return Branch({pose}, {inputs}, margins, core)")
        return lines

    def _lines(self, problem: Problem, definitions: Iterable[Definition]) -> Iterator[str]:
        roots = {root.symbol: root for root in self.formulas.solution(problem).roots}
        return (self._line(problem, own, roots) for own in definitions)

    def _line(self, problem: Problem, own: Definition, roots: Mapping[sympy.Symbol, Root]) -> str:
        text = self.printer.doprint(own.formula)
        if own.symbol in roots:
            name, sense = self.formulas.signs[problem, own.symbol]
            product = self.formulas.sign_product(problem, own.symbol)
            if product.divisors:  # whose signs the root has too
                whole = sympy.prod(product.divisors)
                text = self.printer.doprint(whole * sympy.sqrt(roots[own.symbol].radicand / whole**2))
            names = "".join(f"{sign_text(other)} * " for other in (name, *product.names) if other)
            text = f"{'-' if sense < 0 else ''}{names}{text}"
        return f"    {own.symbol.name} = {text}"

    def _given(self, problem: Problem) -> list[str]:
        pairs = self.formulas.posed_pairs if problem == "inverse" else self.formulas.printed_inputs
        left = self.pair_text(pairs, calls=False)
        return [f"    {left} = {'pose' if problem == 'inverse' else 'inputs'}"]

    def pair_text(self, values: Sequence[Any], calls: bool = True) -> str:
        """A tuple of formulas, or of names, as text."""

        def one(value: Any) -> str:
            if isinstance(value, tuple | list):
                return f"({', '.join(map(one, value))})"
            return self.printer.doprint(value) if calls else str(value)

        text = ", ".join(map(one, values))
        return f"({text},)" if len(values) == 1 else f"({text})"


def _needed(definitions: Sequence[Definition], symbols: set[sympy.Symbol]) -> list[Definition]:
    """Definitions of symbols, and of what these need."""
    kept: list[Definition] = []
    for own in reversed(definitions):
        if own.symbol in symbols:
            kept.insert(0, own)
            symbols = symbols | own.formula.free_symbols
    return kept


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
