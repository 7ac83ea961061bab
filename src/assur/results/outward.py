"""Proved bounds as text: rounded outwards, so that what is printed is proved too."""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal, localcontext

EXACTLY = 1100
"""Decimal digits that are enough for the difference of any two floats."""


def outward(low: float, high: float) -> tuple[str, str]:
    """Finite bounds to the second digit of their difference, rounded outwards.

    >>> outward(22810123.414, 22824645.233), outward(0.0, 0.0)
    (('22810000', '22825000'), ('0', '0'))
    """
    if not high > low:
        return f"{low:.17g}", f"{high:.17g}"
    with localcontext() as context:
        context.prec = EXACTLY
        step = Decimal(1).scaleb((Decimal(high) - Decimal(low)).adjusted() - 1)
        least = (Decimal(low) / step).to_integral_value(ROUND_FLOOR) * step
        most = (Decimal(high) / step).to_integral_value(ROUND_CEILING) * step
        if step.adjusted() < -15:
            return str(least.normalize()), str(most.normalize())
        return f"{least:f}", f"{most:f}"
