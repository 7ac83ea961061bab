import numpy as np
import pytest

import assur
from assur.kinematics.following.following import follow


def test_the_path_is_that_of_the_library(assur_cli):
    run = assur_cli("follow", "fivebar", "--from", "0", "200", "--to", "60", "220", "60", "150", "--json")
    assert run.code == 0
    mechanism = assur.load("fivebar")
    start = mechanism.inverse([0.0, 200.0], "-+").joints[0]
    path = follow(mechanism, start, poses=[[60.0, 220.0], [60.0, 150.0]])
    assert run.json["shares"] == path.shares.tolist()
    assert run.json["poses"] == path.poses.tolist()
    assert run.json["inputs"] == np.degrees(path.inputs).tolist()
    assert (run.json["stopped"], run.json["angle"], run.json["prescribed"]) == (None, "deg", "poses")
    assert run.json["modes"] == [{"working": "-+", "assembly": "+"}] * 2


def test_a_stop_is_an_answer_with_its_reason(assur_cli):
    words = ("follow", "fivebar", "--from", "0", "200", "--to", "20", "400")
    run = assur_cli(*words, "--json")
    assert run.code == 6
    stop = run.json["stopped"]
    assert (stop["kind"], stop["factor"], stop["turns_back"]) == ("serial", "arm1", True)
    assert stop["share"] == run.json["shares"][-1]
    text = " ".join(assur_cli(*words).out.split())
    assert "fivebar, path along poses: stopped, serial" in text
    assert "before a serial singularity" in text
    assert "arm1 -> 0: A1, B1, P are collinear" in text
    assert f"a gap of {stop['gap']:.3g} mm remains" in text
    assert "(without a unit: lengths in units of 194 mm)" in text


def test_modes_that_a_file_does_not_name_bear_the_names_of_closing_blocks(assur_cli):
    run = assur_cli("follow", "three_upu", "--to", "1", "1", "170")
    assert run.code == 0
    assert "mode: working +++, assembly +, kept" in run.out


def test_a_person_sees_a_dozen_points_of_a_path_from_home(assur_cli):
    out = assur_cli("follow", "zeng2019", "--along", "inputs", "--to", "170", "-140", "-20").out
    assert "zeng2019, path along inputs: the end was reached" in out
    assert "mode: working ++-++, assembly +++, kept" in out
    rows = [line.split() for line in out.splitlines() if line.strip()[:1].isdigit() and "point" not in line]
    rows = [row for row in rows if len(row) == 7]
    assert 2 <= len(rows) <= 12
    assert (rows[0][0], rows[-1][0]) == ("0.00", "100.00")
    assert rows[-1][4:] == ["170.0000", "-140.0000", "-20.0000"]


def test_another_mode_may_be_asked_for(assur_cli):
    words = ("follow", "fivebar", "--from", "0", "200", "--to", "10", "200", "--json")
    assert assur_cli(*words, "--mode", "++").json["modes"][0]["working"] == "++"
    assert assur_cli(*words).json["modes"][0]["working"] == "-+"


def test_a_start_out_of_reach_exits_4_and_says_why(assur_cli):
    run = assur_cli("follow", "fivebar", "--from", "0", "400", "--to", "0", "200", "--json")
    assert run.code == 4
    assert run.json["failures"][0]["quantity"] == "reach1"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--to", "1", "2", "3"), "--to, pose of fivebar: 3 values, 4 wanted"),
        (("--from", "1", "2", "3", "4", "--to", "1", "2"), "--from: 2 points, one wanted"),
        (("--to", "1", "a"), "y: 'a' is not a number"),
        (("--mode", "++", "--to", "0", "200"), "--mode names the mode at --from"),
        (("--from", "0", "200", "--mode", "+++", "--to", "0", "200"), "unknown working mode of fivebar '+++'"),
    ],
)
def test_bad_input_exits_2(assur_cli, words, message):
    run = assur_cli("follow", "fivebar", *words)
    assert (run.code, run.out) == (2, "")
    assert message in run.err
