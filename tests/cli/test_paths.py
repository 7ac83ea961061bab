"""Where output goes is looked at before the work begins; what is refused leaves nothing behind."""

import pytest

from assur.cli.paths import made, output_file, output_folder, planned_folder
from assur.errors import OutputError

LONG = "a" * 300


@pytest.mark.parametrize("words", [("figures", "fivebar", "--only", "nothing"), ("synthesize", "--motion", "9T")])
def test_a_command_that_is_refused_makes_no_folder(assur_cli, tmp_path, words):
    option = "--toml" if words[0] == "synthesize" else "-o"
    assert assur_cli(*words, option, str(tmp_path / "new" / "deep")).code == 2
    assert not list(tmp_path.iterdir())


def test_a_planned_folder_is_made_when_it_is_needed(tmp_path):
    folder = planned_folder(str(tmp_path / "new" / "deep"))
    assert not list(tmp_path.iterdir())
    assert made(folder).is_dir()
    assert output_folder(str(tmp_path / "other")).is_dir()


@pytest.mark.parametrize("text", ["", "   "])
def test_an_empty_name_is_refused(text):
    for asked in (planned_folder, lambda name: output_file(name, (".json",))):
        with pytest.raises(OutputError, match="cannot write to an empty name"):
            asked(text)


def test_a_name_that_is_too_long_is_refused_and_cut():
    for asked in (planned_folder, lambda name: output_file(f"{name}.json", (".json",))):
        with pytest.raises(OutputError, match="File name too long") as caught:
            asked(LONG)
        assert len(caught.value.message) < 120


def test_a_file_in_the_way_is_named(tmp_path):
    (tmp_path / "file").write_text("mine")
    for text in (tmp_path / "file", tmp_path / "file" / "deep"):
        with pytest.raises(OutputError, match=f"{tmp_path / 'file'} is no folder"):
            planned_folder(str(text))


@pytest.mark.parametrize("name", ["new", "sweep", "certify"])
def test_empty_names_are_usage_errors_of_every_command(assur_cli, name):
    words = {
        "new": ("new", "", "--from", "fivebar"),
        "sweep": ("sweep", "fivebar", "--along", "x=2", "--along", "y=2", "-o", ""),
        "certify": ("certify", "fivebar", "-o", ""),
    }[name]
    run = assur_cli(*words)
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("error: cannot write to an empty name\nhint: name ")


def test_the_help_of_an_error_names_no_option_that_the_command_lacks(assur_cli, tmp_path, monkeypatch):
    """`assur new` has no -o."""

    def refused(*_, **__):
        raise OSError(13, "Permission denied")

    monkeypatch.setattr("assur.storage._created", refused)
    run = assur_cli("new", str(tmp_path / "my.toml"), "--from", "fivebar")
    assert (run.code, run.err.splitlines()[1]) == (2, "hint: choose another place")
