"""Numbers as typeset text: true minus signs, digits in groups, powers of ten and of units raised."""

from __future__ import annotations

import math

from assur.results import plain_text
from assur.results.outward import outward
from assur.results.plain_text import ROUNDING

NOTHING = "–"
SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
THIN = "\u202f"


def fixed(value: float | None, decimals: int) -> str:
    """A number with so many decimals and a true minus; a dash where it does not exist.

    >>> fixed(-0.00001, 4), fixed(None, 4), fixed(-1.5, 1)
    ('0.0000', '–', '−1.5')
    """
    if value is None or not math.isfinite(value):
        return NOTHING
    return minus(plain_text.fixed(value, decimals))


def short(value: float | None, digits: int = 6) -> str:
    r"""A number to some digits, powers of ten written out.

    >>> short(0.5), short(8575323.8), short(1.3e-13, 2), short(1234567890.0)
    ('0.5', '8\u202f575\u202f320', '1.3·10⁻¹³', '1.23457·10⁹')
    """
    if value is None or not math.isfinite(value):
        return NOTHING
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if -5 < exponent < 9:
        rounded = round(value, digits - 1 - exponent)
        text = f"{rounded:.{max(0, digits - 1 - exponent)}f}"
        return minus(grouped(text.rstrip("0").rstrip(".") if "." in text else text))
    mantissa, _, power = f"{value:.{digits - 1}e}".partition("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return minus(f"{mantissa}·10{str(int(power)).translate(SUPERSCRIPTS)}")


def with_error(value: float, error: float) -> str:
    r"""A value and its error, both to the second digit of the error.

    >>> with_error(22813484.36, 3684.24), with_error(0.142353, 0.00019)
    ('22\u202f813\u202f500 ± 3700', '0.14235 ± 0.00019')
    """
    if error <= ROUNDING * abs(value) or not math.isfinite(error):
        return short(value)
    decimals = 1 - math.floor(math.log10(error))
    both = (f"{round(number, decimals):.{max(0, decimals)}f}" for number in (value, error))
    return " ± ".join(minus(grouped(text)) for text in both)


def bounds(low: float, high: float) -> str:
    r"""Proved bounds to the second digit of their difference, rounded outwards so that they stay bounds.

    >>> bounds(22814087.41, 22816107.86), bounds(0.1125, 0.1125), bounds(2.82893, 2.85454)
    ('22\u202f814\u202f000 to 22\u202f816\u202f200', '0.1125', '2.828 to 2.855')
    >>> bounds(10053.096491487308, 10053.096491487359)
    '10\u202f053.096481 to 10\u202f053.096502'
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        return NOTHING
    if low == high:
        return short(low)
    least = ROUNDING * max(abs(low), abs(high))
    if high - low < least:  # digits of rounding only
        low, high = low - least, high + least
    return " to ".join(minus(text if "E" in text else grouped(text)) for text in outward(low, high))


def grouped(text: str) -> str:
    """Digits before the point in groups of three, from five digits on."""
    whole, point, rest = text.partition(".")
    sign = "-" if whole.startswith("-") else ""
    digits = whole.lstrip("-")
    return f"{sign}{f'{int(digits):,}'.replace(',', THIN) if len(digits) > 4 else digits}{point}{rest}"


def minus(text: str) -> str:
    """A number or a mode as text with minus signs as wide as plus signs.

    >>> minus(f"{-2.5:g}"), minus("+-+")
    ('−2.5', '+−+')
    """
    return text.replace("-", "−")


def shown_unit(unit: str) -> str:
    """A unit with its powers as superscripts, degrees as their sign.

    >>> shown_unit("mm^3")
    'mm³'
    """
    base, _, power = unit.partition("^")
    return base + power.translate(SUPERSCRIPTS)
