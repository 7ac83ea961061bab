import numpy as np
import pytest

from assur.errors import UnknownNameError
from assur.synthesis.virtual_chains import TURNS, VIRTUAL_CHAINS, rows_named

ROWS = [row for rows in VIRTUAL_CHAINS.values() for row in rows]


def test_a_name_means_all_of_its_rows_and_one_can_be_asked_for():
    assert [row.row for row in rows_named("2T1R")] == ["E", "PPR", "RPP"]
    assert [row.row for row in rows_named(" 2t1r:rpp ")] == ["RPP"]


@pytest.mark.parametrize(("text", "known"), [("6T", "1T1R, 1T2R"), ("1T2R:XYZ", "1T2R:PU, 1T2R:RPR, 1T2R:UP")])
def test_another_name_or_row_is_refused(text, known):
    with pytest.raises(UnknownNameError, match=known):
        rows_named(text)


@pytest.mark.parametrize("row", ROWS, ids=[f"{row.name} {row.row}" for row in ROWS])
def test_a_row_has_as_many_translations_and_rotations_as_its_name_says(row):
    """Pure translations that are left where nothing turns, and independent rotations, by its own twists at home."""
    assert row.name == "".join(f"{count}{kind}" for count, kind in zip(_numbers(row), "TR", strict=True) if count)
    assert row.poc.dim == row.dim == len(row.series.axes[0])


def _numbers(row):
    twists = row.series.at(np.zeros((1, row.dim)))[2][0]
    turns = np.linalg.matrix_rank(twists[:3])
    return row.dim - turns, turns


@pytest.mark.parametrize("row", ROWS, ids=[f"{row.name} {row.row}" for row in ROWS])
def test_turned_by_its_symmetry_a_virtual_chain_follows_itself(row):
    from assur.synthesis.placed_series import following

    for turn in TURNS[row.symmetry]:
        reached, _ = following(row.series.turned(turn), row.series, row.values)
        assert reached.all()
