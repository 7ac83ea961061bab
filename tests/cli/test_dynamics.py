"""`assur dynamics`: the same as the library says, in SI units, as JSON, rows, figures and words; refusals."""

import csv

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of
from assur.machine.dynamics.motion_file import read_motion
from assur.machine.dynamics.small_motions import small_motions

CIRCLE = (
    "[harmonic]\ncentre = [-15, 10, 400]\namplitude = [20, 30, 0]\nomega = 6\nphase = [0, 1.5707963, 0]\ncount = 9\n"
)
HIGH = "[harmonic]\ncentre = [-15, 10, 456]\namplitude = [0, 0, 60]\nomega = 3\n"
FALL = "pose = [-15, 10, 400]\nt_end = 0.02\ncount = 4\n"


@pytest.fixture
def written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, text in (("circle", CIRCLE), ("high", HIGH), ("fall", FALL), ("broken", "[samples]\nt = [0]\n")):
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    return tmp_path


def test_numbers_are_those_of_the_library_in_si_units(assur_cli, written):
    run = assur_cli("dynamics", "zeng2019", "--motion", "circle.toml", "--load", "0,0,-10", "--json")
    record = assur.load("zeng2019")
    answer = record.dynamics(read_motion(record, written / "circle.toml").prescribed, load=[0, 0, -10])
    data = run.json
    assert (run.code, data["status"], data["mode"], data["forward"]) == (0, "regular", "++-++", False)
    np.testing.assert_allclose(data["actuator_forces"], answer.forces)
    np.testing.assert_allclose(data["pose"], answer.poses / 1e3)
    np.testing.assert_allclose(data["inputs"], answer.inputs / 1e3)
    np.testing.assert_allclose(data["peak"], np.abs(answer.forces).max(axis=0))
    np.testing.assert_allclose(data["rms"], answer.rms)
    np.testing.assert_allclose(data["utilisation"]["force"], answer.peak / 60.0)
    assert data["utilisation_with_friction"]["force"] != data["utilisation"]["force"]
    assert (len(data["t"]), data["stopped"], data["units"]["pose"]) == (9, None, "m, m, m")
    assert data["units"].keys() <= data.keys()


def test_a_person_sees_what_the_motors_need(assur_cli, written):
    out = assur_cli("dynamics", "zeng2019", "--motion", "circle.toml").out
    for word in ("forces along a motion", "yA1", "peak", "rms", "of limit*", "* with friction", "9 moments", "0.02"):
        assert word in out


def test_rows_are_written_as_csv_and_curves_as_a_figure(assur_cli, written):
    assert assur_cli("dynamics", "zeng2019", "--motion", "circle.toml", "-o", "rows.csv").code == 0
    with (written / "rows.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    data = assur_cli("dynamics", "zeng2019", "--motion", "circle.toml", "-o", "curves.svg", "--json").json
    assert [float(row["force yA2 [N]"]) for row in rows] == [row[1] for row in data["actuator_forces"]]
    assert [float(row["kinetic energy [J]"]) for row in rows] == data["kinetic_energy"]
    assert data["files"] == ["curves.svg"]
    assert (written / "curves.svg").read_text(encoding="utf-8").startswith("<?xml")


def test_rows_that_are_written_are_a_motion_again(assur_cli, written):
    first = assur_cli("dynamics", "zeng2019", "--motion", "circle.toml", "-o", "rows.csv", "--json").json
    again = assur_cli("dynamics", "zeng2019", "--motion", "rows.csv", "-o", "same.csv", "--json").json
    assert again["t"] == first["t"]
    assert np.allclose(again["pose"], first["pose"], rtol=0.0, atol=1e-12)
    assert np.allclose(again["inputs"], first["inputs"], rtol=0.0, atol=1e-10)
    titles = [
        (written / name).read_text(encoding="utf-8").splitlines()[0].split(",") for name in ("rows.csv", "same.csv")
    ]
    assert titles[0] == titles[1]
    assert all(title.endswith("]") for title in titles[0])


@pytest.mark.parametrize(
    ("titles", "row"), [("t [s],x [cm],y", "{t},{x:.17g}e-1,{y}"), ("y [m],t,x,note", "{y:.17g}e-3,{t},{x},7")]
)
def test_units_stand_beside_names_of_columns(assur_cli, tmp_path, titles, row):
    places = [(0.0, 0.0, 210.0), (0.1, 4.0, 212.0), (0.2, 9.0, 211.0), (0.4, 12.0, 205.0), (0.5, 13.0, 204.0)]
    tables = {"plain.csv": ("t,x,y", "{t},{x},{y}"), "units.csv": (titles, row)}
    for name, (head, form) in tables.items():
        lines = [head, *(form.format(t=t, x=x, y=y) for t, x, y in places)]
        (tmp_path / name).write_text("\n".join(lines), encoding="utf-8")
    plain, units = (
        assur_cli("dynamics", "fivebar", "--motion", str(tmp_path / name), "--json").json for name in tables
    )
    assert np.allclose(plain["pose"], units["pose"], rtol=1e-14, atol=0.0)
    (tmp_path / "bad.csv").write_text("t,x [N],y\n0,0,210\n", encoding="utf-8")
    refused = assur_cli("dynamics", "fivebar", "--motion", str(tmp_path / "bad.csv"))
    assert (refused.code, "bad.csv:1: column 2, x, cannot be in 'N'" in " ".join(refused.err.split())) == (2, True)


def test_a_motion_that_leaves_is_refused_with_the_moment_and_the_margin(assur_cli, written):
    run = assur_cli("dynamics", "zeng2019", "--motion", "high.toml", "-o", "rows.csv", "--json")
    stopped = run.json["stopped"]
    assert (run.code, run.json["status"], run.json["t"], run.json["peak"]) == (6, "serial", [], [None] * 3)
    assert stopped["kind"] == "serial"
    assert 0.0 < stopped["time"] < 0.2
    assert 0.0 <= stopped["margin"] < 1e-4
    assert not (written / "rows.csv").exists()
    said = assur_cli("dynamics", "zeng2019", "--motion", "high.toml").out
    assert "refused" in said
    assert "A3, B3, C3 are collinear" in said


def test_forces_given_move_the_mechanism_forward(assur_cli, written):
    run = assur_cli("dynamics", "zeng2019", "--motion", "fall.toml", "--forward", "--json")
    data = run.json
    assert (run.code, data["status"], data["forward"], data["deviation"]) == (0, "regular", True, None)
    assert data["energy_drift"] <= 1e-9
    assert data["loop_gap"] <= 1e-10
    assert data["pose"][-1][2] < data["pose"][0][2]
    assert "energy from nowhere" in assur_cli("dynamics", "zeng2019", "--motion", "fall.toml", "--forward").out
    alone = assur_cli("dynamics", "zeng2019", "--motion", "fall.toml")
    assert (alone.code, "add --forward" in alone.err) == (2, True)


def test_samples_of_a_table_are_those_of_a_file(assur_cli, tmp_path):
    rows = [[0.0, 0.0, 210.0], [0.1, 4.0, 212.0], [0.2, 9.0, 211.0], [0.4, 12.0, 205.0], [0.5, 13.0, 204.0]]
    times, poses = [row[0] for row in rows], [row[1:] for row in rows]
    (tmp_path / "way.toml").write_text(f"[samples]\nt = {times}\npose = {poses}\n", encoding="utf-8")
    table = ["y,t,x", *(f"{y},{t},{x}" for t, x, y in rows)]
    (tmp_path / "way.csv").write_text("\n".join(table), encoding="utf-8")
    both = [
        assur_cli("dynamics", "fivebar", "--motion", str(tmp_path / name), "--json").json
        for name in ("way.toml", "way.csv")
    ]
    assert both[0]["actuator_forces"] == both[1]["actuator_forces"]
    assert len(both[0]["t"]) == len(rows)
    (tmp_path / "way.csv").write_text("time,x,y\n0,0,210\n", encoding="utf-8")
    refused = assur_cli("dynamics", "fivebar", "--motion", str(tmp_path / "way.csv"))
    assert refused.code == 2
    assert "way.csv:1: columns time, x, y are not those of t and the pose" in refused.err


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        ((), "--motion is missing", 2),
        (("--motion", "none.toml"), "none.toml", 2),
        (("--motion", "broken.toml"), "broken.toml:2: samples.t", 3),
        (("--motion", "circle.toml", "-o", "rows.txt"), "its ending is none of", 2),
        (("--motion", "circle.toml", "--load", "1,2"), "--load: 2 values", 2),
    ],
)
def test_wrong_words_are_told(assur_cli, written, words, said, code):
    run = assur_cli("dynamics", "zeng2019", *words)
    assert run.code == code
    assert said in run.err


def test_small_motions_about_a_pose_are_those_of_the_library(assur_cli):
    run = assur_cli("dynamics", "linear_delta_4s", "--linear", "--json")
    record = assur.load("linear_delta_4s")
    about = small_motions(record, pose_of(record, record.home_values))
    data = run.json
    assert (run.code, data["stable"], data["status"]) == (0, True, "regular")
    np.testing.assert_allclose(data["stiffness_matrix"], about.stiffness, atol=1e-6)
    assert data["frequencies"] == pytest.approx(about.frequencies.tolist())
    assert "swings, friction left aside, at 0.9" in assur_cli("dynamics", "linear_delta_4s", "--linear").out
    away = assur_cli("dynamics", "zeng2019", "--linear", "--pose", "0", "0", "5000", "--json")
    assert (away.code, away.json["stable"], away.json["frequencies"]) == (4, None, [])
    assert "it runs away" in assur_cli("dynamics", "zeng2019", "--linear", "--pose", "-15", "10", "400").out
    assert "--linear is about one pose" in assur_cli("dynamics", "zeng2019", "--linear", "--forward").err
    assert "--pose: the file" in assur_cli("dynamics", "zeng2019", "--pose", "0", "0", "400").err
