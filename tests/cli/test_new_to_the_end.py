"""A mechanism that is in no catalogue, from a line of notation to every answer, without a line of Python."""

import re
from pathlib import Path

import pytest

CHAINS = ("--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "--chain", "R[z] R[z] C[z]")
POSE = ("10", "20", "320")
README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_it_goes_through_everything(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert assur_cli("new", "hybrid.toml", *CHAINS).code == 0
    assert assur_cli("check", "hybrid.toml", "--json").json["sound"]
    assert assur_cli("topology", "hybrid.toml", "--json").json["dof"] == 3

    inverse = assur_cli("inverse", "hybrid.toml", *POSE, "--json").json
    assert len(inverse["solutions"]) == 8
    inputs = [f"{value:.12g}" for value in inverse["solutions"][0]["inputs"]]
    shown = re.search(r"direct hybrid.toml (\S+) (\S+) (\S+)", README)
    assert shown.groups() == tuple(f"{value:.4f}" for value in inverse["solutions"][0]["inputs"])
    direct = assur_cli("direct", "hybrid.toml", *inputs, "--json").json
    gaps = [max(abs(a - float(b)) for a, b in zip(item["pose"], POSE, strict=True)) for item in direct["solutions"]]
    assert min(gaps) < 1e-5

    mode = re.search(r"singularity hybrid.toml --pose 10 20 320 --mode=(\S+)", README)[1]
    verdict = assur_cli("singularity", "hybrid.toml", "--pose", *POSE, f"--mode={mode}", "--json")
    assert (verdict.code, verdict.json["mode"]) == (0, mode)
    path = assur_cli("follow", "hybrid.toml", "--to", "15", "15", "325", "--json").json
    assert path["stopped"] is None
    region = assur_cli("workspace", "hybrid.toml", "--resolution", "8", "--json").json
    assert region["how"] == "followed from home"
    assert 0 < region["volume_error"] < 0.05 * region["volume"]
    assert assur_cli("indices", "hybrid.toml", "--pose", *POSE).code == 0

    for form, name in (("mjcf", "h.xml"), ("sdf", "h.sdf"), ("urdf", "h.urdf")):
        assert assur_cli("export", "hybrid.toml", "--format", form, "-o", name).code == 0
        assert (tmp_path / name).stat().st_size > 1000


WRIST = "R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O"


@pytest.mark.slow
def test_a_spherical_wrist_goes_through_what_is_asked_of_a_pose(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert assur_cli("new", "wrist.toml", "--limb", WRIST).code == 0
    assert assur_cli("check", "wrist.toml", "--json").json["sound"]
    assert assur_cli("topology", "wrist.toml", "--json").json["dof"] == 3

    pose = ("5", "8", "-4")
    inverse = assur_cli("inverse", "wrist.toml", *pose, "--json").json
    assert len(inverse["solutions"]) == 8  # each limb of three axes through a point has two postures
    inputs = [f"{value:.12g}" for value in inverse["solutions"][0]["inputs"]]
    direct = assur_cli("direct", "wrist.toml", *inputs, "--json").json
    gaps = [max(abs(a - float(b)) for a, b in zip(item["pose"], pose, strict=True)) for item in direct["solutions"]]
    assert min(gaps) < 1e-5
    assert len(direct["solutions"]) <= 8  # the degree of its direct problem

    assert assur_cli("singularity", "wrist.toml", "--pose", *pose, "--mode=++-").code == 0
    assert assur_cli("follow", "wrist.toml", "--to", *pose, "--json").json["stopped"] is None
    assert assur_cli("indices", "wrist.toml", "--pose", *pose).code == 0
