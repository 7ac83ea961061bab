import shutil

import pytest

from assur.cli.main import main
from assur.mechanism import load
from assur.page.content import content
from assur.page.facts import errata, errata_note
from assur.page.origin import left_out, original
from catalogue import each


def copy(folder, *, model="zeng2019", name="my", old="", new="", whole=False):
    """A copy of a mechanism of the catalogue, some text of it changed; the whole folder or the file alone."""
    source = load(model).folder
    path = folder / name
    shutil.copytree(source, path) if whole else path.mkdir()
    text = (source / "mechanism.toml").read_text(encoding="utf-8")
    assert old in text
    (path / "mechanism.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
    return load(path)


@pytest.mark.parametrize("name", each())
def test_the_catalogue_is_no_copy_and_has_its_errata(name):
    record = load(name)
    found = content(record, [])
    assert found["original"] is None
    assert all(item["original"] is None for item in found["parameters"])
    assert left_out(record) == ""
    assert bool(found["errata"]) == (record.folder / "reference" / "errata.toml").is_file()


def test_dimensions_that_were_changed_on_the_way_are_told_from_those_of_the_file():
    found = content(load("zeng2019", l2=300, l7=20), [])
    assert found["original"] == {"name": "its file"}
    differing = {
        item["name"]: (item["value"], item["original"]) for item in found["parameters"] if item["original"] is not None
    }
    assert differing == {"l2": (300, 280), "l7": (20, 0)}
    assert found["errata"] == []
    assert "l2 = 300" in found["errataNote"]
    assert "l2 = 280" in found["errataNote"]


@pytest.mark.parametrize("whole", [True, False])
def test_a_copy_with_another_dimension_has_that_beside_the_originals_and_no_errata(tmp_path, whole):
    record = copy(tmp_path, old="l2 = { value = 280", new="l2 = { value = 300", whole=whole)
    found = original(record)
    assert (found.name, found.other("l2", 300.0), found.other("l3", 140.0)) == ("zeng2019", 280.0, None)
    assert errata(record) == []
    assert errata_note(record).startswith(
        "Those of the source are left out" if whole else "Not looked for in this file"
    )


def test_a_copy_of_the_whole_folder_under_another_name_keeps_the_errata(tmp_path):
    record = copy(tmp_path, old='name   = "zeng2019"', new='name   = "other"', whole=True)
    assert record.name == "other"
    assert original(record).name == "zeng2019"
    assert errata(record) == errata(load("zeng2019"))


def test_a_copy_that_new_writes_says_what_it_is_one_of(tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--from", "fivebar", "--json"]) == 0
    found = original(load(path))
    assert found.name == "fivebar"
    assert all(found.other(name, item.value) is None for name, item in load(path).parameters.items())
    assert errata_note(load(path)) == "None are known."


def test_a_file_of_ones_own_is_no_copy(tmp_path):
    record = copy(tmp_path, model="fivebar", old='title  = "planar', new='title  = "my own')
    assert original(record) is None
    assert original(record.with_parameters(l1=110)).other("l1", 110.0) == load("fivebar").parameters["l1"].value


def test_dimensions_that_one_of_them_lacks_are_not_compared(tmp_path):
    assert original(copy(tmp_path)).other("nothing", 1.0) is None
