"""Which entries of a kernel are products of others, exactly: residues modulo a prime say so, not floats.

Powers are guessed by the logarithms of complex samples, where every root exists. Then the quotient is worked out with
residues: it must be the same at all poses, whatever the dimensions. These are drawn once for several poses.
"""

from __future__ import annotations

import itertools
import math
import secrets
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.contract.kernel import Kernel
from assur.model.kernel_dimensions import angle_components, dimension_numbers
from assur.model.pose import QUATERNION
from assur.numerics.prime_field import PrimeField, simplest
from assur.numerics.residues import Draws, Residues

Powers = Mapping[int, int]
"""Entry -> twice its power."""

GROUPS, EACH = 32, 32
"""Choices of dimensions, and poses for each."""
LEAST = 12
"""Fewer draws that agree with another of their group say nothing: at the rest some root of roots does not exist."""
SAMPLES = 96
LARGEST = 16
"""Of twice a power."""
SAME = 1e-7
"""Of logarithms: only a guess, which residues then decide."""
GUESSES = 6
MOST_TOGETHER, MANY = 4, 16
"""So many entries together are tried, of so many; of more of these all pairs. All at once tell nothing where some are
products of others, as signs that name modes are of those of roots."""
SEED = 7
"""Of guesses. The prime is nobody's to know: a formula may be written that is zero modulo one."""


class GroupedDraws(Draws):
    """Draws in groups; the root of what is made of dimensions alone has one sign in each group."""

    constant = False

    @property
    def every(self) -> NDArray[np.bool_]:
        """All draws."""
        return np.ones(self.count, dtype=bool)

    def signs(self) -> Residues:
        """1 or -1 at each draw, or in each group."""
        if not self.constant:
            return super().signs()
        return self.grouped(np.where(self.random.random(GROUPS) < 0.5, 1, self.field.p - 1))

    def sqrt(self, radicand: Any, /) -> Residues:
        """A root; of what is a rational at every draw, as the size of an angle's cosine and sine, the positive one."""
        share = self._rational(radicand, self.number(1)) if isinstance(radicand, Residues) else None
        return super().sqrt(radicand) if share is None else self._of_rational(share)

    def dimension(self) -> Residues:
        """A number that is the same in each group."""
        return self.grouped(self.random.integers(1, self.field.p, size=GROUPS))

    def grouped_circle(self) -> tuple[Residues, Residues]:
        """Cosine and sine of an angle that is the same in each group."""
        half = self.dimension()
        size = (half * half + 1).inverse()
        return (1 - half * half) * size, 2 * half * size

    def grouped(self, numbers: NDArray[np.int64]) -> Residues:
        """One number for each group."""
        return Residues(self, np.repeat(numbers, EACH))


class Identities:
    """Products among the entries of a kernel.

    Args:
        kernel: whose entries they are.
        general: whether they have to hold with any dimensions; else with those of the record.

    >>> from assur.kinematics.contract.kernel import recorded
    >>> from assur.model.registry import load_record
    >>> kernel = recorded(load_record("fivebar"), "direct")
    >>> identities, (meeting,) = Identities(kernel), kernel.outputs["margin"]["meeting"]
    >>> gap, (radicand,) = kernel.outputs["margin"]["gap"][0], kernel.roots
    >>> identities.product(radicand, [gap, meeting]) == {gap: -2, meeting: 2}
    True
    """

    def __init__(self, kernel: Kernel, general: bool = True) -> None:
        self.kernel, self.general = kernel, general
        varying = _varying(kernel)
        self.fixed = {k for k, needs in enumerate(kernel.needs) if not needs & varying}
        random, secret = np.random.default_rng(SEED), np.random.default_rng(secrets.randbits(64))
        self.needed = frozenset[int]().union(*(kernel.needs[k] for k in _entries(kernel)))
        self._draws = GroupedDraws(PrimeField.drawn(secret), GROUPS * EACH, secret)
        self._sound: list[NDArray[np.bool_]] = []
        self._angles: dict[str, tuple[Residues, Residues]] = {}
        self._residues = self._drawn()
        own = {name: np.full(SAMPLES, complex(value)) for name, value in dimension_numbers(kernel.record).items()}
        self._samples = self._complex(random, own)
        self._others = self._complex(random, self._changed(random)) if general else self._samples
        with np.errstate(all="ignore"):
            self._logs = np.log(np.abs(self._samples))

    def product(self, target: int, others: Sequence[int]) -> Powers | None:
        """Twice the powers of others of which an entry is a multiple; empty if it is the same everywhere, else None."""
        if target in others:
            return {target: 2}
        return {} if self._holds(target, {}, 2) else next(self._products(target, others, 2), None)

    def positive_product(self, target: int, others: Sequence[int], accepted: Callable[[Powers], bool]) -> Powers | None:
        """The same of whole powers that are accepted, with a positive factor: both have the same sign."""
        if target in others and accepted({target: 2}):
            return {target: 2}
        whole = (powers for powers in self._products(target, others, 1, accepted) if self._is_positive(target, powers))
        return next(whole, None)

    def _products(
        self, target: int, others: Sequence[int], times: int, accepted: Callable[[Powers], bool] | None = None
    ) -> Iterator[Powers]:
        """Powers of which an entry, to that power, is a multiple."""
        usable = [j for j in dict.fromkeys(others) if j != target and j not in self.fixed and self._is_finite(j)]
        guesses = self._guesses(target, usable) if self._is_finite(target) else iter(())
        if accepted is not None:
            guesses = (powers for powers in guesses if not any(map(odd, powers.values())) and accepted(powers))
        yield from (powers for powers in itertools.islice(guesses, GUESSES) if self._holds(target, powers, times))

    def value(self, k: int) -> float:
        """What an entry made of dimensions alone is, with those of the record; nan where that is no real number."""
        number = complex(self._samples[k][0])
        return number.real if abs(number.imag) <= SAME * abs(number) else math.nan

    def _is_finite(self, k: int) -> bool:
        return bool(np.mean(np.isfinite(self._logs[k])) > 0.9)

    def _guesses(self, target: int, others: Sequence[int]) -> Iterator[Powers]:
        """The fewest entries first."""
        rows = np.all(np.isfinite(self._logs[[target, *others]]), axis=0)
        logs = self._logs[[target, *others]][:, rows]
        logs = logs - np.mean(logs, axis=1, keepdims=True)
        wanted, columns = logs[0], logs[1:]
        if not len(others) or rows.sum() <= 2 * len(others):
            return
        size = max(float(np.max(np.abs(wanted))), 1e-3)
        gram, right = columns @ columns.T, columns @ wanted
        few = MOST_TOGETHER if len(others) <= MANY else 2
        for count in (*range(1, few + 1), len(others)):
            chosen = (
                np.array(list(itertools.combinations(range(len(others)), count)), dtype=int).reshape(-1, count)
                if count <= few
                else np.arange(len(others))[None]
            )
            solved = _solved(gram[chosen[:, :, None], chosen[:, None, :]], right[chosen])
            powers = np.rint(2 * solved)
            left = np.abs(wanted - np.einsum("rc,rcs->rs", powers / 2, columns[chosen]))
            close = (np.max(left, axis=1) <= SAME * size) & np.any(powers, axis=1)
            for row in np.flatnonzero(close & (np.max(np.abs(powers), axis=1) <= LARGEST)):
                yield {others[c]: int(power) for c, power in zip(chosen[row], powers[row], strict=True) if power}

    def _holds(self, target: int, powers: Powers, times: int) -> bool:
        """Whether the quotient, to that power, is the same at all poses: in each group, or with these dimensions."""
        values = self._residues
        self._draws.sound = self._draws.every
        above = [values[target]] * times
        below: list[Any] = []
        for j, power in powers.items():
            (below if power > 0 else above).extend([values[j]] * abs(power * times // 2))
        quotient = math.prod(above[1:], start=above[0]) * math.prod(below, start=self._draws.number(1)).inverse()
        parts = [np.broadcast_to(part, GROUPS * EACH) for part in (quotient.re, quotient.im) if part is not None]
        known = np.logical_and.reduce([self._sound[k] for k in (target, *powers)])
        sound = known.reshape(GROUPS if self.general else 1, -1)
        if np.sum(np.maximum(np.sum(sound, axis=1) - 1, 0)) < LEAST or not np.any(parts[0][known]):
            return False
        first = np.argmax(sound, axis=1)[:, None]
        grouped = [part.reshape(sound.shape) for part in parts]
        return all(bool(np.all((part == np.take_along_axis(part, first, axis=1)) | ~sound)) for part in grouped)

    def _is_positive(self, target: int, powers: Powers) -> bool:
        """Whether the multiple is positive, with other dimensions too."""
        with np.errstate(all="ignore"):
            ratio = self._others[target]
            for j, power in powers.items():
                ratio = ratio / self._others[j] ** (power // 2)
        ratio = ratio[np.isfinite(ratio)]
        return bool(len(ratio) > SAMPLES // 2 and np.all(ratio.real > 0))

    def _drawn(self) -> list[Any]:
        """Every entry as residues; roots of dimensions alone keep their signs in a group."""
        draws, given = self._draws, iter(self._given())
        operations, values = self.kernel.tape.operations, list[Any]()
        names = {k: name for name, k in self.kernel.uniform.items()}
        for k, item in enumerate(operations):
            draws.sound = np.logical_and.reduce([draws.every, *(self._sound[j] for j in item.arguments)])
            if item.name != "varying" and k not in self.needed:
                values.append(None)
            elif item.name == "varying":
                values.append(next(given))
            elif item.name == "uniform":
                values.append(self._uniform(names[k]))
            elif item.name == "number":
                values.append(draws.number(item.number))
            elif item.name == "root":
                draws.constant = k in self.fixed
                values.append(draws.sqrt(values[item.arguments[0]]))
            else:
                values.append(EXACTLY[item.name](*(values[j] for j in item.arguments)))
            self._sound.append(draws.sound)
        return values

    def _uniform(self, name: str) -> Residues:
        """A dimension, or a sign."""
        draws, record = self._draws, self.kernel.record
        if name.startswith("sign."):
            return draws.signs()
        part, _, angle = name.partition(" ")
        if angle:
            return self._angles.setdefault(angle, self._angle(angle))[part == "sin"]
        if not self.general:
            number = draws.number(float(vars(record.values)[name]))
            if number.exact:
                draws.positive.append(number if number.exact > 0 else -number)
            return number
        number = draws.dimension()
        if name in record.parameters and record.parameters[name].sign == "positive":
            draws.positive.append(number)
        return number

    def _angle(self, name: str) -> tuple[Residues, Residues]:
        """Cosine and sine of an angle among the dimensions."""
        parameter = self.kernel.record.parameters[name]
        turns = simplest(parameter.value) / 360 if parameter.unit == "deg" and not self.general else None
        share = None if turns is None else self._draws.multiple(turns)
        return self._draws.grouped_circle() if share is None else share

    def _given(self) -> Iterator[Residues]:
        draws = self._draws
        unit = _unit(draws) if self.kernel.question == "inverse" else {}
        for name, angle in self.kernel.given:
            if angle:
                cosine, sine = draws.circle()
                if name == "theta" and self.kernel.question == "inverse":  # from -90 to 90 deg
                    draws.positive.append(cosine)
                yield cosine
                yield sine
            else:
                yield unit.get(name) or draws.uniform()

    def _complex(self, random: np.random.Generator, dimensions: Mapping[str, Any]) -> NDArray[np.complex128]:
        """Entries (K, SAMPLES) at poses, or inputs, by chance: real numbers, of which every root is complex."""
        kernel = self.kernel
        size = max((float(np.max(np.abs(value))) for value in dimensions.values()), default=1.0)
        varying: list[Any] = []
        for _, angle in kernel.given:
            turn = random.uniform(-3, 3, SAMPLES)
            varying += [np.cos(turn) + 0j, np.sin(turn) + 0j] if angle else [random.normal(0, size, SAMPLES) + 0j]
        given = iter(varying)
        names = {k: name for name, k in kernel.uniform.items()}
        values: list[Any] = []
        with np.errstate(all="ignore"):
            for k, item in enumerate(kernel.tape.operations):
                if item.name == "varying":
                    values.append(next(given))
                elif k not in self.needed:
                    values.append(np.full(SAMPLES, np.nan + 0j))
                elif item.name == "uniform":
                    sign = random.choice(np.array([1.0 + 0j, -1.0]), SAMPLES)
                    values.append(dimensions.get(names[k], sign))
                elif item.name == "number":
                    values.append(np.full(SAMPLES, complex(item.number)))
                elif item.name == "root":
                    values.append(np.sqrt(values[item.arguments[0]]))
                else:
                    values.append(EXACTLY[item.name](*(values[j] for j in item.arguments)))
        return np.array(values)

    def _changed(self, random: np.random.Generator) -> dict[str, Any]:
        """Dimensions by chance, other ones at each sample, of the signs that the file allows."""
        record, found = self.kernel.record, dict[str, Any]()
        for name, value in vars(record.values).items():
            sign = record.parameters[name].sign if name in record.parameters else "any"
            size = abs(value) or 1.0
            drawn = random.normal(0, 1, SAMPLES)
            kinds = {"positive": np.exp(drawn), "nonnegative": np.abs(drawn), "any": drawn}
            if record.parameters[name].angular:
                found |= zip(angle_components(name), (np.cos(drawn) + 0j, np.sin(drawn) + 0j), strict=True)
                continue
            found[name] = size * kinds[sign] + 0j
        return found


def odd(power: int) -> bool:
    """Whether twice a power is odd: the power is no whole number."""
    return power % 2 == 1


EXACTLY: Mapping[str, Callable[..., Any]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "negative": lambda a: -a,
}


def _entries(kernel: Kernel) -> tuple[int, ...]:
    """Radicands, divisors and what is declared."""
    declared = [k for kind in ("margin", "factor", "sign", "finite") for k in _all(kernel, kind)]
    return (*kernel.roots, *kernel.divisors, *declared)


def _all(kernel: Kernel, kind: str) -> list[int]:
    return [k for places in kernel.outputs[kind].values() for k in places]


def _varying(kernel: Kernel) -> frozenset[int]:
    """Entries that are given for each problem, and signs."""
    given = {k for k, item in enumerate(kernel.tape.operations) if item.name == "varying"}
    return frozenset(given | {k for name, k in kernel.uniform.items() if name.startswith("sign.")})


def _unit(draws: Draws) -> dict[str, Residues]:
    """A quaternion of length one: the square of any, over its size."""
    w, x, y, z = (draws.uniform() for _ in QUATERNION)
    over = (w * w + x * x + y * y + z * z).inverse()
    parts = (w * w - x * x - y * y - z * z), 2 * w * x, 2 * w * y, 2 * w * z
    return {name: part * over for name, part in zip(QUATERNION, parts, strict=True)}


def _solved(gram: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Least squares for several choices of columns; the smallest where they depend on each other."""
    try:
        solved = np.linalg.solve(gram, right[:, :, None])
    except np.linalg.LinAlgError:
        solved = np.linalg.pinv(gram, rcond=1e-12) @ right[:, :, None]
    return np.asarray(solved[:, :, 0], dtype=float)
