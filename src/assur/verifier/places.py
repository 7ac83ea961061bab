"""The formulas of a certificate at places that are drawn modulo a prime, with their derivatives along a motion."""

from __future__ import annotations

import itertools
import math
import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from assur.verifier import sizes
from assur.verifier.field import CircleField, Element, NoExactError, NoRootError, few_digits, simplest
from assur.verifier.formula import AngleSum, joined, plain
from assur.verifier.mechanism import FileMechanism
from assur.verifier.sizes import Size
from assur.verifier.vectors import plus, times

CIRCLE = ("cos", "sin")
"""Before the name of an angle among the dimensions, whose cosine or sine a number is."""
GUARD = Fraction(1, 10**25)
"""A number that is added and smaller only keeps a divisor from being zero: it is left out, and that is told."""
MOST = 2
"""So many positive numbers at most are looked for in a square under a root."""


@dataclass(slots=True)
class RatedNumber:
    """A number, and its rate along a motion; the integer 0 of what stands still."""

    value: Any
    rate: Any = 0

    def __add__(self, other: Any) -> RatedNumber:
        own = _dual(other)
        return RatedNumber(self.value + own.value, plus(self.rate, own.rate))

    def __sub__(self, other: Any) -> RatedNumber:
        own = _dual(other)
        return RatedNumber(self.value - own.value, plus(self.rate, times(-1, own.rate)))

    def __mul__(self, other: Any) -> RatedNumber:
        own = _dual(other)
        return RatedNumber(self.value * own.value, plus(times(self.rate, own.value), times(self.value, own.rate)))

    def __truediv__(self, other: Any) -> RatedNumber:
        own = _dual(other)
        quotient = self.value / own.value
        rate = plus(self.rate, times(times(-1, quotient), own.rate))
        return RatedNumber(quotient, rate if type(rate) is int else rate / own.value)

    def __neg__(self) -> RatedNumber:
        return RatedNumber(-self.value, times(-1, self.rate))


def _dual(number: Any) -> RatedNumber:
    return number if isinstance(number, RatedNumber) else RatedNumber(number)


class KnownRoot(NamedTuple):
    """What a root is: one of its own, or a rational's times positive numbers times one before."""

    own: bool
    before: int | None = None
    share: Fraction = Fraction(1)
    factors: tuple[int, ...] = ()


class RootPlan:
    """What is known of the roots of a program, whose radicands come in the same order at every place.

    Attributes:
        plan: what each is.
        seen: of each root of its own, place -> whether its radicand is in F_p, and has a root there; else at all.
    """

    def __init__(self) -> None:
        self.plan: list[KnownRoot] = []
        self.seen: list[dict[int, tuple[bool, bool]]] = []

    @property
    def tied(self) -> int:
        """How many roots may be tied to others: a product of radicands has a root always, or never.

        Of several in F_p that is told by linear algebra over {0, 1}: places are digits of one number.
        """
        count, rows = 0, list[dict[int, bool]]()
        for seen in self.seen:
            outside = [square for real, square in seen.values() if not real]
            if outside:
                count += len(set(outside)) < 2
                continue
            own = {place: square for place, (_, square) in seen.items()}
            if _independent([*rows, own], list(own)):
                rows.append(own)
            else:
                count += 1
        return count


def _independent(rows: Sequence[Mapping[int, bool]], places: Sequence[int]) -> bool:
    """Whether no sum of rows, the last among them, is the same at all places."""
    left = [sum(1 << k for k, place in enumerate(places) if row.get(place, False)) for row in rows]
    left.insert(0, (1 << len(places)) - 1)
    pivots: list[int] = []
    for row in left:
        rest = row
        for pivot in pivots:
            rest = min(rest, rest ^ pivot)
        if not rest and row is left[-1]:
            return False
        if rest:
            pivots.append(rest)
    return bool(rest)


class DrawnPlace:
    """Dimensions, a pose and its rates, drawn; the number type of the graph there.

    Args:
        number: of the place.
        general: whether dimensions are drawn; else they are those of the file.

    Attributes:
        names: dimensions: numbers, rationals and angles.
        given, rates: coordinates of the pose, and their rates.
        guarded: whether a number was left out.
    """

    def __init__(
        self, number: int, mechanism: FileMechanism, field: CircleField, roots: RootPlan, general: bool
    ) -> None:
        self.field, self.roots, self._place = field.fresh(), roots, number
        self._calls, self._own = 0, list[tuple[Element, Element]]()
        self.given: dict[str, Any] = {}
        self.rates: dict[str, Element] = {}
        self.guarded = False
        self.names = _drawn(mechanism, self.field.uniform) if general else mechanism.dimensions(self)
        positive = (self.names[name] for name in sorted(mechanism.positive))
        self.positive = [plain(value, self) for value in positive if not isinstance(value, AngleSum)]

    def coordinate(self, name: str, angle: bool) -> Any:
        """A coordinate of the pose, with a rate."""
        self.rates[name] = self.field.uniform()
        if not angle:
            self.given[name] = RatedNumber(self.field.uniform(), self.rates[name])
            return self.given[name]
        if name == "theta":  # from -90 to 90 deg
            self.positive.append(self.field.circle(AngleSum({_angle(name): Fraction(1)}))[0])
        return AngleSum({_angle(name): Fraction(1)})

    def number(self, value: Fraction) -> Element:
        """A rational."""
        return self.field.number(value)

    def radians(self, angle: AngleSum) -> Element:
        """None."""
        return self.field.radians(angle)

    def circle(self, angle: AngleSum) -> tuple[Any, Any]:
        """Cosine and sine, with the rates of the pose's angles."""
        cosine, sine = self.field.circle(angle)
        rate: Any = 0
        for name, own in self.rates.items():
            rate = plus(rate, times(angle.shares.get(_angle(name), 0), own))
        if type(rate) is int:
            return cosine, sine
        return RatedNumber(cosine, times(times(-1, sine), rate)), RatedNumber(sine, times(cosine, rate))

    def root(self, radicand: Any) -> Any:
        """A root with its rate; of a drawn number of either sign, but for what is known of it."""
        if isinstance(radicand, RatedNumber):
            root = self._root(radicand.value)
            return RatedNumber(root, radicand.rate if type(radicand.rate) is int else radicand.rate / (2 * root))
        return self.field.root(radicand) if isinstance(radicand, (int, Fraction)) else self._root(radicand)

    def _root(self, radicand: Element) -> Element:
        call = self._calls
        self._calls += 1
        if call == len(self.roots.plan):
            self.roots.plan.append(self._relation(radicand))
        plan = self.roots.plan[call]
        if not plan.own:
            root = self.field.root(plan.share)
            for k in plan.factors:
                root = root * self.positive[k]
            root = root * (1 if plan.before is None else self._own[plan.before][1])
            if not (root * root - radicand).zero:
                raise NoExactError("a root that is another's multiple at some places only")
            return root
        if len(self._own) == len(self.roots.seen):
            self.roots.seen.append({})
        self.roots.seen[len(self._own)][self._place] = not radicand.b, radicand.square
        root = radicand.root() * (1 - 2 * secrets.randbelow(2))
        if root.zero:
            raise NoRootError("a root that vanishes")
        self._own.append((radicand, root))
        return root

    def _relation(self, radicand: Element) -> KnownRoot:
        """Whether a radicand is a rational times one before, or times squares of positive numbers, or neither."""
        for k, (known, _) in enumerate(self._own):
            share = few_digits(radicand / known)
            if share is not None:
                return KnownRoot(False, k, share)
        one = Element(self.field.p, 1)
        before: list[tuple[int | None, Element]] = [(None, one), *((k, own[0]) for k, own in enumerate(self._own))]
        for (place, known), count in itertools.product(before, range(MOST + 1)):
            for factors in itertools.combinations_with_replacement(range(len(self.positive)), count):
                product = math.prod((self.positive[i] for i in factors), start=one)
                share = few_digits(radicand / (known * product * product))
                if share is not None:
                    return KnownRoot(False, place, share, factors)
        return KnownRoot(True)


class Sizing:
    """The same for degrees and heights: what `DrawnPlace` does, in the same order."""

    def __init__(self, mechanism: FileMechanism, roots: RootPlan, general: bool) -> None:
        self.roots, self._calls, self.guarded = roots, 0, False
        self._drawn = len(mechanism.parameters) + 16  # and a pose with its rates
        self._own: list[Size] = []
        self.given: dict[str, Any] = {}
        self.rates: dict[str, Size] = {}
        self.names = _drawn(mechanism, lambda: Size(1)) if general else mechanism.dimensions(self)

    def coordinate(self, name: str, angle: bool) -> Any:
        """A coordinate of the pose, with a rate."""
        self.rates[name] = Size(1)
        self.given[name] = AngleSum({_angle(name): Fraction(1)}) if angle else RatedNumber(Size(1), Size(1))
        return self.given[name]

    def number(self, value: Fraction) -> Size:
        """A rational."""
        return sizes.size(value)

    def radians(self, angle: AngleSum) -> Size:
        """None."""
        raise NoExactError(f"an angle as a plain number, of {', '.join(angle.shares)}")

    def circle(self, angle: AngleSum) -> tuple[Any, Any]:
        """Cosine and sine."""
        cosine, sine = sizes.circle(angle)
        if not any(_angle(name) in angle.shares for name in self.rates):
            return cosine, sine
        return RatedNumber(cosine, sine * Size(1)), RatedNumber(sine, cosine * Size(1))

    def root(self, radicand: Any) -> Any:
        """A root."""
        if isinstance(radicand, RatedNumber):
            root = self._root(radicand.value)
            return RatedNumber(root, radicand.rate if type(radicand.rate) is int else radicand.rate / (2 * root))
        if isinstance(radicand, (int, Fraction)):
            return sizes.size(radicand).root(None, 0)
        return self._root(radicand)

    def _root(self, radicand: Size) -> Size:
        plan = self.roots.plan[self._calls]
        self._calls += 1
        if plan.own:
            self._own.append(radicand.root(len(self._own), 0))
            return self._own[-1]
        share = sizes.size(plan.share).root(None, 0)
        if plan.factors or plan.before is None:
            name = None if plan.before is None else plan.before
            return radicand.root(name, self._drawn) * Size(0, self._drawn * radicand.degree)
        return self._own[plan.before] * share


def _drawn(mechanism: FileMechanism, uniform: Callable[[], Any]) -> dict[str, Any]:
    """Dimensions that are drawn: numbers, and angles by their names."""
    units = {name: unit for name, (_, unit) in mechanism.parameters.items()}
    return {name: AngleSum({name: Fraction(1)}) if unit else uniform() for name, unit in units.items()}


def _angle(name: str) -> str:
    """A coordinate of the pose among the names of angles, which no parameter can have."""
    return f" {name}"


class FormulaTape:
    """The operations of a certificate over any of these number types.

    Attributes:
        operations: as lists.
        order: the entries that are needed, in their order.
    """

    def __init__(self, operations: Sequence[Sequence[Any]], outputs: Sequence[int]) -> None:
        self.operations, needed = operations, set(outputs)
        for k in range(len(operations) - 1, -1, -1):
            name, *arguments = operations[k]
            if k in needed and name not in ("number", "coordinate"):
                needed.update(arguments)
        self.order = sorted(needed)

    def values(self, ns: DrawnPlace | Sizing, mechanism: FileMechanism, held: frozenset[str]) -> dict[int, Any]:
        """Every entry that is needed: numbers of the type, duals, rationals and angles."""
        values: dict[int, Any] = {}
        given: dict[str, Any] = {}
        for k in self.order:
            name, *arguments = self.operations[k]
            if name in ("number", "coordinate"):
                label = arguments[-1]
                if not label or label.startswith("sign "):  # of the mode that the certificate is about
                    values[k] = simplest(float.fromhex(arguments[0]))
                    continue
                if label not in given:
                    given[label] = _given(name, label, ns, mechanism, held)
                values[k] = given[label]
            else:
                values[k] = _applied(name, [values[a] for a in arguments], ns)
        return values


def _given(kind: str, label: str, ns: DrawnPlace | Sizing, mechanism: FileMechanism, held: frozenset[str]) -> Any:
    """What a label stands for: a coordinate of the pose, or a dimension."""
    if kind == "coordinate" or label in held:
        return ns.coordinate(label, label in ("phi", "theta", "psi"))
    if label in mechanism.parameters:
        return ns.names[label]
    part, _, angle = label.partition(" ")
    if part in CIRCLE and angle in mechanism.parameters:
        return ns.circle(ns.names[angle])[CIRCLE.index(part)]
    raise NoExactError(f"{label[:40]!r} is no dimension or coordinate")


def _applied(name: str, operands: list[Any], ns: DrawnPlace | Sizing) -> Any:
    if any(isinstance(part, RatedNumber) for part in operands) and name in ("*", "/"):
        a, b = (_dual(plain(part, ns)) for part in operands)
        return a * b if name == "*" else a / b
    if name in ("+", "-"):
        small = [isinstance(part, Fraction) and 0 < abs(part) < GUARD for part in operands]
        if any(small) and not all(small):
            ns.guarded = True
            return operands[0] if small[1] else operands[1] if name == "+" else _negative(operands[1])
        if any(isinstance(part, RatedNumber) for part in operands):
            a, b = (_dual(plain(part, ns)) for part in operands)
            return a + b if name == "+" else a - b
        return joined("+", operands[0], _negative(operands[1]) if name == "-" else operands[1], ns)
    if name in ("*", "/"):
        return joined(name, operands[0], operands[1], ns)
    if name == "negative":
        return _negative(operands[0])
    if name == "root":
        return ns.root(operands[0])
    if name in ("cosine", "sine") and isinstance(operands[0], AngleSum):
        return ns.circle(operands[0])[name == "sine"]
    raise NoExactError(f"{name} has no exact arithmetic")


def _negative(operand: Any) -> Any:
    return operand.times(Fraction(-1)) if isinstance(operand, AngleSum) else -operand
