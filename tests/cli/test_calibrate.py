"""`assur calibrate`: from a table to a file that differs in the new numbers alone."""

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
    data = str(bench / "data.csv")
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
    ):
        path.write_text(text, encoding="utf-8")
        assert said in " ".join(assur_cli("calibrate", str(bench / "own.toml"), str(path)).err.split())
    text = (bench / "own.toml").read_text(encoding="utf-8").replace("value = 100", 'value = "50*2"')
    (bench / "formula.toml").write_text(text, encoding="utf-8")
    refused = assur_cli("calibrate", str(bench / "formula.toml"), data, "-o", str(bench / "no.toml"))
    assert refused.code == 2
    assert "l1: its value is a formula" in " ".join(refused.err.split())
    assert not (bench / "no.toml").exists()
