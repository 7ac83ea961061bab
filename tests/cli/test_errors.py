"""`assur errors`: the same as the library says, readable, and refused where it must be."""

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of
from own_machines import own_machine

POSE = ("-15.4714", "9.6849", "456.3315")


@pytest.fixture(scope="module")
def toleranced(tmp_path_factory):
    """The five-bar with tolerances and a clearance."""
    path = tmp_path_factory.mktemp("toleranced") / "own.toml"
    text = assur.load("fivebar").file.read_text(encoding="utf-8")
    path.write_text(f'{text}\n[tolerances]\nl1 = 0.05\n"rod1.l2" = 0.02\n[clearances]\nB1 = 0.01\n', encoding="utf-8")
    return str(path)


def test_numbers_are_those_of_the_library(assur_cli):
    run = assur_cli("errors", "zeng2019", "--pose", *POSE, "--json")
    own = assur.load("zeng2019").errors([float(text) for text in POSE])
    data = run.json
    assert (run.code, data["status"], data["mode"]) == (0, "regular", "++-++")
    assert list(data["sensitivity"]) == list(own.sensitivity)
    for name, row in own.sensitivity.items():
        assert np.array(data["sensitivity"][name]) == pytest.approx(row, abs=1e-12)
    assert all(data["compatible"].values())
    assert (data["worst_case"], data["covariance"]) == (None, None)
    assert data["per"]["yA1"] == "mm"
    assert data["units"].keys() <= data.keys()


def test_what_does_not_assemble_is_called_so(assur_cli):
    data = assur_cli("errors", "orthoglide", "--pose", "0", "0", "0", "--json").json
    name = "leg1.rod_a.L"
    assert (data["compatible"][name], data["compatible"]["leg1.L"], name in data["elastic"]) == (False, True, True)
    assert len(data["self_stress"][name]["leg1.Da"]) == 6
    out = assur_cli("errors", "orthoglide", "--pose", "0", "0", "0").out
    assert "leg1.rod_a.L*" in out
    assert "does not assemble alone" in out
    assert "where links that bend by their profiles settle" in out


def test_of_what_does_not_assemble_nothing_is_said_that_is_left(assur_cli, capsys):
    """A draft without profiles: its rods alone have no place to settle."""
    record = own_machine("parallelograms")
    capsys.readouterr()
    pose = map(repr, pose_of(record, record.home_values).tolist())
    words = ("errors", str(record.file), "--pose", *pose)
    left = assur_cli(*words, "--json").json["uncompensated"]
    assert any(None in row for row in left.values())
    assert any(row == [0.0] * 6 for row in left.values())
    assert "that assembles alone" in " ".join(assur_cli(*words).out.split())


def test_tolerances_and_clearances_are_summed(assur_cli, toleranced):
    run = assur_cli("errors", toleranced, "--pose", "0", "224", "--json")
    data = run.json
    rows = np.abs([data["sensitivity"][name] for name in ("l1", "rod1.l2")])
    assert list(data["worst_case"]) == ["x", "y", "z", "rx", "ry", "rz"]
    assert list(data["worst_case"].values()) == pytest.approx(rows.T @ [0.05, 0.02])
    assert np.shape(data["covariance"]) == (6, 6)
    low, high = data["proved"]["y"]
    assert 0.5 * (high - low) == pytest.approx(data["worst_case"]["y"], rel=1e-2)
    assert low < 224 < high
    assert len(data["clearances"]["B1"]) == 6
    out = assur_cli("errors", toleranced, "--pose", "0", "224").out
    for word in ("worst case", "root sum square", "clearance of B1", "certainly, for all dimensions"):
        assert word in out


def test_samples_lie_inside_the_bounds_and_say_how_much_of_them_is_reached(assur_cli, toleranced):
    words = ("errors", toleranced, "--pose", "0", "224")
    data = assur_cli(*words, "--json", "--samples", "3000").json["sampled"]
    assert (data["count"], data["seed"], data["assembled"], data["inside"]) == (3000, 1, 3012, True)
    assert data["ratio"]["y"] == pytest.approx(1.0, abs=1e-2)
    out = " ".join(assur_cli(*words, "--samples", "3000").out.split())
    assert "width over that of samples" in out
    assert "3000 samples, uniform (seed 1), and the ends that are worst to first order: all inside" in out
    for count in ("0", "many", "1e9"):
        assert assur_cli(*words, "--samples", count).code == 2


def test_maps_are_of_what_tolerances_add_to(assur_cli, toleranced, tmp_path):
    words = ("--map", "x,y", "--nodes", "4", "--resolution", "6")
    run = assur_cli("errors", toleranced, *words, "-o", str(tmp_path / "map.csv"))
    assert run.code == 0
    assert "worst_displacement [mm]" in run.out
    lines = (tmp_path / "map.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "x [mm],y [mm],status,worst_displacement [mm],root_sum_square [mm],worst_rotation [rad]"
    bare = assur_cli("errors", "fivebar", *words)
    assert bare.code == 2
    assert "fivebar states no tolerances" in bare.err
    assert "write [tolerances]" in " ".join(bare.err.split())


def test_bad_input_is_refused(assur_cli):
    assert assur_cli("errors", "fivebar").code == 2
    far = assur_cli("errors", "fivebar", "--pose", "0", "900", "--json")
    assert (far.code, far.json["sensitivity"], far.json["status"]) == (4, {}, "unreachable")
    assert far.json["failures"]
