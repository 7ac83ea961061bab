"""`assur export`: the files, the endings, and what is refused."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

import assur


def test_without_masses_they_are_nominal(assur_cli, tmp_path):
    text = assur.load("fivebar").file.read_text(encoding="utf-8").partition("# ---- the machine")[0]
    path = tmp_path / "bare.toml"
    path.write_text(text.replace('profile = "bar20", material = "steel", ', ""))
    words = ("export", str(path), "--format", "mjcf", "-o", str(tmp_path / "it.xml"))
    assert "masses are nominal: 1 kg for each link" in assur_cli(*words).out
    assert assur_cli(*words, "--json").json["nominal_mass_kg"] == 1.0


@pytest.mark.parametrize(("form", "ending"), [("mjcf", "xml"), ("sdf", "sdf"), ("urdf", "urdf")])
def test_a_file_is_written_where_it_is_asked_for(assur_cli, tmp_path, form, ending):
    path = tmp_path / f"it.{ending}"
    run = assur_cli("export", "fivebar", "--format", form, "-o", str(path))
    assert run.code == 0, run.err
    assert "masses are those of the mechanism's file" in run.out
    ElementTree.parse(path)


def test_left_out_the_name_is_the_mechanisms_and_the_form_mjcf(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = assur_cli("export", "fivebar", "--json")
    assert run.json["files"] == ["fivebar.xml"]
    assert ElementTree.parse(Path("fivebar.xml")).getroot().tag == "mujoco"


def test_urdf_names_the_file_of_the_loops(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--format", "urdf", "-o", str(tmp_path / "it.urdf"), "--json")
    assert [Path(name).name for name in run.json["files"]] == ["it.urdf", "it.loops.json"]


def test_dimensions_can_be_set(assur_cli, tmp_path):
    path = tmp_path / "it.xml"
    assert assur_cli("export", "fivebar", "--set", "l2=200", "-o", str(path)).code == 0
    sites = {item.get("name"): item.get("pos") for item in ElementTree.parse(path).getroot().iter("site")}
    assert sites["platform"].split()[0] == "0.2"


def test_an_ending_of_another_form_is_refused(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--format", "sdf", "-o", str(tmp_path / "it.xml"))
    assert run.code == 2
    assert "its ending is none of .sdf" in run.err
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_form_is_refused_with_the_known_ones(assur_cli):
    run = assur_cli("export", "fivebar", "--format", "dwg")
    assert run.code == 2
    assert "mjcf" in run.err


def test_servos_are_written_in_place_of_motors_where_they_are_asked_for(assur_cli, tmp_path):
    tags = []
    for words in ([], ["--servos"]):
        path = tmp_path / f"it{len(words)}.xml"
        assert assur_cli("export", "fivebar", *words, "-o", str(path)).code == 0
        tags.append([item.tag for item in ElementTree.parse(path).getroot().find("actuator")])
    assert tags == [["motor", "motor"], ["position", "position"]]


@pytest.mark.parametrize("form", ["sdf", "urdf", "glb"])
def test_servos_are_of_mjcf_alone(assur_cli, tmp_path, form):
    run = assur_cli("export", "fivebar", "--format", form, "--servos", "-o", str(tmp_path / f"it.{form}"))
    assert run.code == 2
    assert "has no actuators" in run.err
    assert list(tmp_path.iterdir()) == []


def test_the_help_says_who_reads_what(assur_cli):
    said = " ".join(assur_cli("export", "--help").out.split())
    assert "Drake refuses its loops" in said
    assert "Gazebo, Drake" not in said


def test_stl_is_a_folder_with_a_bill(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--format", "stl", "-o", str(tmp_path / "printed"), "--json")
    assert run.code == 0, run.err
    written = sorted(path.name for path in (tmp_path / "printed").iterdir())
    assert sorted(Path(name).name for name in run.json["files"]) == written
    assert {"crank1.stl", "crank1.pins.stl", "bom.csv"} <= set(written)
    assert {row["kind"] for row in run.json["bill"]} == {"make", "buy"}


def test_glb_is_written_and_moves(assur_cli, tmp_path):
    path = tmp_path / "it.glb"
    assert assur_cli("export", "fivebar", "--format", "glb", "-o", str(path)).code == 0
    assert path.read_bytes()[:4] == b"glTF"
    assert b'"closed motion"' in path.read_bytes()


def test_the_bill_alone(assur_cli, tmp_path):
    run = assur_cli("export", "zeng2019", "--format", "bom", "-o", str(tmp_path / "it.csv"))
    assert run.code == 0
    assert "to buy" in run.out
    assert "rail with carriage" in (tmp_path / "it.csv").read_text()


@pytest.mark.cad
def test_step_has_its_bill_beside_it(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--format", "step", "-o", str(tmp_path / "it.step"), "--json")
    assert run.code == 0, run.err
    assert [Path(name).name for name in run.json["files"]] == ["it.step", "it.bom.csv"]
    assert (tmp_path / "it.step").read_text().startswith("ISO-10303-21")


def test_the_thickness_is_that_of_the_bill(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--format", "bom", "--thickness", "12", "-o", str(tmp_path / "it.csv"))
    assert run.code == 0, run.err
    assert "flat bars are 12 mm thick" in " ".join(run.out.split())
    assert "x 12" in (tmp_path / "it.csv").read_text()


def test_simulators_have_no_thickness(assur_cli, tmp_path):
    run = assur_cli("export", "fivebar", "--thickness", "12", "-o", str(tmp_path / "it.xml"))
    assert run.code == 2
    assert "mjcf has balls and arms of its own sizes" in run.err
    assert list(tmp_path.iterdir()) == []


def test_step_without_its_extra_says_what_to_install(assur_cli, tmp_path, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "OCP", None)
    run = assur_cli("export", "fivebar", "--format", "step", "-o", str(tmp_path / "it.step"))
    assert run.code == 2
    assert "pip install '.[cad]'" in run.err
    assert list(tmp_path.iterdir()) == []


def test_c_is_the_closed_form_and_has_neither_masses_nor_parts(tmp_path, assur_cli):
    target = tmp_path / "f.c"
    run = assur_cli("export", "fivebar", "--format", "c", "-o", str(target), "--json")
    assert (run.code, run.json["files"]) == (0, [str(target)])
    assert run.json.keys() == {"mechanism", "format", "files"}
    assert "int fivebar_direct(" in target.read_text(encoding="ascii")
    assert assur_cli("export", "fivebar", "--format", "c", "--thickness", "3").code == 2
