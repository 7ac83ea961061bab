"""Table 2 of Zeng et al. 2019, row by row: inputs at (-15.4714, 9.6849, 456.3315), row 3 of Table 1."""

PASSED = "the coaxial sliders P1 and P2 would have passed each other"
MOVING = "its status is self_motion"


def check(at, number, erratum, note):
    rows = at(f"Table 2 row {number}")
    assert list(rows) == ["yA1", "yA2", "yA3"]
    for row in rows.values():
        assert (row.verdict, row.erratum, row.note) == ("ok", erratum, note)
        assert abs(row.off_by) <= row.tolerance < 1e-3


def test_table2_row1(at):
    check(at, 1, "E6", MOVING)


def test_table2_row2(at):
    check(at, 2, "E6", MOVING)


def test_table2_row3(at):
    check(at, 3, "", "")


def test_table2_row4(at):
    check(at, 4, "", "")


def test_table2_row5(at):
    check(at, 5, "E6", PASSED)


def test_table2_row6(at):
    check(at, 6, "E6", PASSED)


def test_table2_row7(at):
    check(at, 7, "E6", MOVING)


def test_table2_row8(at):
    check(at, 8, "E6", MOVING)


def test_table2_has_every_real_inverse_solution(found):
    assert {row.source for row in found.rows if row.source.startswith("Table 2")} == {
        f"Table 2 row {k}" for k in range(1, 9)
    }


def test_number_of_inverse_solutions(at):
    assert at("Eqs. after (21)")["inverse solutions"].computed == 32
    assert at("Inverse solutions, real")["real inverse solutions"].computed == 8
    imaginary = at("Inverse solutions, imaginary")["imaginary inverse solutions"]
    assert (imaginary.printed, imaginary.computed, imaginary.verdict) == ("24", 24, "ok")
