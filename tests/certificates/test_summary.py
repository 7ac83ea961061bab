from __future__ import annotations

from assur.certificates.summary import claim_lines, rounded, statement_lines
from assur.model.registry import load_record


def test_statement_and_claims_with_units(made_of):
    record = load_record("planar_3rpr")
    document = made_of("held angle").to_json()
    lines = [*statement_lines(document, record), *claim_lines(document, record)]
    assert lines[0] == "planar_3rpr, working mode of home"
    assert "held: phi = 17.1887339 deg" in lines
    assert "strokes: rho1 0 .. 12, rho2 1 .. 9" in lines
    assert any(line.startswith("area reached: ") and line.endswith(" mm^2") for line in lines)
    assert lines[-1].startswith("leaves: ")


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


def test_bounds_are_rounded_outwards():
    assert rounded(1.000000049, 1.00000001) == "1 .. 1.0000001"
    assert rounded(-1.00000001, 0.0) == "-1.0000001 .. 0"
    assert rounded(22678527.9, 22964630.1) == "22678527 .. 22964631"
