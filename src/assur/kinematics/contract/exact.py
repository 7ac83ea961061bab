"""The formulas of a closed form held against the joint graph in exact arithmetic, everywhere at once.

Dimensions and poses, or inputs, are drawn from a prime field; see `assur.numerics.residues`. What holds there is an
identity of formulas, but for an error whose probability the degrees of the formulas bound.
"""

from __future__ import annotations

import math
import secrets
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import MechanismFileError
from assur.kinematics.contract.claims import DrawnProblem, Rates, Vanishing
from assur.kinematics.contract.free_signs import taken_over
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.modes import Problem
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.degrees import Degree, Degrees
from assur.numerics.prime_field import LARGE, PrimeField
from assur.numerics.residues import Draws, Residues, inverted
from assur.work import stage

IntArray = NDArray[np.int64]
DRAWS, MOST_DRAWS = 64, 4096
"""Dozens show which radicands are tied; a root of a root exists at half of them, so that many are drawn if few stay."""
SOUND = 20
"""So many are to stay."""
AGAIN = 48
"""So often at most they are drawn for each problem, with another prime each time, until the error is small enough and
each choice of a mode's signs was met."""
ENOUGH = 1e-24
"""An error that is small enough."""
TIED = "the root of a formula's square has either sign: write the formula itself, where its sign is known"
SURE = 1e-15
"""An error with a probability below this is none."""


@dataclass(frozen=True)
class Exactness:
    """What exact arithmetic says of a closed form.

    Attributes:
        mismatches: what does not hold, of the first claim that is broken.
        error: bound on the probability that something does not hold and was not seen.
        general: whether it holds with any dimensions.
        guarded: whether numbers like 1e-30 that keep divisors from being zero were left out.
        undecided: why nothing is said, if so.
        primes: modulo which it was looked at, one for each problem and repetition.
        places: at how many draws in all.
        degree: the largest of a polynomial that must vanish.
    """

    mismatches: tuple[Mismatch, ...] = ()
    error: float = 0.0
    general: bool = True
    guarded: bool = False
    undecided: str = ""
    primes: tuple[int, ...] = ()
    places: int = 0
    degree: float = 0.0

    @property
    def proved(self) -> bool:
        """Whether everything holds, but for an error that is none."""
        return not self.mismatches and not self.undecided

    @property
    def text(self) -> str:
        """What is said of the formulas."""
        if not self.proved:
            return f"{self.claim}: {self.undecided or self.mismatches[0].observed}"
        guards = "exact but where numbers below 1e-25 that are added to others count" if self.guarded else "exact"
        return self.claim.replace("exact", guards)

    @property
    def claim(self) -> str:
        """The same without what was left out, and without a reason: what certificates say."""
        if not self.proved:
            return "the formulas were held at places only, not in exact arithmetic"
        special = "" if self.general else "with these dimensions "
        return f"{special}the formulas close the joint graph: exact, error < 1e-15"


@lru_cache(maxsize=64)
@stage("closed form in exact arithmetic")
def exactness(record: MechanismRecord, most: int = AGAIN) -> Exactness:
    """Whether the formulas close the joint graph, with any dimensions or with those of the record.

    Args:
        record: with a closed form.
        most: so many primes at most for each problem; few show what is wrong, and may prove nothing.

    >>> from assur.model.registry import load_record
    >>> exactness(load_record("fivebar")).proved
    True
    """
    return _exactness(record, problems_by_formulas(record), most)


@lru_cache(maxsize=64)
def inverse_exactness(record: MechanismRecord) -> Exactness:
    """The same of the formulas that lead from a pose to the joints alone: what certificates are made of.

    >>> from assur.model.registry import load_record
    >>> inverse_exactness(load_record("planar_3rrr")).claim
    'the formulas close the joint graph: exact, error < 1e-15'
    """
    return _exactness(record, ("inverse",), AGAIN, equations=False)


def _exactness(
    record: MechanismRecord, problems: tuple[Problem, ...], most: int, *, equations: bool = True
) -> Exactness:
    general, own = (_Attempt(record, problems, any_dimensions, equations) for any_dimensions in (True, False))
    first = general.exactness(most)
    if first.proved or (most < AGAIN and first.places and not first.mismatches):
        return first
    second = own.exactness(most)
    return second if second.proved or second.mismatches or not first.undecided else first


@dataclass(frozen=True)
class _Attempt:
    """What is drawn: dimensions too, or a pose or inputs alone; and whether equations are looked at."""

    record: MechanismRecord
    problems: tuple[Problem, ...]
    general: bool
    equations: bool

    def exactness(self, most: int) -> Exactness:
        """What the draws say, of so many primes for each problem at most."""
        random = np.random.default_rng(secrets.randbits(64))
        error, trials = 0.0, list[Trial]()
        for problem in self.problems:
            missed, met, first = 1.0, dict[int, set[int]](), len(trials)
            while (missed > ENOUGH or not _all_met(met)) and len(trials) - first < most:
                try:
                    trial = Trial(self.record, problem, self.general, random)
                    broken = trial.mismatch(equations=self.equations)
                except (ArithmeticError, TypeError, ValueError, AttributeError, MechanismFileError) as reason:
                    # dimensions that are drawn may divide by zero, and Python that was let run may know floats alone
                    return Exactness(undecided=f"{type(reason).__name__}: {reason}", general=self.general)
                if broken:
                    return Exactness((broken,), general=self.general)
                missed *= min(1.0, trial.error)
                met[trial.kinds] = met.get(trial.kinds, set()) | trial.met
                trials.append(trial)
            error += missed if _all_met(met) else 1.0
        return Exactness(
            error=error,
            general=self.general,
            guarded=any(trial.draws.guarded for trial in trials),
            undecided=f"the degrees of its formulas leave an error of {error:.0e}" if error >= SURE else "",
            primes=tuple(trial.draws.field.p for trial in trials),
            places=sum(trial.places for trial in trials),
            degree=max(trial.degree for trial in trials),
        )


def _all_met(met: Mapping[int, set[int]]) -> bool:
    """Whether every choice of signs was met, of as many as there are."""
    return any(len(choices) == kinds for kinds, choices in met.items())


def problems_by_formulas(record: MechanismRecord) -> tuple[Problem, ...]:
    """The problems whose branches are formulas.

    >>> from assur.model.registry import load_record
    >>> problems_by_formulas(load_record("planar_3rrr"))
    ('inverse',)
    """
    return ("inverse", "direct") if callable(closed_form_of(record).direct) else ("inverse",)


class SoundDraws(Draws):
    """Draws that are left out once a root does not exist there, so that roots of roots cost no more than they need."""

    def sqrt(self, radicand: Any, /) -> Residues:
        """A root at the draws at which everything before exists, where these are two or more."""
        sound = np.flatnonzero(self.sound)
        if 2 <= len(sound) < self.count:
            self.keep(sound)
        return super().sqrt(radicand)


class Trial:
    """Draws of one problem, and how sure what they say is.

    Attributes:
        places: at how many draws all roots exist.
        error: how likely it is that what is wrong was not seen.
        degree: the largest of a polynomial that must vanish.
    """

    def __init__(self, record: MechanismRecord, problem: Problem, general: bool, random: np.random.Generator) -> None:
        self.record, self.problem, self.general = record, problem, general
        field, self._drawn = PrimeField.drawn(random, LARGE), DRAWS
        while True:
            self.draws = SoundDraws(field, self._drawn, random)
            self.question = DrawnProblem(record, problem, self.draws, general)
            self._determinants = tuple(self.question.determinants())  # factors have roots, too
            self.places = int(np.sum(self.draws.sound))
            if self.places >= SOUND or self._drawn == MOST_DRAWS:
                break
            self._drawn = min(MOST_DRAWS, self._drawn * min(8, math.ceil(1.5 * SOUND / max(self.places, 1))))
        self.error = self.degree = 0.0
        self.taken, self.roots = taken_over(record, problem)
        self.met = self._met()

    @property
    def kinds(self) -> int:
        """How many choices of a mode's signs there are but for what roots take over: with each the formulas differ."""
        return int(2 ** (len(self.question.signs) - len(self._taken)))

    @property
    def _taken(self) -> tuple[frozenset[int], ...]:
        """What roots take over, where none is tied to others."""
        return () if self.draws.tied else self.taken

    def _met(self) -> set[int]:
        """The choices of signs that were drawn where all roots exist; none if a root is not one of its own."""
        own = {id(name) for name, _ in self.draws.roots if name is not None}
        if self._taken and len(own) < self.roots:
            return set()
        return set(self._choices[self.draws.sound].tolist())

    @property
    def _choices(self) -> IntArray:
        """The choice of signs (D,) at each draw, as a number: roots may turn those that they take over."""
        p, count = self.draws.p, self.draws.count
        minus = np.array([sign.re == p - 1 for sign in self.question.signs.values()], dtype=np.int64).reshape(-1, count)
        for signs in self._taken:
            rows = sorted(signs)
            minus[rows] ^= minus[rows[0]]
        return np.asarray(2 ** np.arange(len(minus)) @ minus)

    def mismatch(self, *, equations: bool = True) -> Mismatch | None:
        """The first claim that is broken; the error is known afterwards.

        Args:
            equations: whether those of the direct problem are looked at.
        """
        if not self.places:
            self.error = 1.0
            return None
        self.draws.keep(self._looked_at())
        degrees = DrawnProblem(self.record, self.problem, Degrees(self.draws.roots), self.general)
        determinants = tuple(degrees.determinants())
        return (
            self._broken(self.question.claims(), degrees.claims())
            or self._wrong_rates(degrees)
            or self._broken(iter(self._determinants), iter(determinants))
            or (self._broken(self.question.equations(), degrees.equations()) if equations else None)
        )

    def _looked_at(self) -> NDArray[np.intp]:
        """Draws held against the joint graph: one of each choice of signs, and all where radicands are tied."""
        sound = np.flatnonzero(self.draws.sound)
        if not self.draws.tied:
            sound = sound[np.unique(self._choices[sound], return_index=True)[1]]
        return np.resize(sound, max(2, len(sound)))

    def _broken(self, claims: Iterator[Vanishing], degrees: Iterator[Vanishing]) -> Mismatch | None:
        for claim, own in zip(claims, degrees, strict=True):
            wrong = np.zeros(self.draws.count, dtype=bool)
            for number in claim.numbers:
                wrong |= self._wrong(number)
            wrong &= self.draws.sound
            if np.any(wrong):
                text = f"{claim.text} {self._where(wrong)}"
                name = claim.name or self._label(wrong, claim.part)
                return Mismatch(claim.part, name, self.problem, text, claim.allowed, self._hint)
            for number in own.numbers:
                if isinstance(number, Degree):
                    self._missed(number)
        return None

    def _missed(self, number: Degree) -> None:
        """Note how likely a number that is not zero was not seen: it is zero modulo p, or at the draws."""
        if self.draws.tied:  # with one choice of signs, and given that all roots exist
            unseen = self._unlike(number.bound * self._drawn / self.places) ** (self.places / self.kinds)
        else:
            unseen = min(1.0, number.bound * self._drawn / LARGE)  # at any of all draws
        self.error += self.draws.field.missed(number.bits) + unseen
        self.degree = max(self.degree, number.bound)

    def _unlike(self, degree: float) -> float:
        """At what share of draws a polynomial, not zero for some signs of tied roots, may vanish."""
        some = 2.0**-self.draws.tied
        return 1 - some + some * min(1.0, degree / LARGE)

    def _wrong(self, number: Any) -> NDArray[np.bool_]:
        if isinstance(number, Residues):
            return ~np.broadcast_to(number.zero(), (self.draws.count,))
        return np.full(self.draws.count, number != 0)

    def _where(self, wrong: NDArray[np.bool_]) -> str:
        which = "random dimensions" if self.general else "the dimensions of the file"
        return (
            f"in the {self.problem} problem, with {which} and in exact arithmetic modulo {self.draws.field.p}: "
            f"at {int(np.sum(wrong))} of {self.draws.count} draws"
        )

    @property
    def _hint(self) -> str:
        """What a magnitude is in exact arithmetic."""
        return TIED if self.draws.tied else ""

    def _label(self, wrong: NDArray[np.bool_], part: str) -> str:
        """The mode of a branch that is wrong."""
        first = int(np.argmax(wrong))
        signs = [sign.re[first] for sign in self.question.signs.values()]
        return "".join("+" if sign == 1 else "-" for sign in signs) if part == "branch" else ""

    def _wrong_rates(self, degrees: DrawnProblem) -> Mismatch | None:
        rates, bounds = self.question.rates(), degrees.rates()
        for line, wrong in enumerate(unexplained(self.draws, rates), 1):
            if np.any(wrong):
                text = f"row {line} of Jp v = Jq qdot is wrong for a motion of the joint graph {self._where(wrong)}"
                allowed = "every motion of the joint graph must obey it"
                return Mismatch("Jp and Jq", f"row {line}", self.problem, text, allowed, self._hint)
        self._missed(_minor([*bounds.closure, *bounds.relation], len(bounds.relation[0]) + 1))
        return None


def _minor(rows: Sequence[Sequence[Any]], size: int) -> Degree:
    """The largest minor of so many rows: a sum of products of entries, as many as there are permutations."""
    wholes = [sum((number for number in row if isinstance(number, Degree)), start=Degree()) for row in rows]
    largest = sorted(wholes, key=lambda whole: -whole.over)[:size]
    highest = sorted((whole.height for whole in wholes), reverse=True)[:size]
    roots = frozenset[object]().union(*(whole.roots for whole in largest))
    return Degree(sum(whole.over for whole in largest), {}, roots, sum(highest) + math.log2(math.factorial(size)))


def unexplained(draws: Draws, rates: Rates) -> list[NDArray[np.bool_]]:
    """At which draws (D,) a row of the relation is no combination of the rows of the closure, row by row.

    Gauss's elimination; a draw at which a pivot vanishes that others have is left out.
    """
    p = draws.p
    columns = len(rates.closure[0]) if rates.closure else len(rates.relation[0])
    rows = [_numbers(draws, row) for row in (*rates.closure, *rates.relation)]
    re, im = (np.stack([row[part] for row in rows]) for part in (0, 1))  # (rows, columns, draws)
    free, count = list(range(len(rates.closure))), len(rates.closure)
    sound = draws.sound.copy()
    for column in range(columns):
        filled = np.sum((re[free, column] != 0) | (im[free, column] != 0), axis=-1) if free else np.zeros(0)
        if not free or not np.any(filled):
            continue
        pivot = free.pop(int(np.argmax(filled)))
        a, b = re[pivot, column], im[pivot, column]
        size = (a * a + b * b) % p  # zero for zero alone
        sound &= size != 0
        over = inverted(size, p)
        inverse = a * over % p, -b * over % p
        line = _times((re[pivot], im[pivot]), inverse, p)
        others = [*free, *range(count, len(rows))]
        busy = [row for row in others if np.any(re[row, column]) or np.any(im[row, column])]
        if busy:
            factor = re[busy, column][:, None, :], im[busy, column][:, None, :]
            away = _times(factor, (line[0][None], line[1][None]), p)
            re[busy], im[busy] = (re[busy] - away[0]) % p, (im[busy] - away[1]) % p
    left = (re[count:] != 0) | (im[count:] != 0)
    return [np.any(row, axis=0) & sound for row in left]


def _numbers(draws: Draws, row: Sequence[Any]) -> tuple[IntArray, IntArray]:
    """A row's residues (columns, draws), real and imaginary parts."""
    re, im = np.zeros((2, len(row), draws.count), dtype=object)
    for k, number in enumerate(row):
        own = number if isinstance(number, Residues) else draws.number(number)
        re[k], im[k] = own.re, 0 if own.im is None else own.im
    return re, im


def _times(a: tuple[IntArray, IntArray], b: tuple[IntArray, IntArray], p: Any) -> tuple[IntArray, IntArray]:
    return (a[0] * b[0] - a[1] * b[1]) % p, (a[0] * b[1] + a[1] * b[0]) % p
