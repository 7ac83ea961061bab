import json
import re

import pytest


def test_files_are_written_and_named(assur_cli, tmp_path):
    folder = tmp_path / "a" / "figures"
    run = assur_cli("figures", "fivebar", "-o", str(folder), "--only", "model", "flow", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json["mechanism"] == "fivebar"
    assert [item["name"] for item in run.json["figures"]] == ["model", "flow"]
    listed = {path for item in run.json["figures"] for path in item["files"]}
    assert listed == {str(path) for path in folder.iterdir()}
    assert {path.suffix for path in folder.iterdir()} == {".png", ".pdf", ".tex", ".json"}
    assert all(json.loads(path.read_text()) for path in folder.glob("*.json"))


def test_a_format_may_be_chosen(assur_cli, tmp_path):
    run = assur_cli("figures", "fivebar", "-o", str(tmp_path), "--only", "flow", "--format", "svg")
    assert run.code == 0
    assert "flow.svg" in run.out
    assert [path.suffix for path in tmp_path.iterdir()] == [".svg"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--only", "modle"), "error: unknown figure of fivebar 'modle'; there is: "),
        (("--only", "projections"), "error: unknown figure of fivebar 'projections'; there is: "),
        (("--format", "gif"), "error: unknown figure format 'gif'; there is: json, pdf, png, svg, tex\n"),
    ],
)
def test_a_wrong_name_is_refused_and_nothing_is_made(assur_cli, tmp_path, words, message):
    run = assur_cli("figures", "fivebar", "-o", str(tmp_path / "new"), *words)
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(message)
    assert list(tmp_path.iterdir()) == []


def test_the_near_name_is_offered(assur_cli):
    assert assur_cli("figures", "fivebar", "--only", "modle").err.endswith("\nhint: did you mean model?\n")


def test_a_figure_that_the_mechanism_does_not_have_says_why(assur_cli):
    run = assur_cli("figures", "fivebar", "--only", "projections")
    assert run.err.endswith("\nhint: the workspace is plane; its figure shows all of it\n")


def test_a_file_where_the_folder_should_be_is_left_whole(assur_cli, tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    run = assur_cli("figures", "fivebar", "-o", str(path), "--only", "flow")
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(f"error: cannot make the folder {path}: ")
    assert path.read_text() == "old"


def test_a_journals_width_is_kept_and_told(assur_cli, tmp_path):
    words = ("--only", "structure", "--width", "ieee", "--format", "tex")
    run = assur_cli("figures", "fivebar", "-o", str(tmp_path), *words)
    assert run.code == 0
    assert "structure.tex" in run.out
    size = re.search(r"(\d+\.\d) x \d+\.\d", run.out)
    assert float(size[1]) <= 88.9
    text = (tmp_path / "structure.tex").read_text()
    assert f"\\includegraphics[width={size[1]}mm]{{structure}}" in text
    assert text.isascii()


def test_a_width_that_is_none_makes_nothing(assur_cli, tmp_path):
    run = assur_cli("figures", "fivebar", "-o", str(tmp_path / "new"), "--width", "acm")
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("error: 'acm' is no width of a page\nhint: one of ieee, ieee2, ")
    assert list(tmp_path.iterdir()) == []
