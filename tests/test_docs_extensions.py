"""What builds the site: formulas as MathML, docstrings as plain text, and what is made for the pages."""

import importlib
import json
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from assur.report.formulas.latex import latex_mathml

ROOT = Path(__file__).parents[1]


@pytest.fixture
def extension(monkeypatch):
    """A function that imports one of docs/extensions by name."""
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "extensions"))
    yield importlib.import_module
    for path in (ROOT / "docs" / "extensions").glob("*.py"):
        sys.modules.pop(path.stem, None)


# ---- formulas ----------------------------------------------------------------------------------------------


@pytest.mark.site
@pytest.mark.parametrize(("display", "block"), [("inline", False), ("block", True)])
def test_a_formula_is_what_the_reader_of_the_report_makes_of_it(extension, display, block):
    from docutils import nodes

    formulas, latex, writer = extension("formulas"), r"\tfrac12\dot\phi < 1", SimpleNamespace(body=[])
    node = (nodes.math_block if block else nodes.math)(latex, latex)
    with pytest.raises(nodes.SkipNode):
        (formulas.block if block else formulas.inline)(writer, node)
    assert f"<mrow>{latex_mathml(latex)}</mrow></math>" in writer.body[0]
    assert f'display="{display}" alttext="\\tfrac12\\dot\\phi &lt; 1"' in writer.body[0]


@pytest.mark.site
@pytest.mark.parametrize(
    ("latex", "said"), [(r"\oint x", [r"\oint"]), ("x_", ["x_"]), (r"\oint x < 1", [r"\oint"]), ("x", [])]
)
def test_what_is_not_understood_is_a_warning(extension, monkeypatch, latex, said):
    from docutils import nodes

    formulas, warned = extension("formulas"), []
    monkeypatch.setattr(formulas.LOGGER, "warning", lambda *said, **_: warned.append(said[1]))
    with pytest.raises(nodes.SkipNode):
        formulas.inline(SimpleNamespace(body=[]), nodes.math(latex, latex))
    assert warned == said


# ---- docstrings --------------------------------------------------------------------------------------------


@pytest.mark.site
def test_signs_of_a_docstring_mean_nothing_but_examples_stay(extension):
    lines = ["`name_` of |x| and *y*, J_ too; see `assur.load`", "", ">>> a * b", "2 | 3", "", "*again*"]
    assert list(extension("docstrings").escaped(lines)) == [
        r"``name_`` of \|x\| and \*y\*, J\_ too; see :py:obj:`assur.load`", "", ">>> a * b", "2 | 3", "", r"\*again\*",
    ]  # fmt: skip


@pytest.mark.site
def test_errors_are_a_list_however_many_lines_each_takes(extension):
    lines = ["Errors:", "    AError: one", "        and more", "    BError: two", "", "After."]
    assert extension("docstrings").with_list_of_errors(lines) == [
        "Errors:", "    * AError: one and more", "    * BError: two", "", "After.",
    ]  # fmt: skip


# ---- made at build time ------------------------------------------------------------------------------------


def test_a_figure_is_drawn_once_until_a_source_changes(extension, tmp_path, monkeypatch):
    gallery = extension("gallery")
    drawings = []
    draw = gallery._draw
    monkeypatch.setattr(gallery, "_draw", lambda *given: drawings.append(given[1]) or draw(*given))
    source = tmp_path / "src" / "assur" / "figures" / "graph.py"
    source.parent.mkdir(parents=True)
    source.write_text("first")
    first = gallery.markdown(tmp_path, "fivebar", "graph")
    assert gallery.markdown(tmp_path, "fivebar", "graph") == first
    assert drawings == ["graph"]
    source.write_text("second")
    assert gallery.markdown(tmp_path, "fivebar", "graph") == first
    assert drawings == ["graph", "graph"]
    (tmp_path / "src" / "assur" / "cli").mkdir()
    (tmp_path / "src" / "assur" / "cli" / "main.py").write_text("no figure depends on it")
    gallery.markdown(tmp_path, "fivebar", "graph")
    assert drawings == ["graph", "graph"]
    assert (tmp_path / "build" / "gallery" / "fivebar" / "graph.png").read_bytes().startswith(b"\x89PNG")
    assert json.loads((tmp_path / "build" / "gallery" / "fivebar" / "graph.json").read_text())["caption"] in first


def test_every_kind_of_figure_is_there_for_a_task_and_its_command_draws_it(extension, monkeypatch):
    from assur.figures.catalogue import ENTRIES

    tasks = extension("tasks")
    assert {*tasks.TASKS} == {entry.name for entry in ENTRIES}
    monkeypatch.setattr(tasks.gallery, "places", lambda _, name, own: {figure: f"{name}/{figure}" for figure in own})
    rows = re.findall(
        r"\* - (.*)\n  - ```{image} (\w+)/(\w+)\n.*\n.*\n    ```\n  - `assur figures (\w+) --only (\w+)`",
        tasks.markdown(None, "zeng2019", "parasitic=three_rps"),
    )
    assert [row[0] for row in rows] == [*tasks.TASKS.values()]
    assert all(row[1:3] == row[3:5] for row in rows)
    assert {row[1] for row in rows if row[2] == "parasitic"} == {"three_rps"}
    assert len([row for row in rows if row[1] == "three_rps"]) == 1


def test_a_page_of_its_own_words_takes_one_figure(extension, tmp_path):
    whole = extension("gallery").markdown(tmp_path, "fivebar", "graph")
    picture = extension("made").fill("before <!-- made: figure fivebar graph --> after", tmp_path)
    shown = re.fullmatch(r"before (!\[.*) after", picture, re.DOTALL)[1]
    assert shown in whole


def test_the_lines_of_a_figure_make_it(extension, tmp_path, monkeypatch):
    import assur
    from assur.cli.main import main
    from assur.figures.catalogue import write

    text = extension("gallery").markdown(tmp_path, "fivebar", "graph")
    command, python = (text.split(f"```{kind}\n")[1].split("\n```")[0] for kind in ("sh", "python"))
    monkeypatch.chdir(tmp_path)
    assert main(command.split()[1:]) == 0
    made = {path.name: path.read_bytes() for path in Path("figures").iterdir()}
    assert len(made) == 4
    for path in Path("figures").iterdir():
        path.unlink()
    exec(python, {"assur": assur, "write": write})
    assert {path.name: path.read_bytes() for path in Path("figures").iterdir()} == made


def test_every_module_is_listed_with_its_idea(extension):
    packages = extension("packages")
    text = packages.markdown(ROOT)
    assert "| `poc` | " in text
    modules = [path for path in (ROOT / "src" / "assur").rglob("[!_]*.py") if "mechanisms" not in path.parts]
    top = {"cache", "derived_topology", "errors", "improved_topology", "mechanism", "storage", "version", "work"}
    assert text.count("\n| `") == len([path for path in modules if path.stem not in top or path.parent.name != "assur"])
    assert packages.idea(ROOT / "src" / "assur" / "topology" / "poc.py") in text


def test_layers_are_those_of_the_project(extension):
    lines = extension("packages").layers(ROOT).splitlines()
    assert lines[1] == "cli"
    assert lines.index("mechanism") < lines.index("kinematics")


@pytest.mark.site
def test_a_mark_is_replaced_and_a_block_of_python_ends_without_a_blank_line(extension):
    text = "```python\n>>> 1\n1\n\n```\n\n```sh\nassur list\n```\n\n<!-- made: layers -->\n"
    found = extension("made").fill(text, ROOT)
    assert found.startswith("```python\n>>> 1\n1\n```\n\n```sh\nassur list\n```\n\n```text\ncli\n")
    assert "<!--" not in found


# ---- the table of indices ----------------------------------------------------------------------------------


def test_the_table_of_indices_has_a_row_for_each_with_what_it_is(extension):
    from assur.performance.indices import INDICES

    page = (ROOT / "docs" / "indices.md").read_text(encoding="utf-8")
    assert page.count("<!-- made: indices -->") == 1
    head, line, *rows = extension("index_table").markdown(ROOT).splitlines()
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in (head, line, *rows)]
    assert {len(row) for row in cells} == {6}
    assert [row[0] for row in cells[2:]] == [*(f"`{name}`" for name in INDICES), "`distance`"]
    assert all(row[1] and row[3] and row[4] for row in cells[2:])
