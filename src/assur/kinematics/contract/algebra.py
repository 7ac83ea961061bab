"""What is known of the entries of a kernel: which are never negative, which never zero where a branch is listed.

A divisor that may vanish unnoticed, and a radicand that may be negative unnoticed, make numbers that mean nothing where
no status says so. Taken apart, products, quotients, roots and signs leave what must not be zero. That is

- a number, or a parameter that the mechanism's file says is positive;
- a sum of squares and of something positive;
- a multiple of powers of margins at whose zero the formulas are declared to degenerate, and of factors of det Jp,
  det Jq or of kind "other", at whose zero the pose is singular;
- what the coefficients of a polynomial are divided by: one that is not finite leaves the problem undecided.

A radicand is one of the first two, a margin, made of such, or a positive multiple of a margin and of squares. A margin
in turn has to be a radicand, a divisor or a factor but for such multiples: else it ends branches where they go on.
What is a multiple is known exactly (`assur.kinematics.contract.identities`).
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property
from typing import Literal

from assur.kinematics.contract.identities import Identities, Powers
from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.modes import sign_names
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Margin

Least = Literal["positive", "zero or more", "anything"]

ONCE = 2
"""The power 1, as `Powers` has it."""

SIGNS: dict[str, Least] = {"positive": "positive", "nonnegative": "zero or more", "any": "anything"}


class Algebra:
    """What is known of the entries of one kernel.

    Args:
        kernel: one question.
        general: whether it has to be known with any dimensions; else with those of the record.
    """

    def __init__(self, kernel: Kernel, general: bool = True) -> None:
        self.kernel, self.operations = kernel, kernel.tape.operations
        self._general = general
        names = {place: name for name, place in kernel.uniform.items()}
        parameters = kernel.record.parameters
        self._parameters = {k: parameters[name].sign if name in parameters else "any" for k, name in names.items()}
        self._doubts: dict[int, frozenset[int]] = {}
        self._signs: dict[int, Least] = {}
        self._squares: dict[tuple[str, int, frozenset[int]], bool] = {}
        self._merging = sorted({k for item in kernel.margins if item.zero == "merge" for k in self.margin(item)})
        named = {item.name for item in closed_form_of(kernel.record).factor_list}
        factors = {k for name, places in kernel.outputs["factor"].items() if name in named for k in places}
        declared = [k for item in kernel.margins if item.zero == "degenerate" for k in self.margin(item)]
        declared += [*factors, *(k for places in kernel.outputs["finite"].values() for k in places)]
        coefficients = [k for places in kernel.outputs["coefficient"].values() for k in places]
        declared += [self.operations[j].arguments[1] for k in coefficients for j in self._quotients(k)]
        self._declared = sorted(set(declared))
        self._known: set[int] = set()
        for k in self._declared:
            self._taken_apart(k, finite=k not in factors)
        for k in range(len(self.operations)):  # arguments come first, so that a long chain is no deep recursion
            self.least(k)

    @cached_property
    def identities(self) -> Identities:
        """Products among the entries; worked out where something is not known without."""
        return Identities(self.kernel, self._general)

    def margin(self, claimed: Margin) -> tuple[int, ...]:
        """Entries of a margin."""
        return self.kernel.outputs["margin"][claimed.name]

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

    def untied(self) -> tuple[Margin, ...]:
        """Margins that are neither radicands nor divisors nor factors, but for what is never negative, or zero."""
        return tuple(item for item in self.kernel.margins if not all(self._is_tied(item, k) for k in self.margin(item)))

    def _quotients(self, k: int) -> list[int]:
        return [j for j in self.kernel.needs[k] if self.operations[j].name == "/"]

    def _allowed(self, radicand: int) -> bool:
        """Whether a radicand is a margin, made of such and of what is not negative, or never negative by itself."""
        operations = self.operations
        root = next(j for j, item in enumerate(operations) if item.name == "root" and item.arguments == (radicand,))
        # made without this root and those after it: the square of a root says nothing of its radicand's sign
        earlier = [
            k
            for k in (*self._merging, *self._units)
            if all(j < root for j in self.kernel.needs[k] if operations[j].name == "root")
        ]
        return self._is_bounded(radicand, earlier)

    def _is_bounded(self, k: int, others: list[int]) -> bool:
        """Whether an entry is not negative where no margin is."""
        if k in self._merging or self.least(k) != "anything" or self._is_fixed(k, positive=True):
            return True
        item, merging = self.operations[k], set(self._merging)
        if item.name in ("*", "/", "+") and all(self._is_bounded(part, others) for part in item.arguments):
            return True
        return bool(self.identities.positive_product(k, others, lambda powers: self._odd(powers) <= merging))

    def _odd(self, powers: Powers) -> set[int]:
        """Entries, with odd powers, of which no sign is known."""
        return {j for j, power in powers.items() if power % 4 and self.least(j) == "anything"}

    def near(self, claimed: Margin) -> int | None:
        """Of radicands, or of divisors and factors, the one that has most in common with a margin."""
        (own, *_), needs = self.margin(claimed), self.kernel.needs
        others = self.kernel.roots if claimed.zero == "merge" else self._vanishing
        shares = {k: len(needs[k] & needs[own]) / len(needs[k] | needs[own]) for k in others if k != own}
        return max(shares, key=lambda k: shares[k], default=None)

    def _is_tied(self, claimed: Margin, k: int) -> bool:
        if self.least(k) == "positive" or (claimed.zero == "merge" and self.least(k) != "anything"):
            return True
        if claimed.zero == "degenerate":
            return bool(self.identities.product(k, self._vanishing))
        signs = [name for name in claimed.signs if name in self._asked]
        if signs:
            return all(self._is_square(k, name) for name in signs)
        return bool(claimed.signs) and self._is_radicand(k)

    def _is_radicand(self, k: int) -> bool:
        """Whether a margin is a positive multiple of a radicand: on a curve, whose signs are others."""
        roots = set(self.kernel.roots)
        others = [*roots, *self._units]
        return bool(self.identities.positive_product(k, others, lambda powers: len(self._odd(powers) & roots) == 1))

    @cached_property
    def _asked(self) -> tuple[str, ...]:
        """Signs by which the branches of the question are named."""
        curve = closed_form_of(self.kernel.record).self_motion
        if self.kernel.question == "self_motion":
            return curve.signs if curve else ()
        return sign_names(self.kernel.record, self.kernel.question)

    def _is_square(self, k: int, sign: str) -> bool:
        """Whether a margin is a positive multiple of the square of what its sign is the sign of.

        Of a product of roots that square has all their radicands as factors: those of the other margins are divided
        out. All but one of these are told by other signs, so that no root is parted into two.
        """
        alike = self._merging_by(sign) | {k}
        if self._squared(sign, k, frozenset()):
            return True
        return len(alike) > 1 and len(alike - self._told_beside(sign)) <= 1 and self._squared(sign, k, alike - {k})

    def _merging_by(self, sign: str) -> frozenset[int]:
        """Margins at whose zero a sign changes."""
        own = (item for item in self.kernel.margins if item.zero == "merge" and sign in item.signs)
        return frozenset(j for item in own for j in self.margin(item))

    def _told_beside(self, sign: str) -> set[int]:
        """Margins that the other signs tell, one after another: each as the only one that a sign has beside those."""
        told: set[int] = set()
        others = [name for name in self._asked if name != sign]
        while alone := {name: left for name in others if len(left := self._merging_by(name) - told) == 1}:
            others = [name for name in others if name not in alone]
            for name, left in alone.items():
                told |= {k for k in left if self._squared(name, k, self._merging_by(name) - left)}
        return told

    def _squared(self, sign: str, k: int, beside: frozenset[int]) -> bool:
        """Whether a margin is a positive multiple of the square of what a sign is the sign of, over those beside."""
        if (sign, k, beside) not in self._squares:
            quantity = self.kernel.outputs["sign"].get(sign, ())
            self._squares[sign, k, beside] = bool(quantity) and all(
                self._is_square_of(own, k, beside) for own in quantity
            )
        return self._squares[sign, k, beside]

    def _is_square_of(self, own: int, k: int, beside: Collection[int] = ()) -> bool:
        """Whether an entry is a positive multiple of the square of another one, over each of those beside."""

        def accepted(powers: Powers) -> bool:
            over = {j for j in beside if powers.get(j) == -ONCE}
            return own in powers and (not beside or powers[own] == 2 * ONCE) and self._odd(powers) <= over

        return bool(self.identities.positive_product(k, [own, *(sorted(beside) or self._units)], accepted))

    @cached_property
    def _units(self) -> list[int]:
        """What two entries that vanish together may differ by: what is declared, and what is divided by."""
        return sorted({*self._declared, *(part for k in self.kernel.divisors for part in self._parts(k))})

    @cached_property
    def _vanishing(self) -> list[int]:
        """Factors, radicands and parts of divisors."""
        named = [k for places in self.kernel.outputs["factor"].values() for k in places]
        parts = {part for k in (*self.kernel.divisors, *named) for part in self._parts(k)}
        return sorted({*parts, *named, *self.kernel.roots})

    def _parts(self, k: int) -> list[int]:
        """What a product is made of."""
        item = self.operations[k]
        if item.name in ("*", "/", "negative", "root"):
            return [part for j in item.arguments for part in self._parts(j)]
        return [] if item.name == "number" else [k]

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
        if k in self._known or self.least(k) == "positive" or self._is_fixed(k):
            return frozenset()
        if item.name in ("negative", "magnitude", "root"):
            return self.doubts(item.arguments[0])
        if item.name in ("*", "/"):
            return self.doubts(item.arguments[0]) | self.doubts(item.arguments[1])
        if item.name in ("+", "-") and self._is_nothing(item.arguments[1]):
            return self.doubts(item.arguments[0])
        if self._general and k in self.identities.fixed:
            return frozenset([k])
        known = self.identities.product(k, [*self._declared, *sorted(self._known)])
        return frozenset([k]) if known is None else frozenset()

    def _is_nothing(self, k: int) -> bool:
        return self.operations[k].name == "number" and self.operations[k].number == 0

    def _is_fixed(self, k: int, *, positive: bool = False) -> bool:
        """Whether an entry is made of dimensions alone and, with those of the record, not zero; or positive."""
        item = self.operations[k]
        if item.name == "number":
            return item.number > 0 or (item.number < 0 and not positive)
        if self._general or k not in self.identities.fixed:
            return False
        value = self.identities.value(k)
        return value > 0 or (value < 0 and not positive)

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
        if name == "*" and any(self._is_nothing(part) for part in (first, second)):
            return "zero or more"
        if name == "*" and first == second:
            return "positive" if first in self._known or self.least(first) == "positive" else "zero or more"
        both = {self.least(first), self.least(second)}
        if "anything" in both:
            return "anything"
        return "positive" if both == {"positive"} or (name == "+" and "positive" in both) else "zero or more"
