"""`assur workspace` with proofs: the library's numbers, bad input refused, interruption."""

import math
from fractions import Fraction

import mpmath
import pytest

import assur
from assur.cli.certified_regions import outer_box
from assur.errors import UsageError
from assur.results.outward import outward as bounds
from assur.workspace.certified import paving, proving
from assur.workspace.certified.largest import largest
from assur.workspace.certified.proving import prove_box
from assur.workspace.certified.region import certified_workspace

ZENG = assur.load("zeng2019")
ASKED = {"mechanism": "zeng2019", "limits_stated": False, "joint_limits": []}
AROUND = ("--around", "x=-40,y=0,z=400")


def test_bounds_are_those_of_the_library(assur_cli):
    data = assur_cli("workspace", "zeng2019", "--certify", "--gap", "1e-4", "--json").json
    found = certified_workspace(ZENG, gap=1e-4)
    assert ASKED.items() <= data.items()
    assert (data["volume"], data["box"]) == (list(found.volume), found.box.intervals)
    assert [item["area"] for item in data["sections"]] == [list(item.area) for item in found.sections]
    counts = {"inside": len(found.paving.inside), "outside": len(found.paving.outside)}
    assert counts.items() <= data["boxes"].items()
    assert (data["gap"], data["gap_reached"], data["note"]) == (1e-4, found.gap_reached, found.note)
    assert data["volume"][0] < 22_814_586.4 < data["volume"][1]
    assert [item["z"] for item in data["sections"]] == [300.0, 350.0, 400.0, 450.0]


def test_a_person_sees_bounds_of_volume_and_sections(assur_cli):
    run = assur_cli("workspace", "zeng2019", "--certify", "--section", "400", "--box", "x=-50:50")
    assert run.code == 0
    assert "how: proved by interval arithmetic, gap" in run.out
    assert "boxes over x, z:" in run.out
    assert "least [mm^2]" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_a_size_in_place_of_a_gap(assur_cli):
    data = assur_cli("workspace", "zeng2019", "--certify", "--finest", "10", "--json").json
    assert data["gap"] is None
    assert data["boxes"]["boundary"] > 50


def test_angles_are_in_degrees(assur_cli):
    words = ("--box", "phi=-10:10", "--box", "x=-20:20", "--box", "y=-20:20", "--gap", "0.1", "--json")
    data = assur_cli("workspace", "planar_3rrr", "--certify", *words).json
    assert data["box"][2] == pytest.approx([-10, 10])
    turn = math.radians(10)
    found = certified_workspace(assur.load("planar_3rrr"), box=[(-20, 20), (-20, 20), (-turn, turn)], gap=0.1)
    assert data["volume"] == pytest.approx(list(found.volume))
    held = assur_cli("workspace", "planar_3rrr", "--certify", "--at", "phi=5", "--json").json
    assert held["held"] == pytest.approx({"phi": 5.0})


@pytest.mark.parametrize(("heights", "status", "code"), [("380:400", "proved", 0), ("180:400", "refuted", 4)])
def test_a_box_is_proved_or_refuted(assur_cli, heights, status, code):
    run = assur_cli("workspace", "zeng2019", "--prove", f"x=-40:0,y=-50:50,z={heights}")
    assert run.code == code
    assert f"answer: {status}" in run.out
    assert ("fails at: x = " in run.out) == (status == "refuted")
    data = assur_cli("workspace", "zeng2019", "--prove", f"x=-40:0,y=-50:50,z={heights}", "--json").json
    low, high = map(float, heights.split(":"))
    found = prove_box(ZENG, [(-40, 0), (-50, 50), (low, high)])
    assert ASKED.items() <= data.items()
    assert (data["status"], data["share_proved"]) == (found.status, found.share)
    assert (data["witness"] or {}).get("pose") == (found.witness and found.witness.pose)
    assert data["boxes"]["coordinates"] == ["x", "z"]
    assert all(len(box) == 2 for box in data["boxes"]["largest_doubtful"])
    assert data["boxes"]["doubtful"] == len(found.doubtful) >= len(data["boxes"]["largest_doubtful"])


def test_the_box_that_is_proved_holds_the_one_in_degrees(assur_cli, monkeypatch):
    """-10 and 10 deg are no floats in rad: the box of the nearest floats need not hold all that was asked for."""
    asked = []
    honest = proving.prove_box
    monkeypatch.setattr(
        "assur.cli.certified_regions.prove_box",
        lambda record, box, *rest, **more: (
            asked.append(box),
            honest(record, box, *rest, **more),
        )[1],
    )
    words = ("--box", "x=-5:5", "--prove", "phi=-10:10,y=-5:5", "--json")
    data = assur_cli("workspace", "planar_3rrr", *words).json
    (box,) = asked
    with mpmath.workdps(40):
        assert box["phi"][0] < -10 * mpmath.pi / 180 < 10 * mpmath.pi / 180 < box["phi"][1]
    assert (box["x"], box["y"]) == ((-5.0, 5.0), (-5.0, 5.0))
    assert data["box"][2] == pytest.approx([-10, 10])


def test_so_does_that_of_the_file(assur_cli):
    record = assur.load("planar_3rpr")
    low, high = outer_box(record, {})["phi"]
    assert (low <= record.box["phi"][0], record.box["phi"][1] <= high) == (True, True)
    assert outer_box(record, {}, {"phi": 0.0}).keys() == {"x", "y"} & record.box.keys()


def test_a_mechanism_whose_only_mode_has_no_signs_says_so(assur_cli):
    for words in (("--prove", "x=0:1,y=0:1,phi=0:1"), ("--largest", "ball", "--at", "phi=0", "--around", "x=0,y=0")):
        assert " in its only working mode\n" in assur_cli("workspace", "planar_3rpr", *words).out


def test_what_is_undecided_has_a_code_of_its_own(assur_cli):
    run = assur_cli("workspace", "zeng2019", "--mode", "+++++", "--prove", "x=-40:0,y=-50:50,z=380:400")
    assert run.code == 5
    assert "answer: undecided" in run.out


def test_the_largest_shapes(assur_cli):
    data = assur_cli("workspace", "zeng2019", "--largest", "cylinder", "--ratio", "0.5", *AROUND, "--json").json
    found = largest(ZENG, "cylinder", (-40, 0, 400), ratio=0.5)
    assert ASKED.items() <= data.items()
    assert (data["shape"], data["centre"]) == ("cylinder", {"x": -40.0, "y": 0.0, "z": 400.0})
    assert (data["size"], data["height"], data["refuted"]) == (found.size, found.height, found.refuted)
    assert data["witness"]["pose"] == found.witness.pose
    run = assur_cli("workspace", "zeng2019", "--largest", "cube", *AROUND)
    assert run.code == 0
    assert "proved up to: edge 45.2" in run.out
    assert "because: M3 < 0: not reached" in run.out
    nothing = assur_cli("workspace", "zeng2019", "--largest", "ball", "--around", "x=0,y=0,z=900")
    assert nothing.code == 4


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--certify", "--gap", "0"), "--gap: 0 is not positive"),
        (("--certify", "--gap", "x"), "--gap: 'x' is not a number"),
        (("--certify", "--finest", "-1"), "--finest: -1 is not a positive length"),
        (("--certify", "--gap", "1", "--finest", "1"), "give one of them"),
        (("--certify", "--resolution", "9"), "of the estimate, not of a proof"),
        (("--gap", "0.1"), "--gap: part of a proof"),
        (("--prove", "x=5:5"), "turned round or empty"),
        (("--prove", "x=9:5"), "turned round or empty"),
        (("--prove", "q=1:5"), "unknown pose coordinate"),
        (("--prove", "x"), "is not NAME=VALUE"),
        (("--prove", "x=1:5", "--largest", "cube"), "two questions"),
        (("--largest", "cube"), "about which point"),
        (("--largest", "cube", "--around", "x=1"), "x given"),
        (("--largest", "sphere", "--around", "x=1"), "sphere"),
        (("--around", "x=1"), "add --largest cube"),
        (("--largest", "ball", "--around", "x=0,y=0,z=400", "--ratio", "2"), "--ratio is of a cylinder"),
        (("--certify", "--ratio", "2"), "--ratio belongs to --largest"),
        (("--certify", "--section", "1000"), "outside the box"),
    ],
)
def test_bad_input_is_refused(assur_cli, words, said):
    run = assur_cli("workspace", "zeng2019", *words)
    assert run.code == 2
    assert run.out == ""
    assert said in run.err


def test_too_many_boxes_are_said_with_what_it_would_take(assur_cli):
    run = assur_cli("workspace", "zeng2019", "--certify", "--gap", "1e-9", "--boxes", "2000")
    assert run.code == 0
    assert "note: as many boxes were looked at as may be" in run.out
    assert "would take about" in " ".join(run.out.split())


def test_after_ctrl_c_the_bounds_reached_are_printed(assur_cli, monkeypatch):
    judged, calls = paving.judged, []

    def interrupted(*given):
        calls.append(given)
        if len(calls) == 4:
            raise KeyboardInterrupt
        return judged(*given)

    monkeypatch.setattr(paving, "judged", interrupted)
    run = assur_cli("workspace", "zeng2019", "--certify", "--gap", "1e-6")
    assert run.code == 0
    assert "note: interrupted" in run.out
    assert "volume: " in run.out
    assert "section at" not in run.out


def test_printed_bounds_are_rounded_outwards():
    for low, high in ((0.1, 0.3), (22810123.414, 22824645.233), (1 - 1e-16, 1.0), (1e-300, 1.0), (5.0, 5.0)):
        least, most = bounds(low, high)
        assert Fraction(least) <= Fraction(low) <= Fraction(high) <= Fraction(most)
        assert Fraction(most) - Fraction(least) <= (Fraction(high) - Fraction(low)) * Fraction(13, 10)


def test_help_shows_examples_that_run(assur_cli):
    text = assur_cli("workspace", "--help").out
    lines = [line.strip() for line in text.splitlines() if line.strip().startswith("assur workspace zeng2019 --")]
    proofs = [line for line in lines if "--certify" in line or "--prove" in line or "--largest" in line]
    assert len(proofs) == 3
    for line in proofs:
        assert assur_cli(*line.split()[1:]).code == 0


def test_the_library_raises_what_the_command_says():
    with pytest.raises(UsageError):
        certified_workspace(ZENG, gap=0.0)


@pytest.mark.parametrize(
    "words", [("workspace", "--certify"), ("workspace", "--prove", "x=-5:5"), ("aspects",)], ids=lambda words: words[-1]
)
def test_a_file_without_a_closed_form_is_told_what_works_without_one(assur_cli, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    assert assur_cli("new", "my.toml", "--from", "fivebar").code == 0
    run = assur_cli(words[0], "my.toml", *words[1:])
    assert (run.code, run.out) == (2, "")
    error, hint = run.err.splitlines()
    assert error == "error: my has no closed form"
    assert hint.startswith("hint: proofs over regions need one")
    named = hint.partition("; ")[2].partition(" work on the joint graph")[0]
    assert named == "direct, inverse, singularity, follow, sweeps and workspace without a proof"
    values = {
        "direct": ("127", "53"),
        "inverse": ("0", "200"),
        "singularity": ("--pose", "0", "200"),
        "follow": ("--to", "10", "200"),
        "workspace": ("--resolution", "6"),
    }
    assert [word for word in values if word in named.replace(",", "").split()] == list(values)
    for command, rest in values.items():
        assert assur_cli(command, "my.toml", *rest).code == 0


def test_a_box_a_few_floats_high_ends_undecided_and_says_why(assur_cli):
    reach = math.sqrt((100 + 194) ** 2 - 70**2)  # crank and rod in line
    above = math.nextafter(math.nextafter(reach, 1e9), 1e9)
    run = assur_cli("workspace", "fivebar", "--mode=-+", "--prove", f"x=0:5e-324,y={reach!r}:{above!r}")
    assert (run.code, run.err) == (5, "")
    said = " ".join(run.out.split())
    assert "note: floats cannot halve the open parts any further; what was not looked at counts as undecided" in said


def test_the_number_of_boxes_is_a_budget(assur_cli):
    words = ("workspace", "zeng2019", "--prove", "x=-110:90,y=-250:250,z=180:480")
    run = assur_cli(*words, "--boxes", "300")
    assert "--boxes raises that" in run.out
    for bad in ("0", "-1"):
        assert assur_cli(*words, "--boxes", bad).err.startswith(f"error: --boxes: {bad} is not positive")
