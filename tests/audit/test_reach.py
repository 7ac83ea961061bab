"""Search ranges: ends that are known in closed form, directions without an end, and ranges that cut off too much."""

import pytest

from assur.audit.reach import PrintedRange, extreme, range_rows
from assur.errors import UnknownNameError
from assur.model.registry import load_record

RECORD = load_record("zeng2019")


@pytest.mark.parametrize("mode", ["++-++", "-+-++", "+--++", "-----"])
def test_x_ends_where_a_cosine_is_one(mode):
    assert extreme(RECORD, "x", -1.0, mode) == pytest.approx(-130.0, abs=1e-6)
    assert extreme(RECORD, "x", 1.0, mode) == pytest.approx(80.0, abs=1e-6)


def test_y_has_no_end():
    assert extreme(RECORD, "y", 1.0, "++-++") is None


def test_a_fivebar_reaches_as_far_as_two_circles():
    """Both legs stretched: P is the highest point above the middle."""
    record = load_record("fivebar")
    p = record.values
    highest = ((p.l1 + p.l2) ** 2 - p.g**2) ** 0.5
    assert extreme(record, "y", 1.0, "-+") == pytest.approx(highest, abs=1e-6)


@pytest.mark.parametrize(
    ("low", "high", "verdicts"),
    [("-130", "80", ("ok", "ok")), ("-129", "80", ("wrong", "ok")), ("-131", "79", ("ok", "wrong"))],
)
def test_a_range_is_wrong_where_it_cuts_off_what_is_reached(low, high, verdicts):
    entry = PrintedRange(source="S", quantity="x", low=low, high=high)
    assert tuple(row.verdict for row in range_rows(RECORD, entry)) == verdicts


def test_an_unknown_coordinate_is_refused():
    with pytest.raises(UnknownNameError, match="there is: x, y, z"):
        range_rows(RECORD, PrintedRange(source="S", quantity="phi", low="0", high="1"))
