from assur.results.plain_text import fixed, short, tiny


def test_what_does_not_exist_is_a_dash():
    assert [write(value) for write in (short, tiny) for value in (None, float("nan"), float("inf"))] == ["-"] * 6
    assert fixed(float("nan"), 2) == "-"


def test_no_number_fills_the_line():
    assert fixed(1e60, 4) == "1e+60"
