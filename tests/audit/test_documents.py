"""Documents: generated, whole, and free of what only rounding decides."""

import re

import pytest

from assur.audit.audit import audit
from assur.audit.documents import computed_text, conformance_text, documents
from assur.audit.rows import Audit, Row
from assur.model.registry import load_record


def test_both_documents_are_made():
    made = documents(audit(load_record("fivebar")))
    assert list(made) == ["ERRATA.md", "CONFORMANCE.md"]
    assert all(text.startswith("# ") for text in made.values())


def test_every_row_stands_in_the_table():
    rows = tuple(Row(f"Table {k} row 1", "x", "1.00", 1.0, "ok", tolerance=0.01, off_by=0.0) for k in range(5))
    text = conformance_text(Audit("m", "paper", "printed", rows, ()))
    assert re.findall(r"^## (.*)", text, re.MULTILINE) == [f"Table {k}" for k in range(5)]
    assert all(f"| {row.source} |" in text for row in rows)


def test_a_bar_in_a_cell_does_not_break_the_table():
    row = Row("Eq. (1)", "left - right", "|AB| = 2", 1e-12, "ok", tolerance=1e-9, off_by=1e-12)
    line = next(line for line in conformance_text(Audit("m", "p", "printed", (row,), ())).splitlines() if "AB" in line)
    assert len(re.split(r"(?<!\\)\|", line)) == 11


@pytest.mark.parametrize(
    ("row", "text"),
    [
        (Row("S", "q", "12.3400", 12.34004, "ok", tolerance=1e-3, off_by=-4e-5), "12.3400"),
        (Row("S", "q", "", -58.20992585, "missing"), "-58.2099"),
        (Row("S", "q", "0.000000", -7e-15, "ok", tolerance=1e-6, off_by=7e-15), "0.000000"),
        (Row("S", "q", "left = right", 3.2e-12, "ok", tolerance=1e-9, off_by=3.2e-12), "0"),
        (Row("S", "q", "32", 32, "ok", tolerance=0.0, off_by=0.0), "32"),
        (Row("S", "q", "480", 463.8357, "ok", tolerance=0.5, off_by=16.2), "463.8357"),
        (Row("S", "q", "250", None, "ok"), "none"),
        (Row("S", "q", "t3 r0", "t3 r0", "ok"), "t3 r0"),
    ],
)
def test_numbers_are_written_to_the_printed_digits(row, text):
    assert computed_text(row) == text


def test_the_same_audit_gives_the_same_text():
    row = Row("S", "q", "1", 1.0, "ok")
    assert documents(Audit("m", "p", "printed", (row,), ())) == documents(Audit("m", "p", "printed", (row,), ()))
