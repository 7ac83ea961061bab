"""Every notebook runs top to bottom, and shows what is stored in it; no Jupyter is needed for that."""

import base64
import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))


@pytest.fixture(scope="module")
def runner():
    place = importlib.util.spec_from_file_location("notebook", ROOT / "docs" / "extensions" / "notebook.py")
    module = importlib.util.module_from_spec(place)
    place.loader.exec_module(module)
    return module


def words(outputs):
    """What can be compared: text; of a picture only that it is one."""
    return [["".join(output.get("text", output.get("data", {}).get("text/plain", "")))] for output in outputs]


def test_there_is_a_notebook():
    assert NOTEBOOKS


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_it_shows_what_is_stored(path, runner):
    notebook = runner.read(path)
    cells = runner.code(notebook)
    found = runner.run(notebook)
    assert sum(map(len, found)) >= 5
    for cell, outputs in zip(cells, found, strict=True):
        assert words(cell["outputs"]) == words(outputs), "".join(cell["source"])


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_its_cells_were_run_in_order_and_its_pictures_are_whole(path, runner):
    cells = runner.code(runner.read(path))
    assert [cell["execution_count"] for cell in cells] == list(range(1, len(cells) + 1))
    pictures = [
        output["data"]["image/png"] for cell in cells for output in cell["outputs"] if "image/png" in str(output)
    ]
    assert pictures
    for picture in pictures:
        assert base64.b64decode(picture).startswith(b"\x89PNG")


def test_a_cell_that_shows_something_else_is_seen(runner):
    cell = {"cell_type": "code", "source": ["print(1)\n", "2"]}
    assert words(runner.run({"cells": [cell]})[0]) == [["1\n"], ["2"]]


def test_an_answer_is_shown_as_its_table(runner):
    class Shown:
        def _repr_html_(self):
            return "<table></table>"

        def __str__(self):
            return "a table"

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("builtins.shown", Shown, raising=False)
        (outputs,) = runner.run({"cells": [{"cell_type": "code", "source": ["shown()"]}]})
    assert words([*outputs]) == [["a table"]]
    assert runner._shown(outputs[0]) == "<table></table>"


def test_a_cell_that_fails_fails(runner):
    with pytest.raises(ZeroDivisionError):
        runner.run({"cells": [{"cell_type": "code", "source": ["1 / 0"]}]})
