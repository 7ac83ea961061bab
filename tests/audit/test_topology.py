"""Printed POC sets and loops beside the engine's: right ones are ok, and every wrong word or number is found."""

import dataclasses

import pytest

from assur.audit.audit import reference_of
from assur.audit.topology import PrintedDecomposition, PrintedPocSet, decomposition_rows, poc_rows
from assur.errors import UnknownNameError, UsageError
from assur.model.registry import load_record

RECORD = load_record("zeng2019")
LOOP1 = ("P1", "B1", "C1", "C2", "B2", "P2")
LOOP2 = ("D1", "D2", "Pa2", "Pa1", "P3")
HSOC1 = (*LOOP1, "D1", "D2")
NUMBERS = ("freedoms", "inputs", "xi", "delta", "loop_count", "freedom", "kappa")


def row_of(poc, link, joints=(), **more):
    entry = PrintedPocSet(
        source="S", quantity="POC set", printed="p", poc=poc, link=link, joints=joints, erratum="E1", **more
    )
    (row,) = poc_rows(RECORD, entry)
    return row


def loops(**changed):
    """The decomposition of the paper with some numbers changed, "xi" that of the first loop."""
    first = {"name": "L1", "joints": LOOP1, "freedoms": "6", "inputs": "2", "xi": "3", "delta": "1"}
    second = {"name": "L2", "joints": LOOP2, "freedoms": "5", "inputs": "1", "xi": "5", "delta": "-1"}
    rest = {"loop_count": "2", "freedom": "3", "kappa": "1"}
    for part in (first, rest):
        part |= {name: value for name, value in changed.items() if name in part}
    return PrintedDecomposition(sources=dict.fromkeys(NUMBERS, "S"), loops=(first, second), **rest)


# ---- POC sets --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("poc", "link", "joints", "more"),
    [
        ("t2 r1", "link11", LOOP1, {"t_normal": "B1", "r_axes": ["B1"]}),
        ("t2 r1", "link11", LOOP1, {"t_normal": "C2", "r_axes": ["C1", "B2"]}),
        ("t2 r1", "platform", ("D1", "D2"), {"base": "link11", "t_normal": "R3", "r_axes": ["D2"]}),
        ("t3 r2", "platform", HSOC1, {"r_axes": ["B1", "D1"]}),
        ("t2 r0", "linkS", ("P3", "Pa1"), {"t_normal": "B3a"}),
        ("t1 r0", "slider3", ("P3",), {"t_axes": ["P3"]}),
        ("t3 r1", "base", (*LOOP2[:-1], "P3"), {"base": "link11", "opened": "P3", "r_axes": ["D1"]}),
    ],
)
def test_right_directions_are_ok(poc, link, joints, more):
    row = row_of(poc, link, joints, **more)
    assert (row.verdict, row.erratum) == ("ok", "")
    assert row.note.count("as printed") == sum(name in more for name in ("t_axes", "t_normal", "r_axes"))


@pytest.mark.parametrize(
    ("poc", "link", "joints", "more"),
    [
        ("t2 r0", "link11", LOOP1, {}),
        ("t3 r1", "platform", HSOC1, {}),
        ("t3 r2", "platform", HSOC1, {"r_axes": ["B1"]}),
        ("t3 r2", "platform", HSOC1, {"r_axes": ["D1", "D2"]}),
        ("t2 r1", "link11", LOOP1, {"t_normal": "P1"}),
        ("t2 r1", "link11", LOOP1, {"r_axes": ["P1"]}),
        ("t1 r0", "linkS", ("Pa1",), {"base": "slider3", "t_axes": ["B3a"]}),
        ("t2 r0", "linkS", ("P3", "Pa1"), {"t_axes": ["P3"]}),
    ],
)
def test_wrong_numbers_and_directions_are_found(poc, link, joints, more):
    row = row_of(poc, link, joints, **more)
    assert (row.verdict, row.erratum) == ("wrong", "E1")
    assert ("does not hold" in row.note) == bool({"t_axes", "t_normal", "r_axes"} & set(more))


def test_a_row_shows_the_matrix_and_how_it_is_known():
    row = row_of("t3 r2", "platform", HSOC1)
    assert row.computed.startswith("[t^3; r^2(||<>(")
    assert row.note.startswith("dim 5; by the rules and by rank of twists")
    assert "dim 2, one element not independent" in row_of("t2 r1", "platform", ("D1", "D2"), base="link11").note
    rod = row_of("t1 r1", "link4a", ("Pa1",), base="slider3")
    assert rod.verdict == "ok"
    assert "the rules refuse: " in rod.note


def test_a_direction_along_a_joint_outside_the_part_is_refused():
    with pytest.raises(UnknownNameError, match="P3"):
        row_of("t2 r1", "link11", LOOP1, t_axes=["P3"])


# ---- loops -----------------------------------------------------------------------------------------------------


def test_the_paper_s_loops_are_right():
    rows = decomposition_rows(RECORD, loops())
    assert [row.verdict for row in rows] == ["ok"] * 11
    assert next(row.note for row in rows if row.quantity == "kappa").endswith("the least of all orders of loops")


def test_they_are_those_of_the_reference_data():
    (entry,) = reference_of(RECORD).entries["decomposition"]
    assert [row.computed for row in decomposition_rows(RECORD, entry)] == [
        row.computed for row in decomposition_rows(RECORD, loops())
    ]


@pytest.mark.parametrize(
    ("changed", "quantity", "computed"),
    [
        ({"freedoms": "7"}, "sum of f, L1", 6),
        ({"inputs": "1"}, "I, L1", 2),
        ({"xi": "4"}, "xi, L1", 3),
        ({"delta": "0"}, "Delta, L1", 1),
        ({"loop_count": "4"}, "v", 2),
        ({"freedom": "4"}, "F", 3),
        ({"kappa": "0"}, "kappa", 1),
    ],
)
def test_a_wrong_number_is_found(changed, quantity, computed):
    wrong = {row.quantity: row.computed for row in decomposition_rows(RECORD, loops(**changed)) if row.verdict != "ok"}
    assert wrong == {quantity: computed}


def test_another_order_of_loops_has_other_numbers_and_the_same_kappa():
    outer = {
        "name": "L1",
        "joints": ("P1", "B1", "C1", *LOOP2),
        "freedoms": "8",
        "inputs": "2",
        "xi": "5",
        "delta": "1",
    }
    inner = {"name": "L2", "joints": ("C2", "B2", "P2"), "freedoms": "3", "inputs": "1", "xi": "3", "delta": "-1"}
    rest = {"loop_count": "2", "freedom": "3", "kappa": "1"}
    entry = PrintedDecomposition(sources=dict.fromkeys(NUMBERS, "S"), loops=(outer, inner), **rest)
    assert {row.verdict for row in decomposition_rows(RECORD, entry)} == {"ok"}


def test_too_few_inputs_leave_no_kappa():
    rows = decomposition_rows(dataclasses.replace(RECORD, inputs=RECORD.inputs[:2]), loops())
    kappa = next(row for row in rows if row.quantity == "kappa")
    assert (kappa.computed, kappa.verdict, kappa.off_by) == (None, "wrong", None)


def test_loops_that_are_not_those_of_the_joint_graph_are_refused():
    entry = loops()
    with pytest.raises(UsageError, match="in no loop of the order"):
        decomposition_rows(RECORD, entry.model_copy(update={"loops": entry.loops[:1]}))
    broken = entry.loops[1].model_copy(update={"joints": ("D1",)})
    with pytest.raises(UsageError, match="whole chains"):
        decomposition_rows(RECORD, entry.model_copy(update={"loops": (entry.loops[0], broken)}))
    unknown = entry.loops[1].model_copy(update={"joints": ("P9",)})
    with pytest.raises(UnknownNameError, match="P9"):
        decomposition_rows(RECORD, entry.model_copy(update={"loops": (entry.loops[0], unknown)}))
