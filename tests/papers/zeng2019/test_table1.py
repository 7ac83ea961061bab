"""Table 1 of Zeng et al. 2019, row by row: poses at (162.6907, -143.3209, -24.6776)."""

import re
from pathlib import Path

import pytest

INPUTS = [162.6907, -143.3209, -24.6776]


def verdicts(rows):
    return {name: (row.verdict, row.erratum) for name, row in rows.items()}


def test_table1_row1(at):
    rows = at("Table 1 row 1")
    assert verdicts(rows) == dict.fromkeys("xyz", ("wrong", "E2"))
    assert "no solution: needs |B2C2| = 365.40 instead of 280" in rows["x"].note
    assert rows["y"].off_by == pytest.approx(166.0116, abs=1e-4)


def test_table1_row2(at):
    rows = at("Table 1 row 2")
    assert verdicts(rows) == dict.fromkeys("xyz", ("wrong", "E2"))
    assert "no solution: needs |B2C2| = 365.40 instead of 280" in rows["x"].note


def test_table1_row3(at):
    rows = at("Table 1 row 3")
    assert verdicts(rows) == dict.fromkeys("xyz", ("ok", ""))
    assert all(abs(row.off_by) <= row.tolerance < 1.1e-4 for row in rows.values())


def test_table1_row4(at):
    rows = at("Table 1 row 4")
    assert verdicts(rows) == {"x": ("wrong", "E3"), "y": ("ok", ""), "z": ("ok", "")}
    assert rows["x"].printed == "-128.8290"
    assert rows["x"].computed == pytest.approx(-83.0873, abs=5e-5)


@pytest.mark.parametrize(
    ("source", "pose"),
    [("Table 1 missing 1", (-83.0873, 9.6849, -58.2099)), ("Table 1 missing 2", (-15.4714, 9.6849, -396.3315))],
)
def test_table1_missing(at, source, pose):
    rows = at(source)
    assert verdicts(rows) == dict.fromkeys("xyz", ("missing", "E4"))
    assert [row.computed for row in rows.values()] == pytest.approx(pose, abs=5e-5)
    assert {row.printed for row in rows.values()} == {""}


def test_no_other_row(found):
    sources = {row.source for row in found.rows if row.source.startswith("Table 1")}
    assert sources == {*(f"Table 1 row {k}" for k in range(1, 5)), "Table 1 missing 1", "Table 1 missing 2"}


def test_every_row_has_a_test_with_its_address():
    text = Path(__file__).read_text(encoding="utf-8")
    assert re.findall(r"^def test_table1_row(\d)", text, re.MULTILINE) == list("1234")
