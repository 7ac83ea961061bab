"""Tables of solutions: which solution a row means, what it breaks, and what the table leaves out."""

import numpy as np
import pytest

from assur.audit.audit import reference_entry
from assur.audit.printed import Printed
from assur.audit.tables import PrintedTable, Requirement, TableRow, direct_rows, inverse_rows
from assur.audit.tolerance import tolerances
from assur.errors import UsageError
from assur.kinematics.position import direct, inverse
from assur.model.registry import load_record

RECORD = load_record("zeng2019")
INPUTS = ("162.6907", "-143.3209", "-24.6776")
SOLUTIONS = [solution.pose for solution in direct(RECORD, [float(text) for text in INPUTS])]


def table(*lines, given=INPUTS, **more):
    rows = [TableRow(row=str(k), values=tuple(line), erratum="E1") for k, line in enumerate(lines, start=1)]
    return PrintedTable(source="T", given=given, rows=tuple(rows), **more)


def digits(values, places=4):
    return [f"{value:.{places}f}" for value in values]


def test_a_complete_table_has_neither_wrong_nor_missing_rows():
    rows = direct_rows(RECORD, table(*map(digits, SOLUTIONS)))
    assert {row.verdict for row in rows} == {"ok"}
    assert len(rows) == 12


@pytest.mark.parametrize("left_out", range(4))
def test_a_solution_that_is_left_out_is_missing(left_out):
    listed = [digits(pose) for k, pose in enumerate(SOLUTIONS) if k != left_out]
    missing = [row.computed for row in direct_rows(RECORD, table(*listed)) if row.verdict == "missing"]
    assert missing == pytest.approx(list(SOLUTIONS[left_out]), abs=1e-9)


def test_one_wrong_coordinate_of_three_still_claims_the_solution():
    lines = [digits(pose) for pose in SOLUTIONS]
    lines[2][0] = "0.0000"
    rows = direct_rows(RECORD, table(*lines))
    assert [(row.source, row.quantity) for row in rows if row.verdict != "ok"] == [("T row 3", "x")]


def test_two_wrong_coordinates_do_not():
    lines = [digits(pose) for pose in SOLUTIONS]
    lines[2][0] = lines[2][2] = "0.0000"
    rows = direct_rows(RECORD, table(*lines))
    assert [row.source for row in rows if row.verdict == "missing"] == ["T missing 1"] * 3


def test_a_unit_in_the_last_place_decides():
    lines = [digits(pose) for pose in SOLUTIONS]
    lines[0][0] = f"{float(lines[0][0]) + 2e-4:.4f}"
    assert [row.quantity for row in direct_rows(RECORD, table(*lines)) if row.verdict == "wrong"] == ["x"]


def test_a_solution_that_stands_twice_is_said():
    rows = direct_rows(RECORD, table(*map(digits, [*SOLUTIONS, SOLUTIONS[0]])))
    assert {row.note for row in rows if row.source == "T row 5"} == {"the same solution as row 1"}


def test_what_a_row_breaks_is_named():
    rows = direct_rows(RECORD, table(("64.6353", "175.6965", "370.1818")))
    assert "needs |B2C2| = 365.40 instead of 280" in rows[0].note
    unreachable = direct_rows(RECORD, table(("500.0000", "9.6849", "456.3315")))
    assert "out of reach" in unreachable[0].note


def test_a_requirement_is_judged_on_the_joint_graph():
    entry = reference_entry(RECORD, "inverse", "Table 2")
    never = Requirement(positive="C1.z - 1000", otherwise="too low")
    rows = inverse_rows(RECORD, entry.model_copy(update={"requires": (never,)}))
    assert all("too low" in row.note for row in rows)


def test_wrong_number_of_values_is_refused():
    with pytest.raises(UsageError, match="2 values, 3 wanted"):
        direct_rows(RECORD, table(("1.0", "2.0")))


def test_a_problem_without_solution_is_refused():
    with pytest.raises(UsageError, match="no real solution"):
        direct_rows(RECORD, table(("1.0", "2.0", "3.0"), given=("2000.0", "0.0", "0.0")))


def test_angles_are_compared_up_to_turns():
    record = load_record("fivebar")
    solutions = [np.degrees(item.inputs) for item in inverse(record, [0.0, 224.0])]
    lines = [digits([values[0] + 360.0, values[1] - 720.0], 6) for values in solutions]
    rows = inverse_rows(record, table(*lines, given=("0.000000", "224.000000")))
    assert {row.verdict for row in rows} == {"ok"}
    assert {row.unit for row in rows} == {"deg"}
    assert rows[0].computed > 180.0


# ---- tolerance -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("place", range(3))
def test_tolerance_is_what_the_last_places_can_move(place):
    """Against differences: each input moved by half a unit, one at a time."""
    found = next(iter(direct(RECORD, [float(text) for text in INPUTS])))
    given, results = [Printed(text) for text in INPUTS], [Printed("1.00")] * 3
    allowed = tolerances(RECORD, "direct", found.pose, found.working_mode, given, results)
    moved = 0.0
    for k, item in enumerate(given):
        step = np.zeros(3)
        step[k] = item.half_unit
        there = direct(RECORD, [g.value for g in given] + step, found.assembly_mode).poses[0]
        moved += abs(there[place] - found.pose[place])
    assert allowed[place] == pytest.approx(0.005 + moved, rel=1e-4, abs=1e-9)


def test_without_sensitivity_only_the_own_digits_count():
    given, results = [Printed(text) for text in INPUTS], [Printed("1.00")] * 3
    allowed = tolerances(RECORD, "direct", SOLUTIONS[0], "+0-++", given, results)
    assert allowed == pytest.approx([0.005] * 3)
