import pytest

from assur.derived_topology import mode_values
from assur.model.registry import load_record
from assur.page.address import joints_hash


def test_it_says_what_it_wrote(assur_cli, tmp_path):
    path = tmp_path / "z.html"
    run = assur_cli("page", "zeng2019", "-o", str(path), "--resolution", "12")
    assert (run.code, run.err) == (0, "")
    text = " ".join(run.out.split())
    assert "14 links, 17 joints, 4 loops" in text
    assert "sliders: yA1, yA2, yA3; x, y, z" in text
    assert "4 assembly modes, 8 working modes" in text
    assert f"({path.stat().st_size / 1e3:.0f} kB)" in text
    assert [item.name for item in tmp_path.iterdir()] == ["z.html"]


def test_json_counts_what_is_inside(assur_cli, tmp_path):
    path = tmp_path / "f.html"
    run = assur_cli("page", "fivebar", "-o", str(path), "--json")
    assert (run.code, run.err) == (0, "")
    inside = run.json.pop("inside")
    assert run.json | {"inside": None} == {
        "mechanism": "fivebar",
        "file": str(path),
        "bytes": path.stat().st_size,
        "inside": None,
    }
    assert (inside["assembly_modes"], inside["working_modes"]) == (2, 4)
    assert inside["layers"] == {"workspace": 1, "singular": 0, "section": 0, "force": 2}


def test_dimensions_are_those_given(assur_cli, tmp_path):
    path = tmp_path / "f.html"
    assert assur_cli("page", "fivebar", "--set", "l1=110", "-o", str(path)).code == 0
    assert '"l1", "value": 110' in path.read_text() or '"l1","value":110' in path.read_text()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("fivebar", "-o", "{folder}/p.txt"), "its ending is none of .html, .htm"),
        (("fivebar", "-o", "{folder}/none/p.html"), "the folder {folder}/none does not exist"),
        (("fivebar", "-o", "{folder}/p.html", "--resolution", "2"), "2 cells are too few"),
        (("nobody", "-o", "{folder}/p.html"), "nobody"),
    ],
)
def test_misuse_is_refused_and_leaves_nothing(assur_cli, tmp_path, words, message):
    run = assur_cli("page", *(word.format(folder=tmp_path) for word in words))
    assert (run.code, run.out) == (2, "")
    assert message.format(folder=tmp_path) in run.err
    assert list(tmp_path.iterdir()) == []


def test_the_address_begins_in_the_operation_mode_that_is_named(assur_cli, tmp_path):
    path = tmp_path / "u.html"
    run = assur_cli("page", "three_upu", "--mode", "3R", "-o", str(path), "--resolution", "8", "--json")
    assert (run.code, run.err) == (0, "")
    values = mode_values(load_record("three_upu"), "3R")
    assert run.json["address"] == path.as_uri() + joints_hash(values)


def test_a_mode_that_is_not_met_is_refused_before_anything_is_written(assur_cli, tmp_path):
    run = assur_cli("page", "fivebar", "--mode", "3T", "-o", str(tmp_path / "f.html"))
    assert (run.code, list(tmp_path.iterdir())) == (2, [])
    assert "1T1R" in run.err
