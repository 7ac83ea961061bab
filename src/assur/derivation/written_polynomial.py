"""A coupled set as a paper writes it: what follows linearly, and the polynomial that is left over."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.circle_pairs import CirclePair, PairEliminant
from assur.derivation.elimination import SolvedSet
from assur.derivation.formula_latex import width
from assur.derivation.linear import value_of
from assur.derivation.phrases import listed
from assur.derivation.reduced_quadrics import product_symbol
from assur.derivation.three_quadrics import three_quadrics
from assur.derivation.written_equations import SetSteps, WrittenEquations
from assur.derivation.written_parts import Block, WrittenFormula

TIMES = r"\cdot"


class WrittenPolynomial(WrittenEquations):
    """Writes sets that end in one polynomial."""

    def _polynomial(self, part: SolvedSet, eliminant: AngleEliminant, steps: SetSteps) -> Iterator[Block]:
        """A coupled set: all but one angle follow linearly, and the equation that is left over is its polynomial."""
        if isinstance(eliminant, PairEliminant) and eliminant.pair is not None:
            yield from self._pair(eliminant, eliminant.pair, steps)
            return
        angle = self.printed.angle(eliminant.direction)
        others = [own for own in part.directions if own is not eliminant.direction]
        left = listed([f"${self.printed.angle(own)}$" for own in others])
        yield f"These belong together. ${angle}$ is taken as known; {left} follow linearly. With"
        after = {own.symbol for own in (*eliminant.entries, *eliminant.steps)}
        known = [own for own in steps.named if own.symbol not in after]
        yield tuple(self.line(own.symbol, own.formula) for own in (*known, *eliminant.entries))
        *before, last = eliminant.steps
        if before:
            yield "and"
            yield tuple(self.line(own.symbol, own.formula) for own in before)
        power = f"^{{{eliminant.spare}}}" if eliminant.spare > 1 else ""
        spare = rf", without $(1 + t^{{2}}){power}$ that divides it" if eliminant.spare else ""
        yield (
            rf"one equation is left over, in $t = \tan(\frac{{1}}{{2}}{angle})$ a polynomial of degree "
            f"{eliminant.degree}{spare}:"
        )
        yield (WrittenFormula("0", self.writer.rows(last.formula, 3)),)
        yield from self._askew(part)
        yield "At each of its roots"
        yield tuple(self.line(own.symbol, own.formula) for other in others for own in steps.of(other.unknowns))

    def _askew(self, part: SolvedSet) -> Iterator[str]:
        """In what numbers are worked out, where the set leaves three quadrics."""
        three = three_quadrics(part, self.solution.symbols.witness)
        if three is not None:
            x, y, z = map(self.writer.text, three.unknowns)
            yield (
                "Where inputs are alike, solutions that are mirror images may share this angle. The code works "
                rf"in $\frac{{1}}{{7}}(6 {x} + 2 {y} + 3 {z})$, which tells them apart: all else follows linearly of "
                "these three unknowns, and three quadrics are left, which meet in eight points."
            )

    def _pair(self, eliminant: PairEliminant, pair: CirclePair, steps: SetSteps) -> Iterator[Block]:
        """Three circles: with one taken as known, a line for each of the others, and what both say."""
        base, first, last = (self.printed.angle(own) for own in (eliminant.direction, *pair.circles))
        sides = listed([f"${self.printed.angle(own)}$" for own in self.solution.loops.directions if own.kind == "side"])
        products = {product_symbol(x, y): x * y for x in pair.circles[0].unknowns for y in pair.circles[1].unknowns}
        yield f"These belong together: {sides} follow linearly of the angles. That they keep their lengths says"
        equations = (value_of(form).xreplace(products) for form in pair.lines)
        yield tuple(WrittenFormula("0", self.writer.rows(sympy.expand(own), 3)) for own in equations)
        yield f"${base}$ is taken as known: the first two are lines of ${first}$ and ${last}$. With"
        numbered = [*eliminant.steps[:-1]]
        conic = [own for own in numbered if own.symbol in eliminant.conic]
        across = [own for own in numbered if own not in (*conic, *eliminant.meeting)]
        yield tuple(self.line(own.symbol, own.formula) for own in (*eliminant.known, *eliminant.entries))
        yield f"the first and the last give ${first}$ by ${last}$, as Cramer's rule says,"
        yield tuple(self._by_last(eliminant, pair))
        if across:
            yield "where"
            yield tuple(self.line(own.symbol, own.formula) for own in across)
        yield rf"As $\cos^{{2}}{first} + \sin^{{2}}{first} = 1$, ${last}$ is on a conic too,"
        yield (WrittenFormula("0", self.writer.rows(eliminant.left_quadric, 3)),)
        if conic:
            yield "with"
            yield tuple(self.line(own.symbol, own.formula) for own in conic)
        yield f"A line, a conic and the circle of ${last}$ are left. With"
        yield tuple(self.line(own.symbol, own.formula) for own in eliminant.meeting)
        own = self.solution.components
        tangent = rf", in $t = \tan(\frac{{1}}{{2}}{base})$ a polynomial of degree {eliminant.degree}"
        yield f"they meet in a point where this vanishes{tangent if own is None or own.unknown is None else ''}:"
        yield (WrittenFormula("0", self.writer.rows(eliminant.steps[-1].formula, 3)),)
        yield from self._components()
        yield "At each of its roots, with"
        yield tuple(self.line(own.symbol, own.formula) for own in eliminant.backward)
        yield "follow"
        late = {own.symbol for own in eliminant.backward}
        others = (own for own in self.solution.sets[0].directions[1:])
        yield tuple(
            self.line(own.symbol, own.formula)
            for other in others
            for own in steps.of(other.unknowns)
            if own.symbol not in late
        )

    def _by_last(self, eliminant: PairEliminant, pair: CirclePair) -> Iterator[WrittenFormula]:
        (cosine, sine), (c, s) = (own.unknowns for own in pair.circles)
        under, *rest = (row[0] * c + row[1] * s + row[2] for row in eliminant.across)
        for unknown, over in zip((cosine, sine), rest, strict=True):
            left = self.writer.text(under * unknown) if not under.is_Add else (
                rf"({self.writer.text(under)}) {self.writer.text(unknown)}")  # fmt: skip
            yield WrittenFormula(left, self.writer.rows(over, width(left)))

    def _components(self) -> Iterator[str]:
        """What a polynomial is a product of."""
        own = self.solution.components
        if own is None:
            return
        degrees = [part.degree for part in own.parts]
        several = f"the product of {len(degrees)} irreducible polynomials"
        many = several if len(degrees) > 1 else "irreducible, a polynomial"
        size = f"of degree {degrees[0]}" if len({*degrees}) == 1 else f"of degrees {listed([*map(str, degrees)])}"
        tower = ", and no tower of square roots gives all of their roots" if own.no_tower else ""
        if own.unknown is None:
            yield f"It is {many} {size}{tower}."
            return
        letter, other = self.writer.text(own.unknown), self.writer.text(self._beside(own.unknown))
        yield (
            rf"${other}$ is in it by its square alone, with $1 - {self.writer.text(own.unknown**2)}$ for which it is "
            f"{many} {size} in ${letter}${tower}. The sign of ${other}$ tells each solution from its mirror image: "
            f"${own.total.replace('x', TIMES)} = {own.count}$."
        )

    def _beside(self, unknown: sympy.Symbol) -> sympy.Symbol:
        """The sine of a cosine, and the other way."""
        circles = (own.unknowns for own in self.solution.loops.directions if unknown in own.unknowns)
        return next(own for circle in circles for own in circle if own != unknown)
