"""`assur aspects`: the library's numbers, poses and paths, pictures, and bad input."""

import pytest

import assur
from assur.workspace.aspects.aspects import aspects

WIDE = ("--box", "x=-300:300", "--box", "y=-300:300", "--finest", "9.375")
FOUND = aspects(assur.load("fivebar"), "-+", {"x": (-300, 300), "y": (-300, 300)}, finest=9.375)


def test_the_numbers_are_those_of_the_library(assur_cli):
    run = assur_cli("aspects", "fivebar", "--mode=-+", *WIDE, "--json")
    assert (run.code, run.err) == (0, "")
    data = run.json
    assert (data["coordinates"], data["box"]) == (["x", "y"], [[-300.0, 300.0], [-300.0, 300.0]])
    assert [item["label"] for item in data["aspects"]] == [item.label for item in FOUND.aspects]
    assert [item["volume"] for item in data["aspects"]] == [list(item.volume) for item in FOUND.aspects]
    assert [item["boxes"] for item in data["aspects"]] == [len(item.boxes) for item in FOUND.aspects]
    assert (data["undecided"], data["how"]) == (len(FOUND.search.undecided), FOUND.how)


def test_a_person_sees_bounds_and_how_they_are_known(assur_cli):
    run = assur_cli("aspects", "zeng2019", "--finest", "5")
    assert run.code == 0
    assert "zeng2019, aspects of working mode ++-++: 4" in run.out
    assert "aspect: signs of u1_minus_u2, w, v, sin_alpha_minus_beta" in run.out
    assert "how: proved by interval arithmetic, over x, z;" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_every_working_mode(assur_cli):
    data = assur_cli("aspects", "fivebar", "--mode", "all", *WIDE, "--json").json
    assert [item["mode"] for item in data["modes"]] == ["++", "+-", "-+", "--"]
    run = assur_cli("aspects", "fivebar", "--mode", "all", *WIDE)
    assert "aspects of every working mode" in run.out


def test_a_path_with_its_certificate_and_check(assur_cli):
    words = ("aspects", "fivebar", "--mode=-+", *WIDE, "--from", "0,200", "--to", "y=-200,x=0")
    data = assur_cli(*words, "--json").json["path"]
    assert data["status"] == "connected"
    assert data["points"] == FOUND.path([0, 200], [0, -200]).points.tolist()
    assert len(data["boxes"]) == len(data["points"]) - 1
    assert data["check"]["passed"] is True
    run = assur_cli(*words)
    assert run.code == 0
    assert "from one pose to the other: one aspect, +" in run.out
    assert "followed on the joint graph" in " ".join(run.out.split())


@pytest.mark.parametrize(
    ("start", "end", "code", "words"),
    [
        ("0,200", "9,-98", 4, "sin_rods is positive at one and negative at the other"),
        ("0,200", "0,0", 4, "to: reach"),
        ("0,500", "0,0", 4, "from: y = 500 is beyond the box"),
        ("0,285.5", None, 0, "the pose lies in aspect +"),
        ("0,0", None, 4, "not reached"),
    ],
)
def test_other_answers_and_their_exit_codes(assur_cli, start, end, code, words):
    end = () if end is None else ("--to", end)
    run = assur_cli("aspects", "fivebar", "--mode=-+", *WIDE, "--from", start, *end)
    assert (run.code, run.err) == (code, "")
    assert words in " ".join(run.out.split())


def test_angles_are_in_the_units_of_the_mechanism(assur_cli):
    words = ("aspects", "planar_3rpr", "--at", "y=2", "--finest", "2")
    data = assur_cli(*words, "--from", "5,30", "--to", "8,40", "--json").json
    assert data["box"][1] == pytest.approx([-180.0, 180.0])
    assert data["path"]["points"][0] == pytest.approx([5.0, 30.0])


@pytest.mark.parametrize(
    ("ending", "start"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF"), ("json", b"{")]
)
def test_files(assur_cli, tmp_path, ending, start):
    path = tmp_path / f"aspects.{ending}"
    run = assur_cli("aspects", "fivebar", "--mode=-+", *WIDE, "-o", str(path))
    assert (run.code, run.err) == (0, "")
    assert path.read_bytes().startswith(start)
    assert "written: " in run.out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--to", "0,200"), "from where?"),
        (("--from", "0"), "1 value, 2 wanted"),
        (("--from", "0,q"), "is not a number"),
        (("--from", "x=0,q=1"), "x, q given, x, y wanted"),
        (("--mode", "all", "--from", "0,200"), "one working mode"),
        (("--mode", "all", "-o", "a.svg"), "one working mode"),
        (("--mode", "+++"), "working mode"),
        (("--finest", "0"), "not a positive extent"),
        (("-o", "aspects.obj"), "ending"),
        (("-o", "no/such/folder/a.svg"), "no/such/folder"),
    ],
)
def test_misuse_is_refused(assur_cli, words, said):
    run = assur_cli("aspects", "fivebar", *words)
    assert (run.code, run.out) in ((2, ""), (3, ""), (74, ""))
    assert said in run.err
