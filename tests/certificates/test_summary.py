import math

import pytest

from assur.certificates.summary import PARTS, claim_lines, rounded, shares, statement_lines
from assur.model.registry import load_record


def test_statement_and_claims_with_units(made_of):
    record = load_record("planar_3rpr")
    document = made_of("held angle").to_json()
    lines = [*statement_lines(document, record), *claim_lines(document, record)]
    assert lines[0] == "planar_3rpr, working mode of home"
    assert "held: phi = 17.1887339 deg" in lines
    assert "strokes: rho1 0 .. 12, rho2 1 .. 9" in lines
    assert any(line.startswith("area reached: ") and line.endswith(" mm^2") for line in lines)
    counts = document["claims"]["leaves"]
    assert f"parts: {sum(counts.values())}, which cover the box without overlap; of these" in lines
    told = [line.split(" (")[0] for line in lines[-sum(map(bool, counts.values())) :]]
    assert told == [f"  {counts[name]}" for name in ("regular", "inside", "outside", "open") if counts[name]]


@pytest.mark.parametrize("kind", ["held angle", "angle"])
def test_shares_are_those_of_the_volume(made_of, kind):
    """The tree against the exact volumes that are claimed."""
    document = made_of(kind).to_json()
    found, claims = shares(document["proof"]), document["claims"]
    whole = math.prod(float.fromhex(b) - float.fromhex(a) for a, b in document["statement"]["box"])
    low, high = (float.fromhex(text) / whole for text in claims["volume"])
    assert found["regular"] + found["inside"] == pytest.approx(low, rel=1e-9)
    assert found["open"] == pytest.approx(high - low, rel=1e-9)
    assert sum(found.values()) == pytest.approx(1.0, rel=1e-12)
    assert found["regular"] == pytest.approx(float.fromhex(claims["regular_volume"]) / whole, rel=1e-9)


def test_what_is_undecided_is_said_in_words_and_how_much_it_is():
    claims = {"leaves": {"inside": 1, "regular": 1, "outside": 0, "open": 1}, "reached": "open", "regular": "open"}
    document = {"kind": "box", "claims": claims, "proof": "0r1bi", "program": {"factors": [["w", 3]]}}
    assert claim_lines(document) == [
        "all of the box is reached: undecided",
        "all of it is free of singularities: undecided",
        "factors looked at: w",
        "parts: 3, which cover the box without overlap; of these",
        "  1 (50 %) reached all over, and free of singularities",
        "  1 (25 %) reached all over; whether free of singularities is undecided",
        "  1 (25 %) undecided: nothing is proved there",
    ]


def test_without_the_mechanism_units_are_left_out(made_of):
    lines = [*statement_lines(made_of("angle").to_json()), *claim_lines(made_of("angle").to_json())]
    assert lines[1].startswith("box: x -20 .. 20, y -20 .. 20, phi -3.14159265 .. 3.14159265 rad")


def test_a_box_has_answers_instead_of_a_volume(made_of):
    lines = claim_lines(made_of("box").to_json(), load_record("zeng2019"))
    assert lines[:2] == ["all of the box is reached: yes", "all of it is free of singularities: yes"]


def test_a_path_has_both_ends_and_its_pieces(made_of):
    document = made_of("path, angle held").to_json()
    lines = [*statement_lines(document, load_record("planar_3rpr")), *claim_lines(document)]
    assert lines[1:3] == ["from: x = -6 mm, y = -1.5 mm", "to: x = -4 mm, y = -9 mm"]
    count = len(document["statement"]["boxes"])
    assert lines[3:5] == [f"path: {count} straight pieces, each in a box", "held: phi = 17.1887339 deg"]
    assert "all of the path is reached: yes" in lines
    parts = document["claims"]["leaves"]["regular"]
    assert lines[-2:] == [f"parts: {parts} in {count} boxes; of these", f"  {parts} {PARTS['regular']}"]


def test_any_number_of_coordinates_has_a_size():
    """Those of a mechanism that is not here may be more than any of ours has."""
    leaves = {"inside": 1, "regular": 0, "outside": 0, "open": 0}
    for count, size in enumerate(("length", "area", "volume", "volume", "volume"), 1):
        claims = {"leaves": leaves, "volume": [(1.0).hex()] * 2, "regular_volume": (0.0).hex()}
        statement = {"coordinates": list("xyzuv"[:count])}
        document = {"kind": "workspace", "claims": claims, "proof": "i", "program": {"factors": []}}
        assert claim_lines({**document, "statement": statement})[0] == f"{size} reached: 1 .. 1"


def test_bounds_are_rounded_outwards():
    assert rounded(1.000000049, 1.00000001) == "1 .. 1.0000001"
    assert rounded(-1.00000001, 0.0) == "-1.0000001 .. 0"
    assert rounded(-0.0, -0.0) == "0 .. 0"
    assert rounded(22678527.9, 22964630.1) == "22678527 .. 22964631"
