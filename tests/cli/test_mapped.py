import json

import numpy as np
import pytest

import assur
from assur.performance.indices import INDICES
from assur.results.json_text import json_text
from assur.workspace.index_maps import index_maps
from assur.workspace.region import workspace

SMALL = ("--nodes", "5", "--resolution", "8")


def test_it_says_what_the_library_says(assur_cli):
    run = assur_cli("indices", "zeng2019", "--map", "x,z", "--at", "y=10", *SMALL, "--json")
    record = assur.load("zeng2019")
    region = workspace(record, resolution=8, sections=(), held={"y": 10.0})
    expected = index_maps(record, region, ("x", "z"), nodes=5).in_degrees()
    assert run.code == 0
    assert run.json == json.loads(json_text(expected.answer()))


def test_what_is_not_held_is_in_mid_box_and_angles_are_in_degrees(assur_cli):
    found = assur_cli("indices", "planar_3rrr", "--map", "x,phi", *SMALL, "--json").json
    record = assur.load("planar_3rrr")
    assert found["held"] == {"y": pytest.approx(sum(record.box["y"]) / 2)}
    assert found["axes"]["phi"] == pytest.approx(np.degrees(np.linspace(*record.box["phi"], 5)).tolist())
    many = assur_cli("indices", "gough_stewart", "--map", "x,y", "--nodes", "3", "--resolution", "4", "--json").json
    assert set(many["held"]) == {"z", "phi", "theta", "psi"}


@pytest.mark.parametrize("ending", ["npz", "csv", "json", "png", "svg"])
def test_files_are_written(assur_cli, tmp_path, ending):
    path = tmp_path / f"maps.{ending}"
    run = assur_cli("indices", "fivebar", "--map", "x,y", *SMALL, "-o", str(path), "--json")
    assert run.code == 0
    content = path.read_bytes()
    if ending == "npz":
        values = np.load(path, allow_pickle=False)["transmission"]
        assert [[None if np.isnan(v) else v for v in row] for row in values] == run.json["maps"]["transmission"][
            "values"
        ]
    elif ending == "json":
        assert json.loads(content) == run.json
    elif ending == "csv":
        assert content.decode().splitlines()[0].startswith("x [mm],y [mm],status,condition")
        assert content.count(b"\n") == 26
    else:
        assert content.startswith({"png": b"\x89PNG", "svg": b"<?xml"}[ending])


def test_a_person_sees_every_index_with_its_extremes_and_what_was_looked_for(assur_cli):
    out = assur_cli("indices", "fivebar", "--map", "x,y", *SMALL).out
    for word in (*INDICES, "distance [mm]", "mean", "least", "most", "nodes in the workspace", "within 194 mm"):
        assert word in out
    assert "none" in assur_cli("indices", "fivebar", "--map", "x,y", "--box", "x=800:900", *SMALL).out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("fivebar --map x,q", "q"),
        ("fivebar --map x,x", "names a coordinate twice"),
        ("zeng2019 --map x,z --at x=0", "x varies, and --at holds it"),
        ("fivebar --map x,y --nodes 1", "nodes: 1 is not"),
        ("fivebar --map x -o maps.png", "cannot draw 1 coordinates"),
        ("fivebar --map x,y -o maps.xls", "its ending is none of"),
        ("fivebar -o maps.npz", "of a map alone"),
        ("fivebar --map x,y --pose 0 200", "a map is of many poses"),
    ],
)
def test_bad_words_are_refused(assur_cli, words, message):
    run = assur_cli("indices", *words.split())
    assert run.code == 2
    assert message in run.err
