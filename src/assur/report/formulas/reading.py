"""Reading a closed form: its kernels run over recorded numbers, and what they compute written line by line.

Every letter that the closed form names (results, quantities of the source, attributes of `core`) stands for
its formula wherever it turns up, so that each line is short. The lines are what the kernels compute, nothing
is written down by hand.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import branch_kernel, closed_form_of
from assur.model.closed_form import Branch
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.report.formulas.latex import name_mathml
from assur.report.formulas.letters import (
    Named,
    Number,
    core_letters,
    is_rotation,
    letters_of,
    margin_letter,
    parts_of,
    varies,
)
from assur.report.formulas.shorthand import shorthand
from assur.report.formulas.trace import (
    POINTS,
    Book,
    Letter,
    Traced,
    Tracing,
    Values,
    leaf,
    number,
)

SEED = 17


@dataclass(frozen=True)
class FormulaLine:
    """letter = term, with the number that the formula has in the source and what the letter means."""

    letter: Letter
    term: Traced
    equation: str = ""
    meaning: str = ""


@dataclass(frozen=True, eq=False)
class FormulaReading:
    """A closed form as it was read for one problem.

    Attributes:
        lines: the formulas from the given numbers to the results, to every joint's value and to the entries of jp and
            jq, in the order in which the kernel meets them; rotations of spherical joints are left out. A letter that
            only serves to keep other lines short (`assur.report.formulas.shorthand`) stands before what needs it.
        named: quantities that the source names besides.
        margins: margin -> its formula.
        jp, jq: rows of recorded formulas with Jp v = Jq qdot.
    """

    lines: tuple[FormulaLine, ...]
    named: tuple[FormulaLine, ...]
    margins: Mapping[str, Traced]
    jp: tuple[tuple[Traced, ...], ...]
    jq: tuple[tuple[Traced, ...], ...]


def reading(record: MechanismRecord, problem: Problem) -> FormulaReading:
    """The formulas of the direct or the inverse problem.

    Example: Eq. (18) of Zeng et al. 2019 and what follows from it: cos alpha, sin alpha and the height of C1.

    >>> from assur.model.registry import load_record
    >>> from assur.report.formulas.normal import text
    >>> lines = reading(load_record("zeng2019"), "inverse").lines
    >>> [text(line.term) for line in lines if line.letter.name in ("alpha", "zC1")]
    ['(x + b - d)/l4', 's_alpha sqrt(1 - (cos alpha)^2)', 'z - l4 sin alpha']
    """
    reader = _Reader(record, problem)
    first = reader.run(Book())
    everything = reader.run(Book(known=reader.known(first, first.branch.margins)))
    used = Counter(letter for term in everything.book.met.values() for letter in _leaves(term))
    # a radicand that is needed once is written where it is needed
    shared = [name for name in first.branch.margins if used[margin_letter(name)] > 1]
    return reader.written(reader.run(Book(known=reader.known(first, shared))))


@dataclass(frozen=True, eq=False)
class _Run:
    """One run of the kernels."""

    book: Book
    branch: Branch
    joints: Mapping[str, Number]
    quantities: Mapping[str, Number]
    jacobians: tuple[Any, Any]


@dataclass(frozen=True, eq=False)
class _Reader:
    record: MechanismRecord
    problem: Problem
    points: dict[str, Values] = field(default_factory=dict)

    def run(self, book: Book) -> _Run:
        """Run every kernel of the problem with the letters of a book."""
        form, ns = closed_form_of(self.record), Tracing(book)
        p = SimpleNamespace(
            **{
                name: self._given(book, letters_of(name, "", self.record.parameters[name].angular))
                for name in self.record.parameters
            }
        )
        given = tuple(self._given(book, letters) for letters in self._coordinates(self.problem))
        kernel = branch_kernel(self.record) if self.problem == "direct" else form.inverse
        branch = kernel(ns, p, given, self._signs(book))
        jacobians = form.jacobians(ns, p, branch.core)
        joints = form.joints(ns, p, branch.core)
        quantities = form.quantities(ns, p, branch.core) if form.quantities else {}
        return _Run(book, branch, joints, quantities, jacobians)

    def known(self, run: _Run, margins: Iterable[str]) -> list[tuple[Letter, Values]]:
        """Letters with their values: results, quantities of the source, core, margins, in this order."""
        results = run.branch.pose if self.problem == "direct" else run.branch.inputs
        other: Problem = "inverse" if self.problem == "direct" else "direct"
        named: list[Named] = []
        for letters, value in zip(self._coordinates(other), results, strict=True):
            named += zip(letters, value if len(letters) > 1 else (value,), strict=True)
        for quantity in closed_form_of(self.record).quantity_list:
            value = run.quantities[quantity.name]
            named += zip(
                letters_of(quantity.name, quantity.latex, isinstance(value, tuple)), parts_of(value), strict=True
            )
        named += core_letters("", (), run.branch.core)
        named += [(margin_letter(name), run.branch.margins[name]) for name in margins]
        varying: dict[str, tuple[Letter, Values]] = {}
        for letter, part in named:
            if varies(part):
                varying.setdefault(f"{letter.function} {letter.mathml}", (letter, part.values))
        return list(varying.values())

    def written(self, run: _Run) -> FormulaReading:
        """The lines of a run."""
        met = run.book.met
        results = run.branch.pose if self.problem == "direct" else run.branch.inputs
        actuated = {self.record.coordinate_label(actuated_input.coordinate) for actuated_input in self.record.inputs}
        passive = [value for name, value in run.joints.items() if name not in actuated and not is_rotation(value)]
        jp, jq = (_rows(run.book, rows) for rows in run.jacobians)
        needed = _needed(met, [*results, *passive, *jp, *jq])
        named = list(self._named(run, needed))
        entries = [entry for row in (*jp, *jq) for entry in row]
        terms = [met[letter] for letter in met if letter in needed] + [line.term for line in named] + entries
        brief = shorthand(terms, [*self.points, *sign_names(self.record, self.problem), *(key.name for key in met)])
        lines: list[FormulaLine] = []

        def short(term: Traced) -> Traced:
            written = brief.short(term)
            lines.extend(FormulaLine(letter, definition) for letter, definition in brief.taken())
            return written

        for letter in met:
            if letter in needed:
                term = short(met[letter])
                lines.append(self._line(letter, term))
        margins = {name: short(_formula(met, name, value)) for name, value in run.branch.margins.items()}
        named = [replace(line, term=short(line.term)) for line in named]
        jp, jq = (tuple(tuple(map(short, row)) for row in rows) for rows in (jp, jq))
        return FormulaReading(tuple(lines), tuple(named), margins, jp, jq)

    def _named(self, run: _Run, written: set[Letter]) -> Iterable[FormulaLine]:
        """Quantities of the source that no line has yet."""
        for quantity in closed_form_of(self.record).quantity_list:
            value = run.quantities[quantity.name]
            letters = letters_of(quantity.name, quantity.latex, isinstance(value, tuple))
            for letter, part in zip(letters, parts_of(value), strict=True):
                if letter not in written:
                    yield self._line(letter, run.book.met.get(letter, part))

    def _line(self, letter: Letter, term: Traced) -> FormulaLine:
        form = closed_form_of(self.record)
        for quantity in form.quantity_list:
            if quantity.name == letter.name:
                return FormulaLine(letter, term, quantity.equation, quantity.meaning)
        return FormulaLine(letter, term, form.sources.get(letter.name, ""), self._meaning(letter))

    def _meaning(self, letter: Letter) -> str:
        """What a result or a margin means."""
        other: Problem = "inverse" if self.problem == "direct" else "direct"
        if any(letter in letters for letters in self._coordinates(other)):
            return "result"
        form = closed_form_of(self.record)
        for margin in form.direct_margins if self.problem == "direct" else form.inverse_margins:
            if margin_letter(margin.name) == letter:
                return f"{'zero' if margin.zero == 'degenerate' else 'negative'}: {margin.meaning}"
        return ""

    def _coordinates(self, problem: Problem) -> list[tuple[Letter, ...]]:
        """Letters of what a problem is given: of inputs, or of the coordinates of the pose."""
        if problem == "direct":
            return [
                letters_of(actuated.name, actuated.latex, actuated.coordinate.kind == "angle")
                for actuated in self.record.inputs
            ]
        return [letters_of(name, "", is_angle(name)) for name in self.record.platform.pose]

    def _given(self, book: Book, letters: tuple[Letter, ...]) -> Number:
        values = self._at(letters[0].name)
        if len(letters) == 1:
            return leaf(book, letters[0], values)
        return leaf(book, letters[0], np.cos(values)), leaf(book, letters[1], np.sin(values))

    def _signs(self, book: Book) -> SimpleNamespace:
        """Signs +1 and -1, each in a pattern of its own over the random points."""
        form = closed_form_of(self.record)
        signs = {}
        for place, name in enumerate(sign_names(self.record, self.problem), start=1):
            values = np.array([-1.0 if place >> bit & 1 else 1.0 for bit in range(POINTS)])
            itself = form.signs[name].attribute == name
            signs[name] = leaf(book, Letter(name, name_mathml(name), "sgn" if itself else ""), values)
        return SimpleNamespace(**signs)

    def _at(self, name: str) -> Values:
        """Random complex values of a given number, the same in every run."""
        if name not in self.points:
            rng = np.random.default_rng([SEED, len(self.points)])
            self.points[name] = rng.uniform(0.5, 1.5, POINTS) + 1j * rng.uniform(-0.5, 0.5, POINTS)
        return self.points[name]


def _formula(met: Mapping[Letter, Traced], name: str, value: Traced) -> Traced:
    """Of a margin: what its letter stands for, or the formula itself where it has none."""
    return met.get(margin_letter(name), value)


def _rows(book: Book, rows: Any) -> tuple[tuple[Traced, ...], ...]:
    return tuple(tuple(entry if isinstance(entry, Traced) else number(book, entry) for entry in row) for row in rows)


def _leaves(term: Traced) -> Iterable[Letter]:
    """The letters of a formula, each as often as it stands there."""
    if term.letter is not None:
        yield term.letter
    for part in term.parts:
        yield from _leaves(part)


def _needed(met: Mapping[Letter, Traced], results: Iterable[Number]) -> set[Letter]:
    """The letters that lead to results."""
    pending = [term for value in results for term in parts_of(value)]
    needed: set[Letter] = set()
    while pending:
        for letter in _leaves(pending.pop()):
            if letter in met and letter not in needed:
                needed.add(letter)
                pending.append(met[letter])
    return needed
