"""`assur calibrate`: from a table to a file that differs in the new numbers alone."""

import re
from pathlib import Path

import numpy as np
import pytest

import assur


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """A five-bar's file, and a table of it with a longer crank and a motor that is off by 0.1 deg."""
    folder = tmp_path_factory.mktemp("bench")
    (folder / "own.toml").write_text(assur.load("fivebar").file.read_text(encoding="utf-8"), encoding="utf-8")
    own = assur.load("fivebar", l1=100.5)
    poses = np.array([0.0, 224.0]) + np.random.default_rng(4).uniform(-1, 1, size=(8, 2)) * [40, 25]
    inputs = np.degrees(own.inverse(poses, own.modes.default_working).inputs.reshape(8, 2)) - [0.1, 0.0]
    lines = [",".join(map(repr, map(float, row))) for row in np.concatenate([inputs, poses], axis=1)]
    (folder / "data.csv").write_text("theta1,theta2,x,y\n" + "\n".join(lines) + "\n", encoding="utf-8")
    return folder


def test_a_table_becomes_a_file_with_other_numbers_alone(assur_cli, bench):
    words = ("calibrate", str(bench / "own.toml"), str(bench / "data.csv"))
    run = assur_cli(*words, "-o", str(bench / "new.toml"), "--json")
    assert (run.code, run.json["outliers"], run.json["measurements"]) == (0, [], 8)
    assert run.json["parameters"]["l1"] == pytest.approx(100.5, abs=1e-7)
    assert run.json["parameters"]["theta1"] == pytest.approx(np.radians(0.1), abs=1e-9)
    assert run.json["residual_after"] < 1e-8 < run.json["residual_before"]
    old, new = ((bench / name).read_text(encoding="utf-8").splitlines() for name in ("own.toml", "new.toml"))
    differ = [line.split("=")[0].strip() for line, other in zip(old, new, strict=True) if line != other]
    assert set(differ) <= {"g", "l1", "l2", "A1", "A2"}
    again = assur_cli("calibrate", str(bench / "new.toml"), str(bench / "data.csv"), "--json")
    assert again.json["residual_before"] < 1e-8
    assert "root of the mean square" in assur_cli(*words).out


def test_a_camera_may_stand_anywhere(assur_cli, bench):
    """The same table, seen by a camera that is turned by 90 deg."""
    rows = np.loadtxt(bench / "data.csv", delimiter=",", skiprows=1)
    lines = [f"{a!r},{b!r},{y!r},{-x!r}" for a, b, x, y in rows.tolist()]
    (bench / "seen.csv").write_text("theta1,theta2,x,y\n" + "\n".join(lines) + "\n", encoding="utf-8")
    run = assur_cli("calibrate", str(bench / "own.toml"), str(bench / "seen.csv"), "--frame", "--json")
    assert run.json["parameters"]["frame.rz"] == pytest.approx(np.pi / 2, abs=1e-6)
    assert run.json["parameters"]["l1"] == pytest.approx(100.5, abs=1e-5)
    sizes = [run.json["sigma"][name] ** 2 for name in run.json["parameters"]]
    assert np.diag(run.json["covariance"]) == pytest.approx(sizes)


def test_what_cannot_be_written_or_read_is_told(assur_cli, bench):
    path = bench / "bad.csv"
    path.write_text("theta1,x\n1,2\n", encoding="utf-8")
    run = assur_cli("calibrate", str(bench / "own.toml"), str(path))
    assert run.code == 2
    assert "bad.csv:1: no column theta2, an input" in " ".join(run.err.split())
    for text, said in (
        ("theta1,theta2,x\n1,2,3 mm\n", "bad.csv:2: column 3, x = '3 mm', is not a finite number"),
        ("theta1,theta2,x,u\n1,2,3,4\n", "bad.csv:1: column 4 is 'u'"),
        ("theta1,theta2,x,x\n1,2,3,4\n", "bad.csv:1: column x twice"),
        ("theta1,theta2\n1,2\n", "bad.csv:1: no column of what is measured"),
        ("theta1,theta2,x\n1,2,nan\n", "bad.csv:2: column 3, x = 'nan', is not a finite number"),
        ("", "bad.csv: no poses"),
    ):
        path.write_text(text, encoding="utf-8")
        assert said in " ".join(assur_cli("calibrate", str(bench / "own.toml"), str(path)).err.split())


def test_a_formula_becomes_the_number_that_is_found(assur_cli, bench):
    text = (bench / "own.toml").read_text(encoding="utf-8").replace("value = 100", 'value = "50*2"')
    (bench / "formula.toml").write_text(text, encoding="utf-8")
    words = ("calibrate", str(bench / "formula.toml"), str(bench / "data.csv"), "-o", str(bench / "number.toml"))
    assert assur_cli(*words).code == 0
    assert assur.load(bench / "number.toml").parameters["l1"].value == pytest.approx(100.5, abs=1e-7)


def test_a_deltas_heights_become_a_file_that_differs_in_what_was_found_line_by_line(assur_cli, tmp_path):
    """Arms, rods, a radius that was a formula, and an offset for each limb of the template."""
    table = Path(__file__).parents[2] / "examples" / "delta_heights.csv"
    new = tmp_path / "calibrated.toml"
    run = assur_cli("calibrate", "delta_4s", str(table), "-o", str(new), "--json")
    assert (run.code, run.json["outliers"]) == (0, [13])
    before = assur.load("delta_4s").file.read_text(encoding="utf-8").splitlines()
    after = new.read_text(encoding="utf-8").splitlines()
    changed = [(old, own) for old, own in zip(before, after, strict=True) if old != own]
    assert [old.split("=")[0].strip() for old, _ in changed] == ["L", "l", "wB", "A"]
    for old, own in changed:
        numbers = r"value = (\"[^\"]*\"|[-+.\de]+)|, offsets = \[[^\]]*\]"
        assert re.sub(numbers, "", old) == re.sub(numbers, "", own)
    again = assur_cli("calibrate", str(new), str(table), "--json").json
    assert again["residual_before"] == pytest.approx(run.json["residual_after"], rel=1e-6)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda rows: rows * [1, 1, 1, 1000], "half of the measurements are off by more than"),
        (lambda rows: rows * [*np.radians([1, 1, 1]), 1], "are all columns in the file's units?"),
        (lambda rows: rows[:3], "3 numbers are measured, 3 are unknown"),
    ],
    ids=["millimetres", "radians", "few"],
)
def test_other_units_and_too_few_poses_are_told(assur_cli, tmp_path, change, said):
    table = Path(__file__).parents[2] / "examples" / "delta_heights.csv"
    rows = change(np.loadtxt(table, delimiter=",", skiprows=1))
    path = tmp_path / "bad.csv"
    np.savetxt(path, rows, delimiter=",", header="theta1,theta2,theta3,z", comments="")
    run = assur_cli("calibrate", "delta_4s", str(path))
    assert run.code == 2
    assert said in " ".join(run.err.split())


def test_a_slip_in_an_input_is_named_and_draws_nothing_away(assur_cli, tmp_path):
    """A motor that stood elsewhere by some 200 deg, beside a height that is half a millimetre off."""
    text = (Path(__file__).parents[2] / "examples" / "delta_heights.csv").read_text(encoding="utf-8").splitlines()
    text[5] = ",".join(["170", *text[5].split(",")[1:]])
    path = tmp_path / "slip.csv"
    path.write_text("\n".join(text), encoding="utf-8")
    data = assur_cli("calibrate", "delta_4s", str(path), "--json").json
    assert data["outliers"] == [5, 13]
    assert data["parameters"]["L"] == pytest.approx(0.5244, abs=4 * data["sigma"]["L"])
