import math

import numpy as np
import pytest

import assur
from assur.kinematics.answers.answer import answer
from assur.results.json_text import plain
from screw_mechanisms import DIFFERENTIAL, FIVEBAR, loaded
from wrong_formulas import with_wrong_joints

INPUTS = ["162.6907", "-143.3209", "-24.6776"]
POSE = ["-15.4714", "9.6849", "456.3315"]
COMMON = {"mechanism", "unit", "coordinates", "status", "complete", "complete_for", "solutions", "curves", "failures"}


def test_direct_prints_what_the_library_answers(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json == plain(answer(assur.load("zeng2019").direct([float(text) for text in INPUTS])))
    assert run.json.keys() >= {*COMMON, "inputs"}
    assert {"pose", "mode", "residual", "status"} <= run.json["solutions"][0].keys()


def test_inverse_prints_what_the_library_answers(assur_cli):
    run = assur_cli("inverse", "zeng2019", *POSE, "--json")
    assert run.json == plain(answer(assur.load("zeng2019").inverse([float(text) for text in POSE])))
    assert run.json.keys() >= {*COMMON, "pose"}
    assert {"inputs", "mode", "residual", "status"} <= run.json["solutions"][0].keys()


def test_direct_and_inverse_are_inverse_to_each_other(assur_cli):
    solution = assur_cli("direct", "zeng2019", *INPUTS, "--json").json["solutions"][0]
    back = assur_cli("inverse", "zeng2019", *map(str, solution["pose"]), "--mode", solution["working_mode"], "--json")
    assert back.json["solutions"][0]["inputs"] == pytest.approx([float(text) for text in INPUTS], abs=1e-9)


def test_angles_are_in_degrees_both_ways(assur_cli):
    there = assur_cli("direct", "fivebar", "127", "53", "--json").json
    assert there["inputs"] == pytest.approx([127.0, 53.0])
    pose = there["solutions"][0]["pose"]
    crank = np.array([-70.0, 0.0]) + 100.0 * np.array([math.cos(math.radians(127)), math.sin(math.radians(127))])
    assert math.dist(pose, crank) == pytest.approx(194.0)
    back = assur_cli("inverse", "fivebar", *map(str, pose), "--mode", "-+", "--json").json
    assert back["solutions"][0]["inputs"] == pytest.approx([127.0, 53.0])


def test_one_mode_may_be_asked_for_though_it_begins_with_two_hyphens(assur_cli):
    run = assur_cli("inverse", "zeng2019", "-60", "0", "50", "--mode", "--+-+", "--json")
    every = assur_cli("inverse", "zeng2019", "-60", "0", "50", "--json").json["solutions"]
    assert [item["mode"] for item in run.json["solutions"]] == ["--+-+"]
    assert run.json["solutions"][0] in every
    assert not run.json["complete"]


def test_dimensions_can_be_set(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--set", "l2=300", "--set", "l7=-0", "--json")
    assert run.json == plain(answer(assur.load("zeng2019", l2=300).direct([float(text) for text in INPUTS])))


def test_unreachable_exits_4_and_names_the_quantity(assur_cli):
    run = assur_cli("direct", "zeng2019", "900", "-900", "0", "--json")
    assert run.code == 4
    assert (run.json["status"], run.json["solutions"], run.json["complete"]) == ("unreachable", [], True)
    assert run.json["failures"][0]["quantity"] == "w2"
    assert run.json["failures"][0]["value"] == pytest.approx(280.0**2 - 830.0**2)
    text = assur_cli("direct", "zeng2019", "900", "-900", "0")
    assert text.code == 4
    assert "unreachable, no solution among 8 branches" in text.out
    assert "w2 < 0" in text.out
    assert "-610500 mm^2" in text.out


def test_a_mode_that_does_not_reach_exits_4(assur_cli):
    run = assur_cli("inverse", "zeng2019", "900", "0", "300", "--mode", "++-++")
    assert run.code == 4
    assert "no solution in this mode" in run.out
    assert "Only this mode was asked for" in run.out


def test_a_mode_without_solution_names_those_that_have_one(assur_cli, tmp_path):
    own = str(tmp_path / "own.toml")
    assur_cli("new", own, "--chain", "R[z] R[z] R[z]", "--chain", "R[z] R[z]")
    every = assur_cli("inverse", own, "10", "20", "--json").json
    modes = [item["mode"] for item in every["solutions"]]
    assert len(modes) > 1
    assert every["known_modes"] == []  # nothing was left out
    for command in (("inverse", own, "10", "20"), ("singularity", own, "--pose", "10", "20")):
        words = (*command, "--mode", f"{modes[0]}q")
        assert assur_cli(*words, "--json").json["known_modes"] == modes
        run = assur_cli(*words)
        assert run.code == 4
        assert f"there are solutions in the modes {', '.join(modes)}" in " ".join(run.out.split())
    beyond = assur_cli("inverse", own, "3000", "20")
    assert beyond.out.splitlines()[0] == "own, inverse: unreachable, no solution"  # no mode was asked for
    assert "there is no solution in any mode" in assur_cli("inverse", own, "3000", "20", "--mode", modes[0]).out


def test_self_motion_is_a_curve_and_no_sample(assur_cli):
    words = ("direct", "zeng2019", "210", "70", "-24.5")
    data = assur_cli(*words, "--json").json
    assert (data["status"], data["solutions"]) == ("self_motion", [])
    assert data["curves"]
    assert all({"parameter", "interval", "mode", "poses"} <= curve.keys() for curve in data["curves"])
    run = assur_cli(*words)
    assert run.code == 0
    assert "The platform moves while every input stands still" in run.out
    assert f"self_motion, {len(data['curves'])} curves" in run.out
    low, _ = data["curves"][0]["interval"]
    assert f"gamma = {low:.4f}" in run.out


def test_a_person_sees_units_modes_status_and_the_gap(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS)
    assert run.code == 0
    head, given, _, titles, _, first, *_ = run.out.splitlines()
    assert head == "zeng2019, direct: regular, 4 solutions among 8 branches"
    assert given == "at yA1 = 162.6907 mm, yA2 = -143.3209 mm, yA3 = -24.6776 mm"
    assert titles.split() == ["mode", "x", "[mm]", "y", "[mm]", "z", "[mm]", "working", "home", "status", "gap", "[mm]"]
    assert first.split()[:6] == ["+++", "-15.4714", "9.6849", "456.3315", "++-++", "yes"]
    assert "home: mode +++, by its signs" in run.out
    assert "Complete for the reduced model" in run.out
    assert "mode: the signs of e1, e2, e3" in run.out


@pytest.mark.parametrize("words", [("direct", "zeng2019", *INPUTS), ("inverse", "zeng2019", *POSE), ("list",)])
def test_lines_fit_into_80_columns_and_have_no_colour_codes(assur_cli, words):
    out = assur_cli(*words).out
    assert max(map(len, out.splitlines())) <= 80
    assert "\x1b" not in out


def test_the_headline_counts_solutions_by_status(assur_cli):
    inputs = ["1", "0.645275", "1.086284", "1.503439", "1.281933", "0.771071"]
    run = assur_cli("direct", "gough_stewart", *inputs)
    solutions = assur_cli("direct", "gough_stewart", *inputs, "--json").json["solutions"]
    each, own = [item["status"] for item in solutions], next(item for item in solutions if item["home"])
    assert (len(each), set(each)) == (40, {"regular", "near_singular"})
    listed = f"({each.count('regular')} regular, {each.count('near_singular')} near_singular)"
    text = " ".join(run.out.split())
    first = f"gough_stewart, direct: {own['status']} in mode {own['mode']}, near_singular at worst, 40 solutions"
    assert own["status"] == "regular"
    assert text.startswith(f"{first} {listed} among 40 branches")
    assert "half round add no pose): all 40 complex solutions" in text


def test_a_search_leaves_crossed_parallelograms_out_unless_asked(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--method", "search")
    assert "~" not in run.out
    text = " ".join(run.out.split())
    assert "regular, 4 solutions" in text
    assert "28 with crossed parallelograms were left out" in text


@pytest.fixture
def differential(tmp_path):
    loaded(tmp_path, DIFFERENTIAL)
    return str(tmp_path / "differential.toml")


@pytest.mark.parametrize(("degrees", "height"), [("114.591559", 2.546479), ("720", 16.0), ("-36000", -800.0)])
def test_a_screw_answers_for_every_number_of_turns(assur_cli, differential, degrees, height):
    run = assur_cli("direct", differential, degrees, "--json")
    assert (run.code, run.json["status"]) == (0, "regular")
    assert [item["pose"] for item in run.json["solutions"]] == [[pytest.approx(height, abs=1e-6)]]
    assert [item["status"] for item in run.json["solutions"]] == ["regular"]


def test_the_inverse_of_a_screw_is_in_real_turns(assur_cli, differential):
    run = assur_cli("inverse", differential, "12", "--json")
    assert (run.code, run.json["status"]) == (0, "regular")
    assert [pytest.approx(540.0)] in [item["inputs"] for item in run.json["solutions"]]


def test_a_search_that_finds_nothing_proves_nothing(assur_cli, tmp_path):
    """Rods of 130 mm whose sliders stand 300 mm apart do not meet; a search cannot know that."""
    loaded(tmp_path, FIVEBAR)
    words = ("direct", str(tmp_path / "driven.toml"), "7200", "0")
    searched = assur_cli(*words, "--method", "search")
    assert searched.code == 5
    assert searched.out.splitlines()[0] == "driven, direct: nothing was found, not proved"
    assert "starts, none of which found one." in " ".join(searched.out.split())
    proved = assur_cli(*words)
    assert (proved.code, proved.out.splitlines()[0][:28]) == (4, "driven, direct: unreachable,")


def test_solutions_outside_the_limits_are_listed_with_what_they_exceed(assur_cli):
    run = assur_cli("direct", "three_rps", "400", "400", "400")
    assert run.code == 0
    assert "within" not in run.out
    titles = run.out.splitlines()[3].split()
    assert titles[-1] == "limits"
    rows = [line.split() for line in run.out.splitlines() if line.startswith("stroke of")]
    assert rows == [["stroke", "of", f"rho{k}", "400", "160", "..", "320", "80", "mm", "all"] for k in (1, 2, 3)]
    data = assur_cli("direct", "three_rps", "400", "400", "400", "--json").json
    assert data["limits_stated"] is True
    for item in data["solutions"]:
        assert item["limits"]["within"] is False
        assert [(each["joint"], each["by"], each["unit"]) for each in item["limits"]["outside"]] == [
            (f"rho{k}", pytest.approx(80.0), "mm") for k in (1, 2, 3)
        ]
    inside = assur_cli("direct", "three_rps", "200", "200", "200", "--json").json
    assert all(item["limits"] == {"within": True, "outside": []} for item in inside["solutions"])


def test_where_no_limits_are_stated_it_is_said(assur_cli):
    assert "No limits are stated." in assur_cli("direct", "zeng2019", *INPUTS).out
    data = assur_cli("direct", "zeng2019", *INPUTS, "--json").json
    assert data["limits_stated"] is False
    assert {item["limits"]["within"] for item in data["solutions"]} == {None}


def test_formulas_that_leave_loops_open_exit_3(monkeypatch, assur_cli):
    record = with_wrong_joints(assur.load("zeng2019"), "P3", 20.0)
    monkeypatch.setattr("assur.cli.options.Shared.mechanism", lambda *_: record)
    run = assur_cli("inverse", "zeng2019", "0", "0", "400")
    assert run.code == 3
    assert "regular" not in run.out
    text = " ".join(run.out.split())
    assert text.startswith("zeng2019, inverse: not_closed, 8 rows, none of them a solution")
    assert "C1, B1 stays open at E3a, by 20 mm" in text
    assert "Complete" not in text
    data = assur_cli("inverse", "zeng2019", "0", "0", "400", "--json").json
    assert (data["status"], data["complete"]) == ("not_closed", False)
    assert all(item["open_loop"]["gap"] == pytest.approx(20.0) for item in data["solutions"])


def test_the_headline_names_the_row_of_the_own_mode_first(assur_cli):
    head = " ".join(assur_cli("inverse", "zeng2019", "0", "0", "300").out.split())
    assert head.startswith("zeng2019, inverse: regular in mode ++-++, self_motion at worst, 8 solutions (4 ")
