"""A printed number: its digits as text, and how well they say the number."""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Decimal

from assur.errors import UsageError

_DIGITS = re.compile(r"[+-]?[0-9]+(\.[0-9]+)?")


@dataclass(frozen=True)
class Printed:
    """A number as it stands in a source. The text is the datum; nothing is rounded on the way.

    Errors:
        UsageError: the text is no decimal number.

    Example:
        >>> row = Printed("-15.4714")
        >>> row.value, row.half_unit, row.decimals
        (-15.4714, 5e-05, 4)
    """

    text: str

    def __post_init__(self) -> None:
        if not _DIGITS.fullmatch(self.text):
            raise UsageError(f"'{self.text}' is no printed number", hint="digits with a point, as text: '-15.4714'")

    @property
    def value(self) -> float:
        """The float nearest to the digits."""
        return float(self.text)

    @property
    def decimals(self) -> int:
        """Number of digits after the point."""
        return len(self.text.partition(".")[2])

    @property
    def half_unit(self) -> float:
        """Half a unit of the last place: by how much a rightly rounded number may be off."""
        return float(Decimal(5).scaleb(-self.decimals - 1))
