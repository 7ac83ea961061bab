from __future__ import annotations

import assur
from assur.cli.quantities import fixed, short, style_of, tiny


def test_seven_digits_of_the_size_of_the_mechanism():
    style = style_of(assur.load("zeng2019"))
    assert style.length(456.33154) == "456.3315"
    assert style.degrees(62.0) == "62.0000"


def test_what_does_not_exist_is_a_dash():
    assert [write(value) for write in (short, tiny) for value in (None, float("nan"), float("inf"))] == ["-"] * 6
    assert fixed(float("nan"), 2) == "-"


def test_no_number_fills_the_line():
    assert fixed(1e60, 4) == "1e+60"
