"""The normal form in which a recorded formula is written: a sum of products, in the order of the kernel.

Sums inside sums and products inside products are joined, numbers go to the front of a product and
fractions become one fraction; nothing is multiplied out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from assur.report.formulas.trace import Traced

WORD = 4
"""A name with more letters is a word; it stands after the letters."""


@dataclass(frozen=True)
class Power:
    """A letter, a root or a bracket, to a whole power."""

    base: Traced
    exponent: int


@dataclass(frozen=True)
class Product:
    """coefficient * product of `above` / product of `below`."""

    coefficient: Fraction
    above: tuple[Power, ...]
    below: tuple[Power, ...]


def summands(term: Traced) -> tuple[Product, ...]:
    """A formula as a sum of products; like ones are added up, and one that is positive comes first."""
    products: list[Product] = []
    for new in _products(term, 1):
        for place, old in enumerate(products):
            if _keys(old) == _keys(new):
                products[place] = Product(old.coefficient + new.coefficient, old.above, old.below)
                break
        else:
            products.append(new)
    kept = [product for product in products if product.coefficient]
    first = next((place for place, product in enumerate(kept) if product.coefficient > 0), 0)
    return (kept[first], *kept[:first], *kept[first + 1 :]) if kept else ()


def key(term: Traced) -> str:
    """The same text for the same formula."""
    if term.letter is not None:
        return f"{term.letter.function} {term.letter.name}"
    if term.operator == "number":
        return str(term.values[0].real)
    return f"({term.operator} {' '.join(key(part) for part in term.parts)})"


def _keys(product: Product) -> tuple[list[tuple[str, int]], list[tuple[str, int]]]:
    above, below = (
        sorted((key(power.base), power.exponent) for power in side) for side in (product.above, product.below)
    )
    return above, below


def _products(term: Traced, sign: int) -> list[Product]:
    """The products of a sum; a bracket that nothing multiplies is opened."""
    products: list[Product] = []
    for part_sign, part in _split_sum(term, sign):
        new = _product(part, part_sign)
        inner = new.above[0] if len(new.above) == 1 and not new.below else None
        if inner and abs(new.coefficient) == 1 and inner.exponent == 1 and inner.base.operator in ("+", "-"):
            products += _products(inner.base, int(new.coefficient))
        else:
            products.append(new)
    return products


def _split_sum(term: Traced, sign: int) -> list[tuple[int, Traced]]:
    if term.operator == "neg":
        return _split_sum(term.parts[0], -sign)
    if term.operator in ("+", "-"):
        first, second = term.parts
        return _split_sum(first, sign) + _split_sum(second, sign if term.operator == "+" else -sign)
    return [(sign, term)]


def _product(term: Traced, sign: int) -> Product:
    coefficient = Fraction(sign)
    sides: tuple[list[Traced], list[Traced]] = ([], [])
    roots: tuple[dict[str, Traced], dict[str, Traced]] = ({}, {})
    pending = [(term, 0)]
    while pending:
        part, side = pending.pop(0)
        if part.operator == "*":
            pending[:0] = [(factor, side) for factor in part.parts]
        elif part.operator == "/":
            pending[:0] = [(part.parts[0], side), (part.parts[1], 1 - side)]
        elif part.operator == "neg":
            coefficient = -coefficient
            pending.insert(0, (part.parts[0], side))
        elif part.operator == "number":
            value = Fraction(float(part.values[0].real)).limit_denominator(10**6)
            coefficient = coefficient / value if side else coefficient * value
        elif part.operator == "sqrt" and key(part) in roots[side]:
            del roots[side][key(part)]
            pending.insert(0, (part.parts[0], side))  # the square of a root
        elif part.operator == "sqrt":
            roots[side][key(part)] = part
        else:
            sides[side].append(part)
    above, below = (_powers([*side, *left.values()]) for side, left in zip(sides, roots, strict=True))
    return Product(coefficient, above, below)


def _powers(factors: Sequence[Traced]) -> tuple[Power, ...]:
    """Equal factors as powers: signs first, then letters, functions, brackets and roots."""
    equal: dict[str, list[Traced]] = {}
    for factor in factors:
        equal.setdefault(key(factor), []).append(factor)
    powers = [Power(same[0], len(same)) for same in equal.values()]
    return tuple(sorted(powers, key=lambda power: _rank(power.base)))


def _rank(term: Traced) -> int:
    if term.letter is not None:
        word = len(term.letter.name) > WORD
        return {"sgn": 0, "": 2 if word else 1}.get(term.letter.function, 3)
    return 5 if term.operator == "sqrt" else 4


def text(term: Traced) -> str:
    """A formula on one line of plain text."""
    parts = []
    for place, product in enumerate(summands(term)):
        sign = (
            ("-" if product.coefficient < 0 else "") if place == 0 else f" {'-' if product.coefficient < 0 else '+'} "
        )
        parts.append(sign + _product_text(product))
    return "".join(parts) or "0"


def _product_text(product: Product) -> str:
    size = abs(product.coefficient)
    above, below = _side_text(size.numerator, product.above), _side_text(size.denominator, product.below)
    if below == "1":
        return above
    return f"{above}/({below})" if " " in below else f"{above}/{below}"


def _side_text(whole: int, powers: Sequence[Power]) -> str:
    return " ".join(([] if whole == 1 and powers else [str(whole)]) + [_power_text(power) for power in powers])


def _power_text(power: Power) -> str:
    base = power.base
    if base.letter is not None:
        word = f"{base.letter.function} {base.letter.name}".strip()
        word = f"({word})" if base.letter.function and power.exponent > 1 else word
    elif base.operator == "sqrt":
        word = f"sqrt({text(base.parts[0])})"
    else:
        word = f"({text(base)})"
    return word if power.exponent == 1 else f"{word}^{power.exponent}"
