from types import SimpleNamespace

from assur.audit.rows import Row
from assur.report.sections.printed import solutions_beside, verdict


def row(line, quantity, printed, computed, what, erratum="", note=""):
    return Row(f"Table 9 {line}", quantity, printed, computed, what, erratum, note=note)


def test_one_line_for_each_printed_line_and_for_each_that_is_left_out():
    rows = [
        row("row 1", "x", "1.0", 1.0, "ok"),
        row("row 1", "y", "-2.0", -3.0, "wrong", "E1", "too far"),
        row("row 2", "x", "5.0", 1.0, "wrong", "E2"),
        row("row 2", "y", "6.0", -3.0, "wrong", "E2"),
        row("missing 1", "x", "", 7.00006, "missing", "E4"),
        row("missing 1", "y", "", -8.123456, "missing", "E4"),
        Row("Table 8 row 1", "x", "1", 1, "ok"),
    ]
    found = solutions_beside(SimpleNamespace(given="printed"), SimpleNamespace(source="Table 9"), rows)
    assert found.columns == ("line", "x printed", "x computed", "y printed", "y computed", "verdict", "why")
    assert found.marks == ("wrong", "wrong", "missing")
    assert found.rows[0] == ("row 1", "1.0", "1.0", "−2.0", "−3.0", "wrong in y, see E1", "")
    assert found.rows[1][5] == "wrong, see E2"
    assert found.rows[2][:5] == ("missing 1", None, "7.0001", None, "−8.1235")


def test_a_verdict_names_its_erratum():
    assert verdict(row("row 1", "x", "1", 1, "ok")) == "ok"
    assert verdict(row("row 1", "x", "1", 1, "ok", "E6")) == "ok, see E6"
