"""A derivation for print: its problems with their letters, the names of signs, and branches in numbers."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.joint_formulas import Pointing
from assur.derivation.letters_of_names import input_letter, plain_with_joints, sign_formula
from assur.derivation.mode_signs import RootSigns, matched_signs
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.numeric_example import ExampleBranch, angle, example_branches
from assur.derivation.platform_rotation import platform_rotation
from assur.derivation.printed_letters import PrintedLetters
from assur.derivation.printed_velocities import PrintedVelocities, printed_velocities
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.derivation.symbols import circle_of
from assur.derivation.written_solution import WrittenSolution
from assur.kinematics.modes import Problem
from assur.kinematics.naming import described_signs
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION
from assur.numerics.rotations import to_angles, to_quaternion
from assur.results.latex_text import letter

SIGN: Mapping[Problem, str] = {"direct": r"\epsilon", "inverse": r"\sigma"}
DECIMALS = 4


@dataclass(frozen=True)
class PrintedValue:
    """A number of an example: its letter in LaTeX, its value in the file's unit, the unit."""

    latex: str
    value: float
    unit: str

    @property
    def number(self) -> str:
        """With four decimals.

        >>> PrintedValue("x", -0.00001, "mm").number
        '0.0000'
        """
        return f"{self.value:.{DECIMALS}f}".replace("-0.0000", "0.0000") if abs(self.value) < 1 else (
            f"{self.value:.{DECIMALS}f}"
        )  # fmt: skip


@dataclass(frozen=True)
class PrintedBranch:
    """A branch of the example: its mode, and its values; without any the radicand, in LaTeX, that is negative."""

    mode: str
    values: tuple[PrintedValue, ...]
    negative: str = ""


@dataclass(frozen=True)
class PrintedExample:
    """A problem in numbers: what is given, and all branches."""

    given: tuple[PrintedValue, ...]
    branches: tuple[PrintedBranch, ...]


@dataclass(frozen=True, eq=False)
class PrintedProblem:
    """One problem that was solved.

    Attributes:
        written: its formulas.
        example: at home's inputs or pose, to four decimals.
        closes: whether every branch closes every loop, modulo a prime.
        order: places of the roots among the signs of a mode; their own order where the signs have no names.
    """

    problem: Problem
    written: WrittenSolution
    example: PrintedExample
    closes: bool
    order: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class PrintedDerivation:
    """What is printed of a mechanism; `why` has the problems that were not solved, and what resists.

    `velocities` follow of the inverse problem, where they do.
    """

    record: MechanismRecord
    problems: tuple[PrintedProblem, ...]
    why: Mapping[Problem, str]
    velocities: PrintedVelocities | None = None


def printed_derivation(
    record: MechanismRecord, solutions: Mapping[Problem, AnalyticSolution], why: Mapping[Problem, str]
) -> PrintedDerivation:
    """The problems of a mechanism for print.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> own = printed_derivation(record, {"direct": analytic_solution(record, "direct")}, {})
    >>> [branch.mode for branch in own.problems[0].example.branches]
    ['+', '-']
    """
    signs = _signs(record, solutions)
    printed = [_Problem(record, problem, solution, signs).printed() for problem, solution in solutions.items()]
    velocities = None
    with contextlib.suppress(NotDerivedError):
        velocities = next((printed_velocities(own.written) for own in printed if own.problem == "inverse"), None)
    return PrintedDerivation(record, tuple(printed), why, velocities)


def _signs(record: MechanismRecord, solutions: Mapping[Problem, AnalyticSolution]) -> RootSigns:
    """Names of the roots' signs, as far as both problems give them; a problem alone asks for the other one.

    A root whose sign is a product of several has none: in print it is the sign of what the root is of.
    """
    whole = dict(solutions)
    others: tuple[Problem, ...] = ("direct", "inverse")
    try:
        for problem in others:
            if problem not in whole:
                whole[problem] = analytic_solution(record, problem)
        matched = matched_signs(whole["direct"], whole["inverse"])
        return {root: own for root, own in matched.roots.items() if root not in matched.products and own[0]}
    except NotDerivedError:
        return {}


@dataclass(frozen=True, eq=False)
class _Problem:
    record: MechanismRecord
    problem: Problem
    solution: AnalyticSolution
    signs: RootSigns

    def printed(self) -> PrintedProblem:
        letters = PrintedLetters(self.solution, self._letters)
        written = WrittenSolution(self.solution, letters, self._meanings)
        return PrintedProblem(self.problem, written, self._example(written), self.solution.closes(), tuple(self._order))

    @cached_property
    def _order(self) -> list[int]:
        """Place of each root's sign in a mode."""
        names = [sign.name for sign in described_signs(self.record, self.problem)]
        own = [self.signs.get((self.problem, root.symbol), ("", 1))[0] for root in self.solution.roots]
        return [names.index(name) for name in own] if all(name in names for name in own) else [*range(len(own))]

    @property
    def _letters(self) -> dict[sympy.Symbol, tuple[str, int]]:
        return {
            root.symbol: (
                f"{SIGN[self.problem]}_{{{place + 1}}}",
                self.signs.get((self.problem, root.symbol), ("", 1))[1],
            )
            for root, place in zip(self.solution.roots, self._order, strict=True)
        }

    @property
    def _meanings(self) -> dict[sympy.Symbol, str]:
        letters = {name: letter(name) for name in (*self.record.parameters, *self.record.angles)}
        letters |= {coordinate.joint: letter(name) for name, coordinate in self.record.angles.items()}
        said = {
            sign.name: f"${sign_formula(sign.meaning, letters)}$"
            if sign.written
            else plain_with_joints(sign.meaning, self.record.joints)
            for sign in described_signs(self.record, self.problem)
        }
        return {
            root.symbol: said[name]
            for root in self.solution.roots
            for name, _ in [self.signs.get((self.problem, root.symbol), ("", 1))]
            if name
        }

    def _example(self, written: WrittenSolution) -> PrintedExample:
        home = self.solution.symbols.witness.home
        values = {symbol: float(home[symbol]) for symbol in self.solution.symbols.parameters.values()}
        given = []
        for name, latex, is_angle in self._asked:
            number = angle(home, name) if is_angle else float(home[sympy.Symbol(name, real=True)])
            own = PrintedValue(latex, round(self._border(number, is_angle), DECIMALS), self._unit(is_angle))
            number = math.radians(own.value) if is_angle and self.record.angle == "deg" else own.value
            given.append(own)
            if is_angle:
                values |= dict(zip(circle_of(name), (math.cos(number), math.sin(number)), strict=True))
            else:
                values[sympy.Symbol(name, real=True)] = number
        senses = [self._letters[root.symbol][1] for root in self.solution.roots]
        branches = example_branches(self.solution, values, senses)
        rows = sorted((self._branch(written, own) for own in branches), key=lambda own: own.mode)
        return PrintedExample(tuple(given), tuple(rows))

    def _branch(self, written: WrittenSolution, branch: ExampleBranch) -> PrintedBranch:
        signs = sorted(zip(self._order, branch.signs, strict=True))
        mode = "".join("+" if sign > 0 else "-" for _, sign in signs)
        mode = f"{branch.root} {mode}".strip() if branch.root else mode
        if branch.negative is not None:
            return PrintedBranch(mode, (), written.writer.text(branch.negative))
        parts, values = {*map(letter, QUATERNION)}, list[PrintedValue]()
        for latex, is_angle, of in self._results:
            unit = "" if latex in parts else self._unit(is_angle)
            values.append(PrintedValue(latex, self._border(of(branch.values), is_angle), unit))
        return PrintedBranch(mode, tuple(values))

    @property
    def _asked(self) -> Iterator[tuple[str, str, bool]]:
        """Name, letter, and whether it is an angle, of what is given."""
        if self.problem == "direct":
            for driven in self.record.inputs:
                yield driven.name, input_letter(driven), driven.coordinate.kind == "angle"
        else:
            for name in self.record.platform.pose:
                yield name, letter(name), name in ANGLES

    @cached_property
    def _results(self) -> list[tuple[str, bool, Callable[[Mapping[sympy.Symbol, float]], float]]]:
        """Letter, whether it is an angle, and its value."""
        if self.problem == "inverse":
            formulas = ClosedFormFormulas(self.solution, self.solution, {})
            pairs, rods = formulas.input_pairs, formulas.joints.pointings
            names = [input_letter(driven) for driven in self.record.inputs]
            return [
                (name, isinstance(pair, tuple), _valued(pair, rods)) for name, pair in zip(names, pairs, strict=True)
            ]
        place = dict(zip("xyz", self.solution.point, strict=True))
        turned = _turned(self.solution) if {*self.record.platform.pose} - {*place} else None
        return [
            (letter(name), name in ANGLES, _valued(place[name]) if turned is None or name in place else turned(name))
            for name in self.record.platform.pose
        ]

    def _border(self, value: float, is_angle: bool) -> float:
        return math.degrees(value) if is_angle and self.record.angle == "deg" else value

    def _unit(self, is_angle: bool) -> str:
        return self.record.angle if is_angle else self.record.unit


def _turned(solution: AnalyticSolution) -> Callable[[str], Callable[[Mapping[sympy.Symbol, float]], float]]:
    """Name of a coordinate of the platform's orientation -> what it is at values of the unknowns."""
    entries = [_valued(sympy.sympify(entry)) for row in platform_rotation(solution) for entry in row]

    def coordinates(values: Mapping[sympy.Symbol, float]) -> dict[str, float]:
        rotation = np.array([entry(values) for entry in entries]).reshape(3, 3)
        named = dict(zip(ANGLES, map(float, to_angles(rotation)), strict=True))
        return named | dict(zip(QUATERNION, map(float, to_quaternion(rotation)), strict=True))

    return lambda name: lambda values: coordinates(values)[name]


def _valued(
    pair: sympy.Expr | tuple[sympy.Expr, sympy.Expr], rods: Sequence[Pointing] = ()
) -> Callable[[Mapping[sympy.Symbol, float]], float]:
    """What a formula, or the angle of a cosine and a sine, is at values of the unknowns and of how rods point."""
    parts = pair if isinstance(pair, tuple) else (pair,)
    arguments = sorted({symbol for part in parts for symbol in sympy.sympify(part).free_symbols}, key=str)
    formulas = [sympy.lambdify(arguments, part, "math") for part in parts]
    used = [rod for rod in rods if {*arguments} & {*rod.carrier, *rod.hinge}]

    def value(values: Mapping[sympy.Symbol, float]) -> float:
        whole = {**values}
        for rod in used:
            whole |= rod.at(values)
        numbers = [float(formula(*(whole[own] for own in arguments))) for formula in formulas]
        return math.atan2(numbers[1], numbers[0]) if len(numbers) == 2 else numbers[0]

    return value
