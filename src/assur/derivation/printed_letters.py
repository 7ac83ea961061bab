"""The letters of a derivation: the file's where it has some, else by role, with what each means."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.formula_latex import FormulaLatex, PrintedLetter
from assur.derivation.letters_of_names import defined, input_letter, joint_letter, kind_of
from assur.derivation.phrases import direction as direction_text
from assur.derivation.phrases import listed, words
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.unknown_directions import UnknownDirection
from assur.kinematics.home import home_values
from assur.model.mechanism import Coordinate
from assur.model.pose import ANGLES
from assur.results.latex_text import letter

TURNS = (r"\theta", r"\varphi", r"\psi", r"\chi", r"\omega", r"\eta", r"\zeta")
"""Letters for angles of which the file names none: one for each kind of link, its number as index."""
RODS = ("d", "f", "g", "n", "m", "p")
"""The same for directions of rods."""
VECTORS = ("rod", "side")
STROKES = ("v", "u", "w", "e")
"""For vectors with a length in them."""
ROOTS = ("g", "k", "p", "q", "f")
"""And for roots of sums of dimensions."""
SAME = 1e-9
"""Angles at home that are one, to rounding."""


@dataclass(frozen=True)
class Nomenclature:
    """A line of a list of symbols: the letter in LaTeX, its meaning in words, its unit."""

    latex: str
    meaning: str
    unit: str


@dataclass(frozen=True, eq=False)
class PrintedLetters:
    """How the symbols of a solution are printed.

    Attributes:
        solution: whose symbols they are.
        signs: root -> letter of its sign in LaTeX, and whether the root has that sign or its opposite.
    """

    solution: AnalyticSolution
    signs: Mapping[sympy.Symbol, tuple[str, int]]

    @cached_property
    def letters(self) -> dict[sympy.Symbol, PrintedLetter]:
        """Symbol -> its letter."""
        own = {symbol: PrintedLetter(letter(name), rank=1) for name, symbol in self.solution.symbols.parameters.items()}
        record = self.solution.symbols.record
        for driven in record.inputs:
            own |= _of_angle(driven.name, input_letter(driven))
            own[sympy.Symbol(driven.name, real=True)] = PrintedLetter(input_letter(driven))
        for coordinate in record.platform.pose:
            own |= _of_angle(coordinate, letter(coordinate))
            own[sympy.Symbol(coordinate, real=True)] = PrintedLetter(letter(coordinate))
        plain_inputs = {
            driven.coordinate.index: driven for driven in record.inputs if driven.sign == 1 and not driven.offset
        }
        for index, symbol in self.solution.loops.lengths.items():
            if index in plain_inputs:
                own[symbol] = PrintedLetter(input_letter(plain_inputs[index]))
                continue
            own[symbol] = PrintedLetter(f"s_{{{joint_letter(symbol.name.removeprefix('q_').replace('_', '.'))}}}")
        for unknown in self.solution.loops.directions:
            own |= self._of_direction(unknown)
        for part in self.solution.sets:
            for unknown in part.directions:
                if unknown.kind == "stroke":
                    own |= self._of_stroke(unknown)
        own |= {root: PrintedLetter(root.name, rank=1) for root in self.radicals.values()}
        for definition in self.solution.definitions:
            own.setdefault(definition.symbol, PrintedLetter(defined(definition.symbol.name)))
        for root in self.solution.roots:
            sign, sense = self.signs[root.symbol]
            radicand = own[root.radicand].latex
            own[root.symbol] = PrintedLetter(rf"{sign}\sqrt{{{radicand}}}", sense=sense, rank=3)
        return own

    @cached_property
    def radicals(self) -> dict[sympy.Expr, sympy.Symbol]:
        """Sum of dimensions under a root -> the letter by which the root is called."""
        dimensions = {*self.solution.symbols.parameters.values()}
        roots = {
            power.base
            for formula in self._formulas
            for power in formula.atoms(sympy.Pow)
            if power.base.is_Add and power.exp.is_Rational and power.exp.q == 2
            and power.base.free_symbols and power.base.free_symbols <= dimensions
        }  # fmt: skip
        free = (own for own in ROOTS if own not in self._taken)
        return {
            radicand: sympy.Symbol(own, positive=True)
            for own, radicand in zip(free, sorted(roots, key=str), strict=False)
        }

    @cached_property
    def nomenclature(self) -> tuple[Nomenclature, ...]:
        """Dimensions, what is given and what is sought, in the file's words."""
        return tuple(self._nomenclature())

    @property
    def relations(self) -> tuple[str, ...]:
        """Dimensions as what others say that they are, as equations."""
        writer = FormulaLatex(self.letters)
        every = self.solution.loops.relations
        return tuple(f"${self.letters[own.symbol].latex} = {writer.text(own.formula)}$" for own in every)

    def angle(self, unknown: UnknownDirection) -> str:
        """What is unknown of a link, as one letter: its angle, or the components of a direction."""
        first = self.letters[unknown.unknowns[0]]
        if first.function:
            return first.latex
        return self.vector(unknown.unknowns)

    def vector(self, parts: Sequence[sympy.Expr]) -> str:
        """A vector in bold, by the letters of its parts; a row of these where they have no letter in common."""
        texts = [self.letters[part].latex if part in self.letters else sympy.latex(part) for part in parts]
        if all(text.endswith(f"{axis}}}") for text, axis in zip(texts, "xyz"[: len(texts)], strict=True)):
            stem, _, index = texts[0].partition("_")
            return rf"\mathbf{{{stem}}}_{{{index.strip('{}')[:-1]}}}".removesuffix("_{}")
        return f"({', '.join(texts)})"

    def _nomenclature(self) -> Iterator[Nomenclature]:
        record = self.solution.symbols.record
        used = self._used
        for name, parameter in record.parameters.items():
            symbol = self.solution.symbols.parameters[name]
            if symbol in used:
                unit = "" if parameter.unit == "1" else parameter.unit
                yield Nomenclature(self.letters[symbol].latex, parameter.meaning, unit)
        for driven in record.inputs:
            unit = record.angle if driven.coordinate.kind == "angle" else record.unit
            yield Nomenclature(input_letter(driven), f"input, ${joint_letter(driven.coordinate.joint)}$", unit)
        plain_writer = FormulaLatex(self.letters)
        for radicand, root in self.radicals.items():
            yield Nomenclature(rf"{root.name} = {plain_writer.text(sympy.sqrt(radicand))}", "for short", "")
        posed = ", ".join(letter(name) for name in record.platform.pose)
        units = dict.fromkeys(record.angle if name in ANGLES else record.unit for name in record.platform.pose)
        yield Nomenclature(posed, f"pose of {words(record.platform.link)}", ", ".join(units))
        for unknown in self.solution.loops.directions:
            links = listed(list(dict.fromkeys(words(link) for link in unknown.links if "'" not in link)))
            own = self.solution.placed.links[unknown.links[0]]
            axis = f"${direction_text(own.axis)}$" if own.axis and len(direction_text(own.axis)) == 1 else "its axis"
            if unknown.kind == "rod":
                parts = ", ".join(self.letters[symbol].latex for symbol in unknown.unknowns)
                yield Nomenclature(f"{self.angle(unknown)} = ({parts})", f"direction of {links}, a unit vector", "")
            elif unknown.kind == "side" and own.triangle is not None:
                start, end = map(joint_letter, own.triangle.ends(unknown.name[-2:]))
                yield Nomenclature(self.angle(unknown), f"vector from ${start}$ to ${end}$, on {links}", record.unit)
            elif own.axis is not None and self._named(unknown) is None:
                yield Nomenclature(self.angle(unknown), f"angle of {links} about {axis}", record.angle)
            elif self._named(unknown) is not None and self.angle(unknown) not in self._given:
                yield Nomenclature(self.angle(unknown), f"angle of {links}", record.angle)

    @cached_property
    def _given(self) -> set[str]:
        record = self.solution.symbols.record
        return {input_letter(driven) for driven in record.inputs} | {letter(name) for name in record.platform.pose}

    @cached_property
    def _formulas(self) -> list[sympy.Expr]:
        formulas = [own.formula for own in self.solution.definitions]
        formulas += [
            part for own in self.solution.sets for form in (*own.equations, *own.lines) for part in form.values()
        ]
        return [sympy.sympify(formula) for formula in (*formulas, *self.solution.point)]

    @property
    def _used(self) -> set[sympy.Symbol]:
        used = {symbol for formula in self._formulas for symbol in formula.free_symbols}
        every = self.solution.loops.relations
        return used.union(*({own.symbol, *own.formula.free_symbols} for own in every))

    def _of_direction(self, unknown: UnknownDirection) -> dict[sympy.Symbol, PrintedLetter]:
        if unknown.kind in VECTORS:
            stem = self._letter(unknown, RODS)
            base, _, index = stem.partition("_")
            inside = index.strip("{}")
            return {
                symbol: PrintedLetter(f"{base}_{{{inside}{axis}}}", rank=5)
                for symbol, axis in zip(unknown.unknowns, "xyz", strict=True)
            }
        named = self._named(unknown)
        latex, sense = named or (self._letter(unknown, TURNS), 1)
        cosine, sine = unknown.unknowns
        return {cosine: PrintedLetter(latex, "cos", rank=5), sine: PrintedLetter(latex, "sin", sense, rank=5)}

    def _of_stroke(self, unknown: UnknownDirection) -> dict[sympy.Symbol, PrintedLetter]:
        """The components of a vector with a length in it, by the number of its set."""
        free = next(own for own in STROKES if own not in self._taken)
        number = next(k for k, part in enumerate(self.solution.sets, start=1) if unknown in part.directions)
        several = [own for own in self.solution.sets[number - 1].directions if own.kind == "stroke"]
        index = f"{number}" if len(several) == 1 else f"{number}{'abcdefgh'[several.index(unknown)]}"
        return {
            symbol: PrintedLetter(f"{free}_{{{index}{axis}}}", rank=5)
            for symbol, axis in zip(unknown.unknowns, "xyz"[: len(unknown.unknowns)], strict=True)
        }

    def _named(self, unknown: UnknownDirection) -> tuple[str, int] | None:
        """The file's letter of the angle by which a link turns against what does not turn, and its sense."""
        record, placed = self.solution.symbols.record, self.solution.placed.links
        level = record.platform.link in unknown.links and placed[record.platform.link].second is None
        if level and "phi" in record.platform.pose:
            return letter("phi"), 1
        names = [(input_letter(driven), driven.coordinate) for driven in record.inputs if not driven.offset]
        names += [(letter(name), coordinate) for name, coordinate in record.angles.items()]
        for latex, coordinate in names:
            joint = record.joints[coordinate.joint]
            before = placed[joint.parent]
            if joint.child in unknown.links and before.axis is None and before.rod is None and joint.type.turns == 1:
                sense = self._sense(unknown, coordinate)
                if sense:
                    return latex, sense
        return None

    def _sense(self, unknown: UnknownDirection, coordinate: Coordinate) -> int:
        """Whether a joint's angle is that of an unknown, or its opposite: as they are at home, and by their axes."""
        record, symbols = self.solution.symbols.record, self.solution.symbols
        axis = self.solution.placed.links[record.joints[coordinate.joint].child].axis
        own = symbols.geometry.joints[coordinate.joint].axes[0]
        home = symbols.witness.home
        cosine, sine = (home[symbol] for symbol in unknown.unknowns)
        value = float(home_values(record)[coordinate.index])
        for sense in (1, -1):
            along = axis is not None and all(
                symbols.witness.is_zero(sympy.sympify(first) - sense * second)
                for first, second in zip(axis, own, strict=True)
            )
            if along and math.hypot(cosine - math.cos(value), sine - sense * math.sin(value)) < SAME:
                return sense
        return 0

    def _letter(self, unknown: UnknownDirection, letters: tuple[str, ...]) -> str:
        """A letter for the kind of link, with its number as index."""
        kinds = list(dict.fromkeys(kind_of(other.name)[0] for other in self._unnamed(unknown.kind)))
        kind, number = kind_of(unknown.name)
        same = [other.name for other in self._unnamed(unknown.kind) if kind_of(other.name) == (kind, number)]
        free = [own for own in letters if own not in self._taken]
        place = kinds.index(kind)
        if place >= len(free) or len(same) > 1:
            return rf"{free[0]}_{{\mathrm{{{unknown.name.replace('_', ' ')}}}}}"
        return f"{free[place]}_{{{number}}}" if number else free[place]

    def _unnamed(self, kind: str) -> list[UnknownDirection]:
        return [
            own
            for own in self.solution.loops.directions
            if own.kind == kind and (kind in VECTORS or self._named(own) is None)
        ]

    @cached_property
    def _taken(self) -> set[str]:
        """Letters of the file, without index."""
        record = self.solution.symbols.record
        names = [letter(name) for name in (*record.parameters, *record.angles, *record.platform.pose)]
        return {name.partition("_")[0] for name in (*names, *(input_letter(driven) for driven in record.inputs))}


def _of_angle(name: str, latex: str) -> dict[sympy.Symbol, PrintedLetter]:
    cosine, sine = circle_of(name)
    return {cosine: PrintedLetter(latex, "cos", rank=5), sine: PrintedLetter(latex, "sin", rank=5)}
