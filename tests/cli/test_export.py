"""`assur export`: the files, the endings, and what is refused."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest


@pytest.mark.parametrize(("form", "ending"), [("mjcf", "xml"), ("sdf", "sdf"), ("urdf", "urdf")])
def test_a_file_is_written_where_it_is_asked_for(assur_cli, tmp_path, form, ending):
    path = tmp_path / f"it.{ending}"
    run = assur_cli("export", "fivebar", "--format", form, "-o", str(path))
    assert run.code == 0, run.err
    assert "nominal" in run.out
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
    run = assur_cli("export", "fivebar", "--format", "step")
    assert run.code == 2
    assert "mjcf" in run.err
