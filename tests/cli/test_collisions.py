"""`assur collisions`: what it says, its exit codes, and what is refused."""

import shutil

import pytest

import assur


def test_links_that_keep_apart_are_exit_code_0(assur_cli):
    run = assur_cli("collisions", "fivebar", "--samples", "20")
    assert run.code == 0, run.err
    assert "no links meet" in run.out
    assert "known at 20 poses of the workspace, mode" in run.out
    assert "between them links may come nearer" in " ".join(run.out.split())


def test_links_that_meet_are_exit_code_1(assur_cli):
    run = assur_cli("collisions", "zeng2019", "--samples", "30", "--json")
    assert run.code == 1
    first = run.json["pairs"][0]
    assert first["clearance"] == 0
    assert 0 < first["meeting"] <= run.json["poses"]
    assert run.json["known"] == "sampled"
    assert len(first["pose"]) == 3


def test_along_a_motion(assur_cli):
    run = assur_cli("collisions", "fivebar", "--over", "motion", "--samples", "12", "--json")
    assert run.code == 0
    assert (run.json["over"], run.json["poses"], run.json["mode"]) == ("motion", 12, None)
    clearances = [item["clearance"] for item in run.json["pairs"]]
    assert clearances == sorted(clearances)


@pytest.mark.parametrize("name", ["planar_3rpr", "gough_stewart"])
def test_without_signs_it_says_no_mode_and_no_motion(assur_cli, name):
    run = assur_cli("collisions", name, "--samples", "10")
    said = " ".join(run.out.split())
    assert "known at 10 poses of the workspace; between them" in said
    assert "motion" not in said
    run = assur_cli("collisions", name, "--samples", "10", "--json")
    assert (run.json["over"], run.json["drawn_from"], run.json["mode"]) == ("workspace", "box", None)
    run = assur_cli("collisions", name, "--mode", "bogus")
    assert (run.code, "only one working mode" in run.err) == (2, True)


def test_without_a_closed_form_it_says_that_assemblies_near_home_were_drawn(assur_cli, tmp_path):
    path = tmp_path / "mechanism.toml"
    shutil.copy(assur.load("fivebar").folder / "mechanism.toml", path)
    run = assur_cli("collisions", str(path), "--samples", "10")
    assert run.code == 0, run.err
    said = " ".join(run.out.split())
    assert "known at 10 assemblies near home; between them" in said
    assert "workspace, mode" not in said
    run = assur_cli("collisions", str(path), "--samples", "10", "--json")
    assert (run.json["drawn_from"], run.json["mode"]) == ("home", None)
    run = assur_cli("collisions", str(path), "--mode", "bogus")
    assert run.code == 2
    assert "has not a closed form" in run.err
    assert "leave the mode out" in run.err


def test_what_makes_no_sense_is_refused(assur_cli):
    for words, said in (
        (("--samples", "0"), "at least 1"),
        (("--seed", "-1"), "not negative"),
        (("--over", "motion", "--mode", "++"), "a motion begins at home"),
        (("--over", "nothing"), "workspace"),
    ):
        run = assur_cli("collisions", "fivebar", *words)
        assert run.code == 2, words
        assert said in run.err


@pytest.mark.parametrize(("ending", "head"), [("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG")])
def test_the_closest_pair_is_drawn(assur_cli, tmp_path, ending, head):
    path = tmp_path / f"closest.{ending}"
    run = assur_cli("collisions", "fivebar", "--samples", "10", "-o", str(path), "--json")
    assert run.code == 0, run.err
    assert run.json["file"] == str(path)
    assert path.read_bytes().startswith(head)


def test_a_picture_of_another_kind_is_refused_before_the_work(assur_cli, tmp_path):
    run = assur_cli("collisions", "fivebar", "-o", str(tmp_path / "closest.gif"))
    assert run.code == 2
    assert "its ending is none of .png, .pdf, .svg" in run.err


def test_the_thickness_is_told_and_decides(assur_cli):
    thin = assur_cli("collisions", "fivebar", "--samples", "10", "--json")
    thick = assur_cli("collisions", "fivebar", "--samples", "10", "--thickness", "20", "--json")
    assert (thin.code, thick.code) == (0, 1)
    assert thin.json["thickness"] < thick.json["thickness"] == 20
    run = assur_cli("collisions", "fivebar", "--samples", "10")
    assert f"{thin.json['thickness']:.3g} mm thick" in run.out


def test_the_delta_robot_is_drawn_so_that_its_rods_keep_apart(assur_cli):
    """Its balls on the platform are 10 mm apart, while the robot is more than a metre wide."""
    run = assur_cli("collisions", "delta_4s", "--samples", "20", "--json")
    assert run.code == 0, [item for item in run.json["pairs"] if item["meeting"]]
