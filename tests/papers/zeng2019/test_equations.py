"""The printed equations and topology of Zeng et al. 2019, by address, and that no row is without a test."""

import pytest

EQUATIONS = {
    "Eqs. before (7)": 2, "Eq. (7)": 1, "Eqs. after (7)": 2, "Eq. (8)": 1, "Eqs. after (8)": 1,
    "Eq. (9), lower sign": 1, "Eqs. before (10)": 2, "Eq. (10)": 1, "Eqs. before (11)": 3, "Eq. (11)": 1,
    "Eq. (12)": 1, "Eq. (14)": 1, "Eq. (15)": 1, "Eq. (16)": 1, "Eqs. before (17)": 1, "Eq. (17)": 1,
    "Eq. (18)": 1, "Eq. (19)": 1, "Eqs. after (19)": 2, "Eq. (20)": 1, "Eq. (21)": 1, "Eq. (22)": 1,
    "Eq. (23)": 1, "Eq. (24)": 1,
}  # fmt: skip
TOPOLOGY = {
    "Topology, link 11": "[t^2(_|_B1); r^1(||B1)]",
    "Topology, link S": "[t^2(||<>(P3, Pa1)); r^0]",
    "Topology, link T": "[t^3; r^0]",
    "Topology, M_HSOC1, first operand": "[t^2(_|_B1); r^1(||B1)]",
    "Topology, M_HSOC1, second operand": "[t^2(_|_R3); r^1(||R3)]",
    "Topology, M_HSOC1": "[t^3; r^2(||<>(R12, R3))]",
    "Topology, M_HSOC2, first operand": "[t^1(||P3); r^0]",
    "Topology, M_HSOC2, second operand, i = 1": "[t^1(||<>(Pa1)); r^0]",
    "Topology, M_HSOC2, second operand, i = 2": "[t^1(||<>(Pa2)); r^0]",
    "Topology, M_HSOC2": "[t^3; r^0]",
    "Topology, M_Pa": "[t^3; r^0]",
    "Topology, xi_L2, first operand": "[t^2(_|_B1); r^1(||B1)]",
    "Topology, xi_L2, second operand": "[t^3; r^1(||R4)]",
    "Topology, xi_L2, union": "[t^3; r^2(||<>(R12, R3))]",
}
NUMBERS = {
    ("Eq. (3)", "sum of f, LOOP1"): 6, ("Eq. (3)", "sum of f, LOOP2"): 5,
    ("Eq. (3)", "v"): 2, ("Eq. (3)", "F"): 3,
    ("Eq. (4)", "xi, LOOP1"): 3, ("Eq. (4)", "xi, LOOP2"): 5,
    ("Eq. (5)", "I, LOOP1"): 2, ("Eq. (5)", "I, LOOP2"): 1,
    ("Eq. (5)", "Delta, LOOP1"): 1, ("Eq. (5)", "Delta, LOOP2"): -1,
    ("Eq. (6)", "kappa"): 1,
}  # fmt: skip
DEPENDS = {"Eqs. after (17), x": 3, "Eqs. after (17), y": 2, "Eqs. after (17), z": 3}
STATEMENTS = {
    "Eq. (4), left side": "E10", "Eq. (5), negative values": "E10", "Eq. (26)": "E9",
    "Parallel singularity (i) b)": "E8", "Parallel singularity (ii)": "E7",
}  # fmt: skip
BOX = {
    "x low": ("wrong", -130.0), "x high": ("ok", 80.0), "y low": ("ok", None), "y high": ("ok", None),
    "z low": ("wrong", None), "z high": ("ok", None),
}  # fmt: skip


@pytest.mark.parametrize("source", EQUATIONS)
def test_equation(found, source):
    rows = [row for row in found.rows if row.source == source and row.quantity == "left - right"]
    assert len(rows) == EQUATIONS[source]
    assert all(row.verdict == "ok" and row.computed <= row.tolerance for row in rows)


def test_eq9_upper_sign(at):
    row = at("Eq. (9), upper sign")["left - right"]
    assert (row.verdict, row.erratum) == ("wrong", "E1")
    assert row.computed > 0.5


@pytest.mark.parametrize("source", TOPOLOGY)
def test_poc_set(at, source):
    row = at(source)["POC set"]
    assert (row.computed, row.verdict) == (TOPOLOGY[source], "ok")
    assert "by the rules and by rank of twists" in row.note
    printed_directions = row.printed.count("||") + row.printed.count("_|_")
    assert row.note.count(" as printed") == printed_directions


@pytest.mark.parametrize("address", NUMBERS, ids=" ".join)
def test_topology_number(at, address):
    source, quantity = address
    row = at(source)[quantity]
    assert (row.computed, row.verdict) == (NUMBERS[address], "ok")


@pytest.mark.parametrize("source", DEPENDS)
def test_decoupling(at, source):
    (row,) = at(source).values()
    assert row.verdict == "ok"
    assert row.computed.count("yA") == DEPENDS[source]


@pytest.mark.parametrize("source", STATEMENTS)
def test_statement(at, source):
    (row,) = at(source).values()
    assert (row.verdict, row.erratum) == ("wrong", STATEMENTS[source])


@pytest.mark.parametrize("end", BOX)
def test_search_box(at, end):
    row = at("Search box")[end]
    verdict, value = BOX[end]
    assert (row.verdict, row.erratum) == (verdict, "E11")
    if value is not None:
        assert row.computed == pytest.approx(value, abs=1e-6)
    if end.startswith("y"):
        assert row.computed is None


def test_no_row_is_without_a_test(found):
    tested = {*EQUATIONS, "Eq. (9), upper sign", *TOPOLOGY, *DEPENDS, *STATEMENTS, "Search box"}
    tested |= {source for source, _ in NUMBERS}
    counts = {"Eqs. after (21)", "Inverse solutions, real", "Inverse solutions, imaginary"}
    rest = {row.source for row in found.rows} - tested - counts
    assert all(source.startswith(("Table 1 ", "Table 2 ")) for source in rest)
