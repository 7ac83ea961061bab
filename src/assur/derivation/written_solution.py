"""A solution as a paper writes it: reasons, then set by set what is unknown, equations, elimination, result."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.circle_pairs import CirclePair, PairEliminant
from assur.derivation.definitions import Definition
from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.formula_latex import BREAK, COLUMN, FUNCTIONS, FormulaLatex, width, wrapped
from assur.derivation.letters_of_names import input_letter, joint_letter
from assur.derivation.linear import ONE, Form, never_zero, value_of
from assur.derivation.phrases import GeometricPhrase, direction, listed, words
from assur.derivation.platform_rotation import posed_entries
from assur.derivation.printed_letters import PrintedLetters
from assur.derivation.reach_meanings import ReachMeanings
from assur.derivation.reduced_quadrics import product_symbol
from assur.derivation.rod_vectors import RodVectors, rod_vectors
from assur.derivation.solution import AnalyticSolution
from assur.derivation.unknown_directions import UnknownDirection
from assur.model.pose import ANGLES

ZERO = sympy.Integer(0)
NOT_ZERO = r"\ne 0$"
ENTRIES = {
    "R11": r"\cos\theta \cos\varphi", "R21": r"\cos\theta \sin\varphi", "R31": r"-\sin\theta",
    "R32": r"\cos\theta \sin\psi", "R33": r"\cos\theta \cos\psi",
}  # fmt: skip
"""What entries of the platform's rotation are in the angles of its pose."""
TIMES = r"\cdot"
NARROW = 12
"""So wide may be what a letter is multiplied with on the left."""


@dataclass(frozen=True)
class WrittenFormula:
    r"""A formula in LaTeX: left side with its relation, rows of the right side.

    >>> WrittenFormula("B_{1}", ("l_{3} - y_{1}", "+ y_{2}")).latex
    'B_{1} = l_{3} - y_{1} + y_{2}'
    """

    left: str
    rows: tuple[str, ...]
    relation: str = "="

    @property
    def latex(self) -> str:
        """On one line."""
        return f"{self.left} {self.relation} {' '.join(self.rows)}"


Block = str | tuple[WrittenFormula, ...]
"""A paragraph, whose mathematics stands between dollar signs, or formulas."""


@dataclass(frozen=True)
class WrittenPart:
    """A subsection: its title, paragraphs and formulas."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class FlowNode:
    """A step of a solution: its name, what it gives, what is given of it, and the places of the steps before it."""

    name: str
    gives: str
    given: tuple[str, ...]
    before: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class WrittenSolution:
    """Writes one problem.

    Attributes:
        solution: what is written.
        printed: its letters.
        meanings: root -> what holds where its sign is +, in words; empty where nobody said.
    """

    solution: AnalyticSolution
    printed: PrintedLetters
    meanings: Mapping[sympy.Symbol, str]

    @cached_property
    def writer(self) -> FormulaLatex:
        """Writes formulas in these letters."""
        return FormulaLatex(self.printed.letters, self.printed.radicals)

    def reasons(self) -> tuple[str, ...]:
        """Why links do not turn: axes and chains, one sentence each."""
        return tuple(self._reasons())

    def parts(self) -> tuple[WrittenPart, ...]:
        """The sets in their order, then the result."""
        own = [self._set(number, part) for number, part in enumerate(self.solution.sets, start=1)]
        return (*own, self._result())

    def line(self, symbol: sympy.Symbol, formula: sympy.Expr) -> WrittenFormula:
        """A definition, without lengths divided out and with the sign of its letter."""
        letter = self.writer.letters[symbol]
        plain = self.writer.displayed(formula)
        above, below = sympy.fraction(sympy.together(plain) if letter.rank == 5 else plain)
        if letter.sense < 0:
            above = sympy.factor_terms(-above)
        parameters = {*self.solution.symbols.parameters.values(), *self.printed.radicals.values()}
        below = self._short(below)
        shown = width(self.writer.text(below)) < NARROW
        if shown and above.is_Add and below != 1 and not below.free_symbols - parameters and letter.rank == 5:
            left = self.writer.text(below * symbol * letter.sense)
            return WrittenFormula(left, self.writer.broken(above, width(left) + 2))
        left = self.writer.text(symbol * letter.sense)
        whole = above if below == 1 else above / below
        return WrittenFormula(left, self.writer.broken(whole, width(left) + 2))

    def _short(self, formula: sympy.Expr) -> sympy.Expr:
        """With cosines and sines of angles among the dimensions put together."""
        return sympy.factor_terms(sympy.trigsimp(formula)) if formula.has(*FUNCTIONS) else formula

    def _condition(self, condition: sympy.Expr) -> str:
        """What must not vanish: of a quotient what is above."""
        above, _ = sympy.fraction(sympy.together(condition))
        short = self._short(above)
        return self.writer.text(-short if self._negative(short) else short)

    def _reasons(self) -> Iterator[str]:
        for reason in self.solution.placed.reasons:
            ways = (
                f"axes along {self.axis(axis)} ({', '.join(f'${joint_letter(joint)}$' for joint in joints)})"
                for axis, joints in ((reason.first, reason.first_joints), (reason.second, reason.second_joints))
            )
            first, second = ways
            link, carrier = words(reason.link), words(reason.carrier)
            yield f"{link} hangs on {carrier} by {first} and by {second}; so it does not turn against it."

    def axis(self, axis: Sequence[Any]) -> str:
        """A direction between dollar signs: a letter, or the vector without its length."""
        vector = sympy.Matrix(axis)
        plain = direction(axis)
        if len(plain) == 1:
            return f"${plain}$"
        whole = vector / next(abs(part) for part in vector if part != 0)
        parts = (self.writer.text(sympy.radsimp(sympy.simplify(part))) for part in whole)
        return f"$({', '.join(parts)})$"

    def _set(self, number: int, part: SolvedSet) -> WrittenPart:
        links = listed([*dict.fromkeys(words(own.links[0]) for own in part.directions)])
        return WrittenPart(f"Set {number}: {links}", tuple(self._blocks(part)))

    def _blocks(self, part: SolvedSet) -> Iterator[Block]:
        joints = ", ".join(f"${joint_letter(joint)}$" for joint in self.joints(part))
        unknown = listed([f"${self.printed.angle(own)}$" for own in part.directions])
        yield f"The chain of {joints}. Unknown: {unknown}. The loop equations in which nothing else is unknown are"
        yield tuple(self._equation(form) for form in part.equations)
        steps = _Steps(part)
        if steps.known:
            yield "where"
            yield tuple(self.line(own.symbol, own.formula) for own in steps.known)
        yield from self._elimination(part, steps)
        yield from self._choice(part)

    def joints(self, part: SolvedSet) -> list[str]:
        """Joints of the links that a set solves for, the parts of a parallelogram as one."""
        record = self.solution.symbols.record
        links = {link for own in part.directions for link in own.links}
        whole = {joint: name for name, group in record.generalised.items() for joint in group.joints}
        names = [name for name, joint in record.joints.items() if {joint.parent, joint.child} & links]
        return list(dict.fromkeys(whole.get(name, name) for name in names))

    def _elimination(self, part: SolvedSet, steps: _Steps) -> Iterator[Block]:
        if part.eliminant is not None:
            yield from self._polynomial(part, part.eliminant, steps)
            return
        if any(own.kind == "stroke" for own in part.directions):
            left_out = {own.symbol for own in steps.known} | {root.symbol for root in part.roots}
            said = {self._equation(form).latex for form in part.equations}
            lines = [self.line(own.symbol, own.formula) for own in part.definitions if own.symbol not in left_out]
            yield "and so"
            yield tuple(own for own in lines if own.latex not in said)
            return
        base, others = part.directions[0], part.directions[1:]
        vectors = rod_vectors(part)
        if part.lines:
            left = listed([f"${self.printed.angle(own)}$" for own in others])
            yield f"These are solved for {left}. {self._quadrics(others)}, ${self.printed.angle(base)}$ satisfies"
            if vectors is None:
                yield tuple(self._named_equation(form, steps) for form in part.lines)
            else:
                yield tuple(self._planes(vectors))
        if vectors is not None:
            yield "where"
            yield tuple(self._of_vectors(vectors, steps))
            yield "and so"
            yield (self._direction(vectors),)
        else:
            if steps.named:
                yield "where" if part.lines else "with"
                yield tuple(self.line(own.symbol, own.formula) for own in steps.named)
            yield "and so"
            said = {self._equation(form).latex for form in part.equations}
            lines = [self.line(own.symbol, own.formula) for own in steps.of((*base.unknowns, *steps.late))]
            yield tuple(own for own in lines if own.latex not in said)
        rest = [own for other in others for own in steps.of(other.unknowns)]
        if rest:
            yield "Back in the loop equations,"
            yield tuple(self.line(own.symbol, own.formula) for own in rest)

    def _pair(self, eliminant: PairEliminant, pair: CirclePair, steps: _Steps) -> Iterator[Block]:
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
        across = [own for own in numbered if own not in conic]
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
        yield (
            f"A line, a conic and the circle of ${last}$ meet in a point where this vanishes, "
            rf"in $t = \tan(\frac{{1}}{{2}}{base})$ a polynomial of degree {eliminant.degree}:"
        )
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
            f"${other}$ is in it by its square alone. So it is one in ${letter}$, whose degree is half of that, and "
            f"{many} {size}{tower}. Each root has two solutions, which are mirror images of each other: "
            f"${own.total.replace('x', TIMES)} = {own.count}$."
        )

    def _beside(self, unknown: sympy.Symbol) -> sympy.Symbol:
        """The sine of a cosine, and the other way."""
        circles = (own.unknowns for own in self.solution.loops.directions if unknown in own.unknowns)
        return next(own for circle in circles for own in circle if own != unknown)

    def _polynomial(self, part: SolvedSet, eliminant: AngleEliminant, steps: _Steps) -> Iterator[Block]:
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
        yield "At each of its roots"
        yield tuple(self.line(own.symbol, own.formula) for other in others for own in steps.of(other.unknowns))

    def _quadrics(self, others: Sequence[UnknownDirection]) -> str:
        """Why squares add up to 1."""
        units = [f"${self.printed.angle(own)}$" for own in others if own.kind == "rod"]
        if units:
            return f"As {listed(units)} {'is a unit vector' if len(units) == 1 else 'are unit vectors'}"
        angles = (self.printed.angle(own) for own in others)
        sums = [rf"$\cos^{{2}}{own} + \sin^{{2}}{own} = 1$" for own in angles]
        return f"As {listed(sums)}"

    @cached_property
    def flow(self) -> tuple[FlowNode, ...]:
        """What each set takes of what is given and of sets before it, what it gives; the result last."""
        owner = {symbol: k for k, part in enumerate(self.solution.sets) for own in part.directions
                 for symbol in own.unknowns}  # fmt: skip
        nodes = []
        for k, part in enumerate(self.solution.sets):
            given, before = self._sources([form for line in part.equations for form in line.values()], owner, {k})
            found = ", ".join(self.printed.angle(own) for own in part.directions)
            nodes.append(FlowNode(f"Set {k + 1}", found, given, before))
        rows = self._result().blocks[0]
        if not isinstance(rows, str):
            direct = self.solution.symbols.problem == "direct"
            ahead = [*self.solution.point] if direct else [own.formula for own in self.solution.lengths]
            given, before = self._sources(ahead, owner, set())
            nodes.append(FlowNode("", ", ".join(row.left for row in rows), given, before))
        return tuple(nodes)

    def _sources(
        self, ahead: Sequence[sympy.Expr], owner: Mapping[sympy.Symbol, int], inside: set[int]
    ) -> tuple[tuple[str, ...], tuple[int, ...]]:
        """Letters that are given and places of sets, of which formulas are worked out."""
        formulas = {own.symbol: own.formula for own in self.solution.definitions}
        dimensions = {*self.solution.symbols.parameters.values()}
        left, given, before = [*ahead], dict[str, None](), set[int]()
        while left:
            for symbol in sorted(sympy.sympify(left.pop(0)).free_symbols - dimensions, key=str):
                if symbol in owner:
                    before |= {owner[symbol]} - inside
                elif symbol in formulas:
                    left.append(formulas[symbol])
                else:
                    given[self.writer.letters[symbol].latex] = None
        order = [self.writer.letters[symbol].latex for symbol in self.solution.symbols.given]
        return tuple(own for own in dict.fromkeys(order) if own in given), tuple(sorted(before))

    def _choice(self, part: SolvedSet) -> Iterator[Block]:
        for root in part.roots:
            sign = self.printed.signs[root.symbol][0]
            radicand = self.writer.text(root.radicand)
            meaning = self.phrase(self._reach.radicands[root.radicand])
            real = f"Branches are real where ${radicand} \\ge 0$; where ${radicand} < 0$, {meaning}."
            if any(own.symbol == root.radicand and own.formula.is_Symbol for own in part.definitions):
                real = f"Every branch is real, as ${radicand}$ is a sum of squares."
            yield f"${sign} = \\pm 1$: {self._said(root)}. {real}"
        told: dict[str, list[str]] = {}
        for own in part.conditions:
            if not never_zero(own):
                free = self._free(part) if own in part.shared else ""
                same = told.setdefault(self.phrase(self._reach.condition(part, own)) + free, [])
                same += [text for text in [self._condition(own)] if text not in same]
        if told:
            texts = listed([rf"${text} {NOT_ZERO}" for same in told.values() for text in same])
            fails = "; ".join(
                f"where {listed([f'${text} = 0$' for text in same], 'or')}, {meaning}" for meaning, same in told.items()
            )
            yield f"The formulas hold where {texts}: {fails}."

    def _free(self, part: SolvedSet) -> str:
        """What follows where all of the one line vanishes: the platform moves on a curve."""
        if self.solution.symbols.problem == "inverse" or len(part.lines) > 1 or part.directions[0].kind != "circle":
            return ""
        angle = self.printed.angle(part.directions[0])
        return (
            f", so that ${angle}$ may have any value and the platform moves on a curve while every input stands, "
            "by the equations of the sets that follow"
        )

    @cached_property
    def _reach(self) -> ReachMeanings:
        return ReachMeanings(self.solution)

    def phrase(self, own: GeometricPhrase) -> str:
        """A meaning with the letters of this solution."""
        return own.written(joint_letter, self.axis)

    def _said(self, root: Root) -> str:
        meaning = self.meanings.get(root.symbol, "")
        if r"\theta_{" in meaning:
            meaning += r", $\theta_{J}$ the angle of joint $J$"
        return f"$+$ where {meaning}" if meaning else f"the sign of ${self.writer.text(root.quantity)}$"

    def _result(self) -> WrittenPart:
        direct = self.solution.symbols.problem == "direct"
        rows = tuple(self._pose() if direct else self._inputs())
        return WrittenPart("The pose" if direct else "The inputs", (rows,) if rows else (self._solved(),))

    def _pose(self) -> Iterator[WrittenFormula]:
        yield from (self.line(own.symbol, own.formula) for own in self.solution.lengths)
        for name, formula in zip("xyz", self.solution.point, strict=True):
            if name in self.solution.symbols.record.platform.pose:
                yield self.line(sympy.Symbol(name, real=True), formula)
        for name, formula in posed_entries(self.solution):
            left = ENTRIES[name] if {*ANGLES} & {*self.solution.symbols.record.platform.pose} else f"R_{{{name[1:]}}}"
            yield WrittenFormula(left, self.writer.rows(sympy.factor_terms(formula), width(left) + 2))

    def _inputs(self) -> Iterator[WrittenFormula]:
        formulas = {own.symbol: own.formula for own in self.solution.lengths}
        record = self.solution.symbols.record
        lengths = self.solution.loops.lengths
        driven = {lengths[own.coordinate.index]: own for own in record.inputs if own.coordinate.index in lengths}
        for symbol, formula in formulas.items():
            if symbol in driven:
                own = driven[symbol]
                symbol = sympy.Symbol(own.name, real=True)
                formula = int(own.sign) * formula + sympy.nsimplify(own.offset, rational=True)
            yield self.line(symbol, formula)

    def _solved(self) -> str:
        letters = listed([f"${input_letter(driven)}$" for driven in self.solution.symbols.record.inputs])
        return f"The inputs are {letters}, found above."

    def _equation(self, form: Form) -> WrittenFormula:
        """A linear equation: what is unknown on the left, what is known on the right."""
        terms = [(key, coefficient) for key, coefficient in form.items() if key != ONE]
        known = -form.get(ONE, ZERO)
        if known != 0 and self._negative(known) and all(self._negative(own * key) for key, own in terms):
            terms, known = [(key, -own) for key, own in terms], -known
        ahead = [own * key for key, own in terms if known != 0 or not self._negative(own * key)]
        behind = [-own * key for key, own in terms if known == 0 and self._negative(own * key)]
        if not ahead:
            ahead, behind = behind, []
        left = self._terms(ahead)
        right = self._terms(behind) if behind else self.writer.rows(known, min(width(left), COLUMN - 8))
        if isinstance(right, str):
            right = wrapped(right, min(width(left) + 2, COLUMN - 8))
        rows = wrapped(left)
        if len(rows) == 1 and width(left) + max(map(width, right)) < COLUMN:
            return WrittenFormula(left.replace(BREAK, " "), right)
        return WrittenFormula("0", wrapped(self._terms([*ahead, *(-own for own in (*behind, known) if own != 0)]), 3))

    def _negative(self, term: sympy.Expr) -> bool:
        plain = self.writer.displayed(term)
        return bool(plain.could_extract_minus_sign())

    def _terms(self, terms: Iterable[sympy.Expr]) -> str:
        """A sum term by term, each coefficient kept together."""
        texts = [self.writer.marked(term) for term in terms]
        positive = next((k for k, text in enumerate(texts) if not text.startswith("-")), 0)
        texts.insert(0, texts.pop(positive))
        return texts[0] + "".join(
            f"{BREAK}- {text[1:]}" if text.startswith("-") else f"{BREAK}+ {text}" for text in texts[1:]
        )

    def _named_equation(self, form: Form, steps: _Steps) -> WrittenFormula:
        """An equation with its coefficients under their names."""
        named = {key: steps.names.get(sympy.factor_terms(own), own) for key, own in form.items() if key != ONE}
        known = -form.get(ONE, ZERO)
        return self._equation({**named, ONE: -steps.names.get(sympy.factor_terms(known), known)})

    def _planes(self, vectors: RodVectors) -> Iterator[WrittenFormula]:
        for normal, share in zip(vectors.normals, vectors.shares, strict=True):
            left = rf"{self.printed.vector(normal)} \cdot {self.printed.vector(vectors.unknowns)}"
            yield WrittenFormula(left, (self.writer.text(share),))

    def _of_vectors(self, vectors: RodVectors, steps: _Steps) -> Iterator[WrittenFormula]:
        skipped = {*vectors.across}
        for own in steps.named:
            if own.symbol == vectors.across[0]:
                first, second = (self.printed.vector(normal) for normal in vectors.normals)
                yield WrittenFormula(self.printed.vector(vectors.across), (rf"{first} \times {second}",))
            if own.symbol == vectors.square:
                across = self.printed.vector(vectors.across)
                yield WrittenFormula(self.writer.text(own.symbol), (rf"{across} \cdot {across}",))
            elif own.symbol == vectors.radicand:
                yield WrittenFormula(self.writer.text(own.symbol), (self._apart(vectors),))
            elif own.symbol not in skipped:
                yield self.line(own.symbol, own.formula)

    def _apart(self, vectors: RodVectors) -> str:
        u, v = (self.printed.vector(normal) for normal in vectors.normals)
        h, k = (self.writer.text(share) for share in vectors.shares)
        return rf"{self.writer.text(vectors.square)} - |{h}\,{v} - {k}\,{u}|^{{2}}"

    def _direction(self, vectors: RodVectors) -> WrittenFormula:
        u, v = (self.printed.vector(normal) for normal in vectors.normals)
        w = self.printed.vector(vectors.across)
        h, k = (self.writer.text(share) for share in vectors.shares)
        root, square = self._terms([ZERO + vectors.root]), self.writer.text(vectors.square)
        root = f"- {root[1:]}" if root.startswith("-") else f"+ {root}"
        text = rf"\frac{{1}}{{{square}}}({h}\,{v} \times {w}{BREAK}+ {k}\,{w} \times {u}{BREAK}{root}\,{w})"
        left = self.printed.vector(vectors.unknowns)
        return WrittenFormula(left, wrapped(text, width(left) + 2))


class _Steps:
    """The definitions of a set by what they are for."""

    def __init__(self, part: SolvedSet) -> None:
        unknowns = {symbol for own in part.directions for symbol in own.unknowns}
        used = {symbol for form in part.equations for own in form.values() for symbol in own.free_symbols}
        roots = {root.symbol for root in part.roots}
        self.definitions = part.definitions
        self.known = [own for own in part.definitions if own.symbol in used and own.symbol not in unknowns]
        named = [own for own in part.definitions if own.symbol not in {*used, *unknowns, *roots}]
        self.named = [own for own in named if not own.formula.free_symbols & unknowns]
        self.late = [own.symbol for own in named if own not in self.named]
        self.names = {own.formula: own.symbol for own in self.named}

    def of(self, unknowns: Sequence[sympy.Symbol]) -> list[Definition]:
        """What defines these."""
        return [own for own in self.definitions if own.symbol in unknowns]
