"""What is typed is obeyed, or refused by name: each option that a command lists, beside each question it is asked."""

import json

import pytest

from assur import load
from assur.cli.application import application

MOTION = "[harmonic]\ncentre = [0, 200]\namplitude = [20, 10]\nomega = [3, 3]\nphase = [0, 0]\nt_end = 0.2\ncount = 5\n"
POSES = "x,y\n0,200\n20,210\n-20,180\n10,190\n30,220\n"
OTHER = {
    "--pose": ("10", "190"), "--mode": ("++",), "--load": ("0,-10,0",), "--velocity": ("10", "0"),
    "--acceleration": ("10", "0"), "--map": ("x",), "--box": ("y=150:250",), "--stroke": ("0:30",),
    "--at": ("y=190",), "--nodes": ("4",), "--resolution": ("9",),
    "--latex": ("motion.tex",), "--length": ("100",), "--points": ("256",), "--motion": ("other.toml",),
    "--poses": ("poses.csv",), "--count": ("6",), "--by": ("O2",), "--measure": ("x",), "--centre": ("0,10,0",),
    "--section": ("200",), "--near": ("5",), "--gap": ("0.05",), "--finest": ("20",), "--boxes": ("3",),
    "--prove": ("x=-5:5",), "--largest": ("cube",), "--around": ("x=0",), "--ratio": ("2",), "--set": ("l2=190",),
    "--samples": ("500",), "--copies": ("link",),
}  # fmt: skip
"""A value of each option that is another than what holds without it."""
SHARED = {"--json", "--debug", "--run-code"}
UNSEEN = {
    ("dynamics", "--no-limits"): "the file states no limits",
    ("forces", "--resolution"): "of the region; what is mapped is solved node by node",
    ("stiffness", "--resolution"): "the same",
    ("errors", "--resolution"): "the same",
    ("indices", "--resolution"): "the same",
    ("--certify", "--boxes"): "the first round of boxes is enough",
    ("--prove", "--boxes"): "the same",
    ("--prove", "--set"): "true of both mechanisms",
}
"""Obeyed without a trace in this answer, and why."""


@pytest.mark.parametrize(
    "question",
    [
        "forces fivebar --pose 0 200",
        "forces fivebar --capacity --pose 0 200",
        "forces fivebar --capacity --map x --at y=200 --nodes 3 --resolution 4",
        "forces fivebar --latex equations.tex",
        "stiffness fivebar --pose 0 200",
        "stiffness fivebar --map x --at y=200 --nodes 3 --resolution 4",
        "errors fivebar --pose 0 200",
        "errors toleranced.toml --pose 0 200",
        "errors toleranced.toml --map x --at y=200 --nodes 3 --resolution 4",
        "indices fivebar --pose 0 200",
        pytest.param("indices fivebar --map x --at y=200 --nodes 3 --resolution 4", marks=pytest.mark.deep),
        "indices fivebar --points 128 --resolution 4",
        "dynamics fivebar --motion motion.toml",
        "dynamics fivebar --linear",
        "identify fivebar --poses poses.csv",
        "identify fivebar --count 5",
        "singularity fivebar --pose 0 200",
        pytest.param("workspace fivebar --resolution 4", marks=pytest.mark.deep),
        "workspace fivebar --certify --gap 0.1",
        "workspace fivebar --prove x=-5:5,y=198:202",
        "workspace fivebar --largest cube --around x=0,y=200",
    ],
)
def test_no_option_is_passed_over(assur_cli, tmp_path, monkeypatch, question):
    monkeypatch.chdir(tmp_path)
    for name, text in (
        ("motion.toml", MOTION),
        ("other.toml", MOTION.replace("20, 10", "10, 20")),
        ("poses.csv", POSES),
        ("toleranced.toml", f"{load('fivebar').file.read_text(encoding='utf-8')}\n[tolerances]\nl1 = 0.05\n"),
    ):
        (tmp_path / name).write_text(text)
    words = question.split()
    written = tmp_path / ("written.json" if words[0] == "workspace" else "written.csv")
    other = OTHER | {"--output": (written.name,)}
    plain = assur_cli(*words, "--json")
    assert plain.code == 0
    for option, flag in _options(words[0]):
        if option in SHARED or option in words:
            continue
        run = assur_cli(*words, option, *(() if flag else other[option]), "--json")
        if run.code == 2:
            said = json.loads(run.out)["error"]["message"]
            assert any(name in said for name in (option, *words) if name.startswith("--")), said
        elif option == "--output":
            assert written.exists()
        elif not any((word, option) in UNSEEN for word in words):
            assert run.out != plain.out, f"{question}: {option} changes nothing"


def _options(command):
    """The long name of each option, and whether it is a flag."""
    for argument in application([command])[command].assemble_argument_collection():
        if name := next((name for name in argument.names if name.startswith("--")), None):
            yield name, argument.hint is bool
