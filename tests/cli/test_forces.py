"""`assur forces`: the same as the library says, in SI units, readable, and refused where it must be."""

import numpy as np
import pytest

import assur
from assur.machine.forces.capacity import capacity

POSE = ("-15.4714", "9.6849", "456.3315")
LOAD = ("--load", "0,0,-100")


@pytest.fixture(scope="module")
def weighed(tmp_path_factory):
    """The paper's mechanism with a kilogram in every link but one."""
    text = assur.load("zeng2019").file.read_text(encoding="utf-8")
    head, _, rest = text.partition("[links]")
    links, joints, tail = rest.partition("[joints]")
    lines = [line.split("=")[0] + "= { mass = 1 }" if " = {" in line else line for line in links.splitlines()]
    kept = [table for table in tail.split("\n\n") if not table.startswith(("[materials]", "[payload]"))]
    path = tmp_path_factory.mktemp("weighed") / "own.toml"
    path.write_text(head + "[links]" + "\n".join(lines) + "\n" + joints + "\n\n".join(kept), encoding="utf-8")
    return str(path)


def test_numbers_are_those_of_the_library_in_si_units(assur_cli, weighed):
    run = assur_cli("forces", weighed, "--pose", *POSE, *LOAD, "--velocity", "100", "0", "0", "--json")
    answer = assur.load(weighed).forces([float(text) for text in POSE], [100, 0, 0], load=[0, 0, -100])
    data = run.json
    assert (run.code, data["status"], data["mode"]) == (0, "regular", "++-++")
    assert data["actuator_forces"] == pytest.approx(answer.forces[0].tolist())
    assert data["velocity"] == pytest.approx([0.1, 0, 0])
    assert data["pose"] == pytest.approx([float(text) / 1e3 for text in POSE])
    assert np.array(data["mass_matrix"]) == pytest.approx(answer.mass_matrix[0])
    assert data["mass_matrix"][1][1] == pytest.approx(13.0)
    assert (data["unknowns"], data["equations"], data["rank"], data["redundancy"]) == (88, 78, 78, 10)
    assert [len(item["unique"]) for item in data["reactions"]] == [6] * 17
    assert all(item["elastic"] is None for item in data["reactions"])
    assert data["units"]["actuator_forces"] == "N, N, N"
    assert data["units"].keys() <= data.keys()


def test_a_person_sees_forces_terms_and_what_is_open(assur_cli, weighed):
    out = assur_cli("forces", weighed, "--pose", *POSE).out
    for word in ("yA1", "M x", "bias c", "88 unknowns, 78 equations of rank 78", "10 stresses", "under gravity"):
        assert word in out


def test_without_masses_a_load_is_held_and_gravity_refused(assur_cli, tmp_path):
    path = tmp_path / "bare.toml"
    assert assur_cli("new", str(path), "--limb", "P[x] R[z] R[z]", "--count", "3").code == 0
    held = assur_cli("forces", str(path), "--pose", "0", "0", "0", *LOAD, "--no-gravity", "--json")
    assert (held.code, held.json["kinetic_energy"], held.json["mass_matrix"][0][0]) == (0, None, None)
    assert "no mass is stated of" in " ".join(held.json["notes"])
    refused = assur_cli("forces", str(path), "--pose", "0", "0", "0")
    assert refused.code == 2
    assert "no mass of " in refused.err
    assert "kg" in refused.err


def test_a_pose_out_of_reach_says_why(assur_cli):
    run = assur_cli("forces", "zeng2019", "--pose", "0", "0", "5000", "--no-gravity", "--json")
    assert (run.code, run.json["status"], run.json["reactions"]) == (4, "unreachable", [])
    assert run.json["actuator_forces"] == [None] * 3
    assert run.json["failures"]


def test_a_singular_pose_has_a_status_and_no_numbers(assur_cli):
    words = ("forces", "fivebar", "--set", "l2=150", "--pose", "0", "60", "--no-gravity", "--load", "0,-10,0")
    run = assur_cli(*words, "--mode", "-+", "--json")
    assert (run.code, run.json["status"], run.json["actuator_forces"]) == (0, "parallel", [None, None])
    assert "the actuators do not hold the platform here" in assur_cli(*words, "--mode", "-+").out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--load", "1,2"), "--load: 2 values"),
        (("--load", "5"), "--load: 1 value"),
        (("--load", "x"), "--load: 'x' is not a number"),
        (("--load", "1,2,x"), "--load: 'x' is not a number"),
        (("--velocity", "1", "2"), "velocity of zeng2019: 2 values, 3 wanted"),
    ],
)
def test_wrong_words_are_told(assur_cli, words, said):
    run = assur_cli("forces", "zeng2019", "--pose", *POSE, *words)
    assert run.code == 2
    assert said in run.err


def test_capacity_is_that_of_the_library(assur_cli):
    run = assur_cli("forces", "zeng2019", "--capacity", "--pose", *POSE, "--json")
    held = capacity(assur.load("zeng2019"), [float(text) for text in POSE])
    assert (run.code, run.json["status"]) == (0, "regular")
    assert run.json["largest_sphere"] == pytest.approx(held.sphere)
    assert np.array(run.json["polytope_vertices"]) == pytest.approx(held.vertices)
    assert run.json["per_axis"]["z"] == pytest.approx(held.per_axis[2].tolist())
    out = assur_cli("forces", "zeng2019", "--capacity").out  # at home
    assert "in every direction: " in out
    assert "8 corners" in out


def test_capacity_takes_no_load_and_forces_a_pose(assur_cli):
    assert "--capacity is at rest" in assur_cli("forces", "zeng2019", "--capacity", *LOAD).err
    assert "--pose is missing" in assur_cli("forces", "zeng2019").err


def test_links_that_bend_decide_what_rigid_ones_leave_open(assur_cli):
    words = ("forces", "zeng2019", "--pose", *POSE, *LOAD)
    data = assur_cli(*words, "--json").json
    for item in data["reactions"]:
        rigid, sure = np.array([*item["force"], *item["moment"]]), np.array(item["unique"])
        assert np.array(item["elastic"])[sure] == pytest.approx(rigid[sure])
    assert "the same where links bend by their profiles" in assur_cli(*words).out


def test_near_a_singularity_it_is_told_who_bears_and_which_joint_moves(assur_cli):
    near, there = (
        assur_cli(
            "forces", "fivebar", "--set", "l2=150", "--pose", "0", y, "--mode=-+", "--no-gravity", *LOAD, "--json"
        )
        for y in ("60.01", "60")
    )
    assert near.json["status"] == "near_singular"
    assert "along (0, 1, 0) and about (0, 0, 1) asks theta1 and theta2 for up to 636.481 N" in near.json["notes"][0]
    assert "joint P moves most" in near.json["notes"][0]
    assert near.json["weakest"]["moved"] == pytest.approx(1.6667e-4, rel=1e-3)
    assert there.json["status"] == "parallel"
    assert there.json["actuator_forces"] == [None, None]
    assert "grows as one over the distance" in there.json["notes"][1]


def test_near_the_border_it_is_told_which_actuator_runs_away(assur_cli):
    run = assur_cli("forces", "zeng2019", "--pose", "-15.4714", "9.6849", "458.912935", "--json").json
    assert run["status"] == "near_singular"
    assert "while the pose moves by one, yA3 may move by 29202.7" in run["notes"][0]


def test_what_is_held_is_mapped_over_a_plane(assur_cli, tmp_path):
    path = tmp_path / "held.csv"
    run = assur_cli("forces", "fivebar", "--capacity", "--map", "x,y", "--nodes", "5", "-o", str(path), "--json")
    maps = run.json["maps"]
    assert list(maps) == ["sphere", "gravity", "against x", "along x", "against y", "along y", "speed"]
    inside = [(i, j) for i in range(5) for j in range(5) if run.json["status"][i][j] == "regular"]
    i, j = inside[0]
    pose = [run.json["axes"][name][k] for name, k in (("x", i), ("y", j))]
    held = capacity(assur.load("fivebar"), pose)
    assert maps["sphere"]["values"][i][j] == pytest.approx(held.sphere)
    assert [maps[f"{side} x"]["values"][i][j] for side in ("against", "along")] == pytest.approx(held.per_axis[0])
    assert path.read_text(encoding="utf-8").startswith("x [mm],y [mm],status,sphere [N],gravity,against x [N]")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--map", "x,y"], "--map goes with --capacity"),
        (["--capacity", "--map", "x,y", "--pose", "0", "224"], "a map is of many poses"),
        (["--capacity", "--at", "x=0"], "--at: of a map alone"),
        (["--capacity", "--map", "x,q"], "there is: x, y"),
    ],
)
def test_a_map_of_what_is_none_is_refused(assur_cli, words, said):
    run = assur_cli("forces", "fivebar", *words)
    assert run.code == 2
    assert said in run.err


def test_the_equation_of_motion_is_written_after_it_was_held_against_numbers(assur_cli, tmp_path):
    path = tmp_path / "motion.tex"
    run = assur_cli("forces", "fivebar", "--latex", str(path), "--json")
    assert (run.code, run.json["written"]) == (0, str(path))
    assert run.json["difference"] < 1e-10
    assert r"\mathbf{M}_{11} &=" in path.read_text(encoding="utf-8")
    assert "they differ by" in assur_cli("forces", "fivebar", "--latex", str(path)).out
    alone = assur_cli("forces", "fivebar", "--latex", str(path), "--pose", "0", "200")
    assert (alone.code, "hold for every pose" in alone.err) == (2, True)
