import json
import math

import pytest

import assur
from assur.workspace.region import workspace
from screw_mechanisms import JACK, loaded

SHAPE = {"volume", "volume_error", "unit", "mode", "coordinates", "box", "held", "parallel_singular", "sections", "how"}
COARSE = ("--resolution", "12")


def test_shape_and_numbers_are_those_of_the_library(assur_cli):
    data = assur_cli("workspace", "zeng2019", *COARSE, "--json").json
    assert data.keys() >= SHAPE
    found = workspace(assur.load("zeng2019"), resolution=12)
    assert {name: data[name] for name in SHAPE} == json.loads(json.dumps(found.to_json()))
    assert [item["z"] for item in data["sections"]] == [300.0, 350.0, 400.0, 450.0]


def test_box_strokes_and_sections_are_taken(assur_cli):
    words = ("--box", "x=-50:50", "--stroke", "-300:300", "--stroke", "yA1=-100:250", "--section", "333", "--near", "5")
    data = assur_cli("workspace", "zeng2019", *COARSE, *words, "--json").json
    assert data["box"] == [[-50.0, 50.0], [-250.0, 250.0], [180.0, 480.0]]
    assert data["strokes"] == {"yA1": [-100.0, 250.0], "yA2": [-300.0, 300.0], "yA3": [-300.0, 300.0]}
    assert [item["z"] for item in data["sections"]] == [333.0]
    assert data["parallel_singular"]["near"] == 5.0
    strokes = {"yA1": (-100, 250), "yA2": (-300, 300), "yA3": (-300, 300)}
    found = workspace(assur.load("zeng2019"), box={"x": (-50, 50)}, strokes=strokes, resolution=12)
    assert data["volume"] == found.volume


def test_strokes_with_and_without_a_name_may_be_one_word(assur_cli):
    one, two = (
        assur_cli("workspace", "zeng2019", *COARSE, *words, "--json").json
        for words in (("--stroke=-300:300,yA1=-100:250",), ("--stroke", "-300:300", "--stroke", "yA1=-100:250"))
    )
    assert one["strokes"] == {"yA1": [-100.0, 250.0], "yA2": [-300.0, 300.0], "yA3": [-300.0, 300.0]}
    assert one == two


def test_strokes_of_angles_are_in_degrees(assur_cli):
    data = assur_cli("workspace", "fivebar", *COARSE, "--stroke", "theta1=0:90", "--json").json
    found = workspace(assur.load("fivebar"), strokes={"theta1": (0, math.pi / 2)}, resolution=12)
    assert data["volume"] == pytest.approx(found.volume)
    assert data["strokes"]["theta1"] == pytest.approx([0.0, 90.0])


def test_another_mode(assur_cli):
    data = assur_cli("workspace", "fivebar", *COARSE, "--mode", "--", "--json").json
    assert data["mode"] == "--"


def test_a_person_sees_volume_error_sections_and_loci(assur_cli):
    run = assur_cli("workspace", "zeng2019", *COARSE, "--stroke", "-300:300")
    assert run.code == 0
    assert "strokes: yA1 -300 .. 300 mm" in run.out
    assert "error: difference to half the resolution" in run.out
    assert "section at z" in run.out
    assert "share within 10 mm of one" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_the_answer_is_written_with_its_polygons(assur_cli, tmp_path):
    path = tmp_path / "w.json"
    run = assur_cli("workspace", "zeng2019", *COARSE, "-o", str(path), "--json")
    written = json.loads(path.read_text())
    polygons = written.pop("section_polygons")
    assert written == run.json
    assert len(polygons) == len(run.json["sections"])


def test_the_surface_is_written_as_triangles(assur_cli, tmp_path):
    path = tmp_path / "w.obj"
    run = assur_cli("workspace", "zeng2019", *COARSE, "-o", str(path))
    assert f"written: {path}" in run.out.replace("\n", "")
    lines = path.read_text().splitlines()
    points = [list(map(float, line.split()[1:])) for line in lines if line.startswith("v ")]
    faces = [list(map(int, line.split()[1:])) for line in lines if line.startswith("f ")]
    volume = workspace(assur.load("zeng2019"), resolution=12).volume
    assert _volume(points, faces) == pytest.approx(volume, rel=1e-5)


def _volume(points, faces):
    total = 0.0
    for i, j, k in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (points[index - 1] for index in (i, j, k))
        total += (ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)) / 6
    return total


def test_sizes_have_the_unit_of_what_varies(assur_cli):
    angles = assur_cli("workspace", "three_rps", "--at", "z=250", "--resolution", "8")
    assert angles.code == 0
    assert "area [rad]" in angles.out
    assert "mm]" not in angles.out
    assert "share within" not in angles.out
    mixed = assur_cli("workspace", "planar_3rrr", "--resolution", "8").out
    assert "area [1 mm as 1 rad]" in mixed
    assert "area [mm^2]" in assur_cli("workspace", "zeng2019", "--resolution", "8").out


def test_a_region_that_is_its_whole_box_is_said_to_be(assur_cli):
    small = ("--box", "x=-10:10", "--box", "y=-10:10", "--box", "z=380:400")
    run = assur_cli("workspace", "zeng2019", "--resolution", "8", *small)
    assert "volume: 8000 mm^3, all of the box: no stroke limits it" in " ".join(run.out.split())
    wide = assur_cli("workspace", "zeng2019", "--resolution", "8", *small, "--stroke", "-900:900")
    assert "all of the box: no limit was seen in it" in " ".join(wide.out.split())
    part = assur_cli("workspace", "zeng2019", "--resolution", "8")
    assert "all of the box" not in part.out


def test_the_strokes_of_the_file_are_told(assur_cli):
    data = assur_cli("workspace", "three_upu", "--resolution", "8", "--json").json
    record = assur.load("three_upu")
    assert data["strokes"] == {item.name: list(item.stroke) for item in record.inputs}


def test_of_a_region_that_is_empty_nothing_is_proved_but_that(assur_cli):
    far = ("--box", "x=1000:1100", "--box", "y=1000:1100", *COARSE)
    run = assur_cli("workspace", "fivebar", *far)
    said = " ".join(run.out.split())
    assert run.code == 0
    assert "area: 0 mm^2: nothing is reached, proved" in said
    assert "none, proved" not in said
    assert "none found" not in said
    data = assur_cli("workspace", "fivebar", *far, "--json").json
    assert (data["empty"], data["nowhere"], data["volume"]) == ("proved", [], 0.0)


def test_a_region_that_the_cells_miss_is_not_said_to_be_proved_empty(assur_cli):
    """P of the five-bar reaches x = 224 on y = 0: of this box a sliver near one side, too thin for the cells."""
    thin = ("--box", "x=223.99:323", "--box", "y=-40:50", "--resolution", "4")
    run = assur_cli("workspace", "fivebar", *thin)
    assert "nothing is reached on 4 cells along each coordinate" in " ".join(run.out.split())
    assert "proved" not in run.out
    assert assur_cli("workspace", "fivebar", *thin, "--json").json["empty"] == "sampled"
    assert assur_cli("workspace", "fivebar", *COARSE, "--json").json["empty"] is None


@pytest.mark.parametrize("words", [("--resolution", "8"), ("--certify",), ("--prove", "x=-40:0,y=-50:50,z=380:400")])
def test_where_no_limits_are_stated_every_claim_of_reach_says_so(assur_cli, words):
    run = assur_cli("workspace", "zeng2019", *words)
    assert "limits: no limits are stated" in run.out
    assert "within limits" not in run.out
    assert assur_cli("workspace", "zeng2019", *words, "--json").json["limits_stated"] is False
    given = assur_cli("workspace", "zeng2019", *words, "--stroke", "-900:900")
    assert "no limits are stated" not in given.out


def test_the_largest_cylinder_says_so_too(assur_cli):
    words = ("workspace", "delta_4s", "--largest", "cylinder", "--around", "x=0,y=0,z=-1")
    run = assur_cli(*words)
    assert run.out.splitlines()[2:4] == [
        "limits: no limits are stated",
        "inside: every pose is reached, and none is singular",
    ]


def test_of_a_single_coordinate_the_extent_is_a_length(assur_cli, tmp_path):
    loaded(tmp_path, JACK)
    shown = assur_cli(
        "workspace", str(tmp_path / "jack.toml"), "--box", "z=-10:10", "--stroke", "0:90", "--resolution", "8"
    )
    assert "length: 2" in shown.out
    assert "area:" not in shown.out
