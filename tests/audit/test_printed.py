"""Printed digits: value, last place, and what is no printed number."""

import pytest

from assur.audit.printed import Printed
from assur.errors import UsageError


@pytest.mark.parametrize(
    ("text", "value", "half_unit", "decimals"),
    [
        ("64.6353", 64.6353, 5e-5, 4),
        ("-128.8290", -128.829, 5e-5, 4),
        ("8", 8.0, 0.5, 0),
        ("+0.10", 0.1, 5e-3, 2),
        ("-0", 0.0, 0.5, 0),
    ],
)
def test_digits_say_value_and_last_place(text, value, half_unit, decimals):
    digits = Printed(text)
    assert (digits.value, digits.half_unit, digits.decimals) == (value, half_unit, decimals)


@pytest.mark.parametrize("text", ["", "1,5", "1e3", " 1", "nan", "inf", "1.", ".5", "--1", "0x1", "١"])
def test_other_text_is_refused(text):
    with pytest.raises(UsageError, match="no printed number"):
        Printed(text)
