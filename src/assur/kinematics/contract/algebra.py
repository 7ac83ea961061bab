"""What is known of the entries of a kernel by the way they are made: which are never negative, which are never zero.

A divisor that may vanish unnoticed, and a radicand that may be negative unnoticed, make numbers that mean nothing where
no status says so. Taken apart, products, quotients, roots and signs leave what must not be zero. That is

- a number, or a parameter that the mechanism's file says is positive, or a formula of parameters that is not zero;
- a sum of squares and of something positive;
- a number times powers of margins at whose zero the formulas are declared to degenerate, and of factors of det Jp,
  det Jq or of kind "other", at whose zero the pose is singular;
- what the coefficients of a polynomial are divided by: one that is not finite leaves the problem undecided.

A radicand is one of the first two, a margin, or made of such.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.status import closed_form_of

FloatArray = NDArray[np.float64]
Least = Literal["positive", "zero or more", "anything"]

SAMPLES = 120
SAME = 1e-9
SIGNS: dict[str, Least] = {"positive": "positive", "nonnegative": "zero or more", "any": "anything"}


class Algebra:
    """What is known of the entries of one kernel."""

    def __init__(self, kernel: Kernel) -> None:
        self.kernel, self.operations = kernel, kernel.tape.operations
        names = {place: name for name, place in kernel.uniform.items()}
        parameters = kernel.record.parameters
        self._parameters = {k: parameters[name].sign if name in parameters else "any" for k, name in names.items()}
        self._values = _samples(kernel)
        self._doubts: dict[int, frozenset[int]] = {}
        self._signs: dict[int, Least] = {}
        self._merging = {k for item in kernel.margins if item.zero == "merge" for k in self._margin(item.name)}
        named = {item.name for item in closed_form_of(kernel.record).factor_list}
        factors = {k for name, places in kernel.outputs["factor"].items() if name in named for k in places}
        declared = [k for item in kernel.margins if item.zero == "degenerate" for k in self._margin(item.name)]
        declared += [*factors, *(k for places in kernel.outputs.get("finite", {}).values() for k in places)]
        coefficients = [k for places in kernel.outputs.get("coefficient", {}).values() for k in places]
        declared += [self.operations[j].arguments[1] for k in coefficients for j in self._quotients(k)]
        self._declared = sorted(set(declared))
        self._known: set[int] = set()
        for k in self._declared:
            self._taken_apart(k, finite=k not in factors)
        for k in range(len(self.operations)):  # arguments come first, so that a long chain is no deep recursion
            self.least(k)

    def doubtful_divisors(self) -> tuple[int, ...]:
        """Entries, parts of divisors, of which it is not known that they are not zero."""
        return tuple(sorted({part for k in self.kernel.divisors for part in self.doubts(k)}))

    def doubtful_radicands(self) -> tuple[int, ...]:
        """Radicands of which it is not known that they are not negative where a branch is listed."""
        return tuple(k for k in self.kernel.roots if not self._allowed(k))

    def doubts(self, k: int) -> frozenset[int]:
        """The parts of an entry of which it is not known that they are not zero."""
        if k not in self._doubts:
            self._doubts[k] = self._doubtful(k)
        return self._doubts[k]

    def least(self, k: int) -> Least:
        """What is known of a sign by the way the entry is made."""
        if k not in self._signs:
            self._signs[k] = self._least(k)
        return self._signs[k]

    def _margin(self, name: str) -> tuple[int, ...]:
        return self.kernel.outputs["margin"][name]

    def _quotients(self, k: int) -> list[int]:
        return [j for j in self.kernel.needs[k] if self.operations[j].name == "/"]

    def _allowed(self, k: int) -> bool:
        """Whether a radicand is a margin, made of such and of what is not negative, or never negative by itself."""
        if k in self._merging or self.least(k) != "anything" or self._constant(k, negative=False):
            return True
        item = self.operations[k]
        if item.name in ("*", "/", "+") and all(map(self._allowed, item.arguments)):
            return True
        return any(self._multiple(k, j) > 0 for j in self._merging)

    def _taken_apart(self, k: int, *, finite: bool) -> None:
        """A product that is not zero has no part that is zero; nor has a quotient that is known to be finite."""
        left = [k]
        while left:
            part = left.pop()
            item = self.operations[part]
            splits = item.name in ("*", "negative", "magnitude", "root") or (item.name == "/" and finite)
            if part not in self._known and splits:
                left += item.arguments
            self._known.add(part)

    def _doubtful(self, k: int) -> frozenset[int]:
        item = self.operations[k]
        if k in self._known or self.least(k) == "positive" or self._constant(k, negative=True):
            return frozenset()
        if item.name in ("negative", "magnitude", "root"):
            return self.doubts(item.arguments[0])
        if item.name in ("*", "/"):
            return self.doubts(item.arguments[0]) | self.doubts(item.arguments[1])
        if item.name in ("+", "-") and self._is_nothing(item.arguments[1]):
            return self.doubts(item.arguments[0])
        known = any(self._multiple(k, j) for j in self._known) or self._is_product(k)
        return frozenset() if known else frozenset([k])

    def _is_nothing(self, k: int) -> bool:
        return self.operations[k].name == "number" and self.operations[k].number == 0

    def _constant(self, k: int, *, negative: bool) -> bool:
        """Whether an entry is made of dimensions and numbers alone, and is positive; or negative, if that will do."""
        if any(self.operations[j].name == "varying" or j in self._modes for j in self.kernel.needs[k]):
            return False
        value = float(np.min(self._values[k]))
        return value > 0 or (negative and value < 0)

    @property
    def _modes(self) -> set[int]:
        return {place for name, place in self.kernel.uniform.items() if name.startswith("sign.")}

    def _least(self, k: int) -> Least:
        item = self.operations[k]
        if item.name == "number":
            return "positive" if item.number > 0 else "zero or more" if item.number == 0 else "anything"
        if item.name == "uniform":
            return SIGNS[self._parameters[k]]
        if item.name in ("root", "magnitude"):
            return "positive" if self.least(item.arguments[0]) == "positive" else "zero or more"
        if item.name in ("*", "/", "+"):
            return self._least_of_two(item.name, *item.arguments)
        return "anything"

    def _least_of_two(self, name: str, first: int, second: int) -> Least:
        if name == "*" and first == second:
            return "positive" if first in self._known or self.least(first) == "positive" else "zero or more"
        both = {self.least(first), self.least(second)}
        if "anything" in both:
            return "anything"
        return "positive" if both == {"positive"} or (name == "+" and "positive" in both) else "zero or more"

    def _multiple(self, k: int, known: int) -> float:
        """What an entry that varies is times another, at samples; 0 where it is no multiple."""
        with np.errstate(all="ignore"):
            ratio = np.broadcast_to(self._values[k] / self._values[known], (SAMPLES,))
        ratio = ratio[np.isfinite(ratio) & (ratio != 0)]
        varies = len(np.unique(self._values[k])) > SAMPLES // 4
        if not varies or len(ratio) <= SAMPLES // 4 or not _same(ratio, float(np.median(ratio))):
            return 0.0
        return float(np.median(ratio))

    def _is_product(self, k: int) -> bool:
        """Whether an entry is a number times powers of what is declared, at samples; powers are halves."""
        with np.errstate(all="ignore"):
            logs = np.log(np.abs([np.broadcast_to(self._values[j], (SAMPLES,)) for j in (k, *self._declared)]))
        logs = logs[:, np.all(np.isfinite(logs), axis=0)]
        if logs.shape[1] < 2 * len(logs):
            return False
        columns = np.vstack([np.ones(logs.shape[1]), logs[1:]]).T
        powers = np.linalg.lstsq(columns, logs[0], rcond=1e-9)[0][1:]
        rest = logs[0] - logs[1:].T @ (np.round(2 * powers) / 2)
        return bool(np.any(np.round(2 * powers))) and _same(rest - np.median(rest), 0.0)


def _same(values: FloatArray, wanted: float) -> bool:
    """Nine in ten of them: at the others rounding may have taken the digits."""
    return bool(np.mean(np.abs(values - wanted) <= SAME * max(1e-300, abs(wanted), float(wanted == 0))) > 0.9)


def _samples(kernel: Kernel) -> Sequence[FloatArray]:
    """Values (SAMPLES,) of every entry at random given numbers, those near the workspace; signs are plus."""
    random, record = np.random.default_rng(7), kernel.record
    size = max(map(abs, vars(record.values).values()), default=1.0)
    varying: list[FloatArray] = []
    for name, angle in kernel.given:
        usual = (-3, 3) if angle else (0.3 * size, 1.5 * size)
        place = random.uniform(*record.box.get(name, usual), SAMPLES)
        varying += [np.cos(place), np.sin(place)] if angle else [place]
    return kernel.evaluated(varying, {})
