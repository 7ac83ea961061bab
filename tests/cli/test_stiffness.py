"""`assur stiffness`: the same as the library says, in SI units, readable, and refused where it must be."""

import numpy as np
import pytest

import assur

GEAR = "gear = { ratio = 50, stiffness = 2e5, rotor = 3e-6 }"
HINGE = "B1 = [1e-8, 1e-8, 1e-8, 0, 1e-6, 1e-6]"
POSE = ("-15.4714", "9.6849", "456.3315")


def test_numbers_are_those_of_the_library_in_si_units(assur_cli):
    run = assur_cli("stiffness", "zeng2019", "--pose", *POSE, "--json")
    own = assur.load("zeng2019").stiffness([float(text) for text in POSE])
    data = run.json
    assert (run.code, data["status"], data["mode"], data["rank"], data["shear"]) == (0, "regular", "++-++", 6, True)
    assert np.array(data["compliance"]) == pytest.approx(own.compliance[0])
    assert np.array(data["stiffness"]) == pytest.approx(own.stiffness[0])
    assert data["translational_eigenvalues"] == pytest.approx(own.translational[0][0])
    assert np.array(data["directions"]) == pytest.approx(own.translational[1][0])
    assert data["actuator_only"]["translational_eigenvalues"][0] == pytest.approx(19.5e6, rel=1e-3)
    assert (data["actuator_only"]["rank"], data["actuator_only"]["stiffness"]) == (3, None)
    for split in ("links", "kinds", "actuators"):
        assert sum(data["shares"][split].values()) == pytest.approx(1.0)
    assert list(data["shares"]["kinds"]) == ["bending", "torsion", "axial", "shear", "actuators"]
    assert len(data["frequencies"]) == 6
    assert data["units"].keys() <= data.keys()


def test_a_person_sees_directions_matrices_and_where_the_energy_is(assur_cli):
    out = assur_cli("stiffness", "zeng2019", "--pose", *POSE, "--no-shear").out
    for word in ("0.226373", "19.5001", "link12", "bending 87.6%", "shear 0.0%", "natural vibrations"):
        assert word in out


def test_rigid_links_leave_ways_in_which_nothing_gives_way(assur_cli):
    words = ("stiffness", "gough_stewart", "--pose", "0", "0", "600", "1", "0", "0", "0")
    assert "no link has a profile: only the actuators give way" in assur_cli(*words).out
    flat = assur_cli("stiffness", "planar_3rpr", "--pose", "30", "40", "0", "--json")
    assert (flat.code, flat.json["rank"], flat.json["stiffness"]) == (0, 3, None)
    assert flat.json["translational_eigenvalues"][2] is None


@pytest.fixture
def own(tmp_path):
    """A five-bar with a rod and hinges that give way by compliances, and geared drives."""
    path = tmp_path / "own.toml"
    text = (
        assur.load("fivebar").file.read_text(encoding="utf-8").replace("stiffness = 1e5,", f"stiffness = 1e5, {GEAR},")
    )
    rod = next(line for line in text.splitlines() if line.startswith("rod1"))
    soft = "compliance = [1e-8, 1e-7, 1e-7, 1e-5, 1e-5, 1e-5], mass = 0.2"
    path.write_text(text.replace(rod, f"rod1 = {{ {soft} }}") + f"[compliances]\n{HINGE}\n", encoding="utf-8")
    return path


def test_compliances_and_gears_have_their_shares(assur_cli, own):
    run = assur_cli("stiffness", str(own), "--pose", "0", "224", "--json")
    shares = run.json["shares"]
    assert run.code == 0
    assert list(shares["joints"]) == ["B1"]
    assert min(shares["kinds"][kind] for kind in ("given", "joints", "gears", "actuators")) > 0.0
    assert shares["links"]["rod1"] == pytest.approx(shares["kinds"]["given"])
    assert len(run.json["frequencies"]) == 6
    told = assur_cli("stiffness", str(own), "--pose", "0", "224").out
    assert "of that of the joints: B1 100.0%" in told


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("HINGE", "B1 = [1e-8, 1e-8, 1e-8, 0, 1e-6]", "compliances.B1: a list of 5"),
        ("HINGE", 'B1 = "soft"', 'compliances.B1: "soft"; allowed: six numbers'),
        ("HINGE", "B1 = [-1e-8, 1e-8, 1e-8, 0, 1e-6, 1e-6]", "compliances.B1: -1e-08 along x; allowed: a symmetric"),
        ("HINGE", "B9 = [1e-8, 1e-8, 1e-8, 0, 1e-6, 1e-6]", "compliances.B9: unknown joint 'B9'"),
        ("GEAR", "gear = 50", "gear: 50; allowed: a table"),
    ],
)
def test_compliances_and_gears_that_are_none_are_told_with_their_line(assur_cli, own, right, wrong, told):
    text = own.read_text(encoding="utf-8")
    right = {"HINGE": HINGE, "GEAR": GEAR}[right]
    line = next(number for number, row in enumerate(text.splitlines(), 1) if right in row)
    own.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    run = assur_cli("stiffness", str(own), "--pose", "0", "224")
    assert run.code == 3
    assert f"own.toml:{line}: " in run.err
    assert told in run.err


def test_of_equal_stiffness_directions_are_said_to_be_some_of_many(assur_cli):
    said = "where stiffness is the same, every direction between theirs has it"
    assert said in assur_cli("stiffness", "orthoglide", "--pose", "0", "0", "0").out
    assert said not in assur_cli("stiffness", "zeng2019", "--pose", "-15.4714", "9.6849", "456.3315").out


def test_sizes_in_millimetres_are_noted_and_without_density_there_are_no_frequencies(assur_cli, tmp_path):
    path = tmp_path / "own.toml"
    text = assur.load("fivebar").file.read_text(encoding="utf-8")
    assert "round = 0.020" in text
    path.write_text(text.replace("round = 0.020", "round = 20"), encoding="utf-8")
    said = "is 20 m wide; sizes of profiles are in m"
    assert f"profiles.bar20: {said}" in assur_cli("check", str(path)).out
    assert f"bar20 {said}" in assur_cli("stiffness", str(path), "--pose", "0", "224", "--json").json["notes"]
    line = next(line for line in text.splitlines() if "density = " in line)
    path.write_text(text.replace(line, "steel = { E = 210e9, nu = 0.3 }"), encoding="utf-8")
    bare = assur_cli("stiffness", str(path), "--pose", "0", "224", "--json")
    assert (bare.code, bare.json["frequencies"], bare.json["mode_shapes"]) == (0, [], [])
    assert any("no frequencies" in note for note in bare.json["notes"])


def test_what_is_lacking_or_wrong_is_told(assur_cli, tmp_path):
    path = tmp_path / "own.toml"
    text = assur.load("fivebar").file.read_text(encoding="utf-8").replace("stiffness = 1e5, ", "")
    path.write_text(text, encoding="utf-8")
    bare = assur_cli("stiffness", str(path), "--pose", "0", "224")
    assert bare.code == 2
    assert "no stiffness of A1, A2" in bare.err
    assert "own.toml, line " in bare.err
    assert "[actuators]: A1 = { ..., stiffness = 1e5 }, in N m/rad" in bare.err
    assert assur_cli("stiffness", "zeng2019").code == 2
    far = assur_cli("stiffness", "zeng2019", "--pose", "0", "0", "9999", "--json")
    assert (far.code, far.json["compliance"], far.json["shares"]) == (4, None, None)
    assert far.json["failures"]


def test_maps_go_through_the_workspace_and_into_files(assur_cli, tmp_path):
    words = ("stiffness", "fivebar", "--map", "x,y", "--nodes", "6", "--resolution", "8")
    run = assur_cli(*words, "-o", str(tmp_path / "map.csv"))
    assert run.code == 0
    assert "least_stiffness_of_actuators [N/m]" in run.out
    lines = (tmp_path / "map.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith(
        "x [mm],y [mm],status,least_stiffness [N/m],least_stiffness_of_actuators [N/m],direction_x"
    )
    assert len(lines) == 37
    assert assur_cli(*words, "-o", str(tmp_path / "map.png")).code == 0
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    data = assur_cli(*words, "--json").json
    assert data["maps"]["least_stiffness"]["least"]["value"] > 0
    assert assur_cli(*words, "--pose", "0", "224").code == 2
    assert assur_cli("stiffness", "fivebar", "--pose", "0", "224", "-o", "x.csv").code == 2
