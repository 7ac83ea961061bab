"""Numbers as plain text: a hyphen for a minus, a dash for what does not exist."""

from __future__ import annotations

import math

ROUNDING = 1e-9
"""An error below this share of its value is that of rounding."""


def fixed(value: float | None, decimals: int) -> str:
    """A number with so many decimals, "-" where it does not exist, and no minus before zero.

    >>> fixed(-0.00001, 4), fixed(None, 4)
    ('0.0000', '-')
    """
    if value is None or not math.isfinite(value):
        return "-"
    text = f"{value:.{decimals}f}" if abs(value) < 1e12 else f"{value:.10g}"
    return text.lstrip("-") if float(text) == 0 else text


def short(value: float | None) -> str:
    """A number with six digits, "-" where it does not exist.

    >>> short(8575323.816748314)
    '8.57532e+06'
    """
    return "-" if value is None or not math.isfinite(value) else f"{value:.6g}"


def tiny(value: float | None) -> str:
    """A residual with two digits, "-" where it does not exist."""
    return "-" if value is None or not math.isfinite(value) else f"{value:.1e}"


def with_error(value: float, error: float) -> str:
    """A value and its error, both to the second digit of the error; what is exact but for rounding to ten digits.

    >>> with_error(22813484.36, 3684.24), with_error(2.0, 0.0), with_error(1.9999999999999911, 8.9e-15)
    ('22813500 ± 3700', '2 ± 0', '2 ± 8.9e-15')
    """
    if error <= ROUNDING * abs(value) or not math.isfinite(error):
        return f"{value:.10g} ± {error:.2g}"
    decimals = 1 - math.floor(math.log10(error))
    if decimals > 0:
        return f"{value:.{decimals}f} ± {error:.{decimals}f}"
    return f"{round(value, decimals):.0f} ± {round(error, decimals):.0f}"


def count(number: int, noun: str) -> str:
    """A number of things.

    >>> count(1, "solution"), count(4, "branch")
    ('1 solution', '4 branches')
    """
    ending = "es" if noun.endswith(("ch", "s", "x")) else "s"
    return f"{number} {noun}" if number == 1 else f"{number} {noun}{ending}"


def signed(value: int) -> str:
    """A whole number with its sign, which zero has not.

    >>> signed(-1), signed(0), signed(2)
    ('-1', '0', '+2')
    """
    return f"{value:+d}" if value else "0"


def size_text(count: int) -> str:
    """Bytes as a person reads them.

    >>> size_text(900), size_text(52_000_000), size_text(25 * 10**9)
    ('900 bytes', '52.0 MB', '25.0 GB')
    """
    for size, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if count >= size:
            return f"{count / size:.1f} {name}"
    return f"{count} bytes"
