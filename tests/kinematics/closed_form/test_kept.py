"""Notes and files of unfinished grids."""

from __future__ import annotations

import json

import numpy as np
import pytest

from assur.errors import UsageError
from assur.kinematics.closed_form.kept import RowsFile, State, make_files

QUESTION = {"counts": (3, 4), "mode": "+", "box": {"x": [0.1, 0.30000000000000004]}}


def test_a_note_is_read_again(tmp_path):
    path = tmp_path / "new" / "state.json"
    first = State(path, QUESTION)
    assert (first.known, first.done) == (False, 0)
    first.save(7, {"sum": 0.1 + 0.2})
    again = State(path, QUESTION)
    assert (again.known, again.done, again.total) == (True, 7, {"sum": 0.1 + 0.2})
    assert [item.name for item in path.parent.iterdir()] == ["state.json"]


def test_without_a_path_nothing_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    State(None, QUESTION).save(3, None)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("change", [{"mode": "-"}, {"box": {"x": [0.1, 0.3]}}, {"more": 1}])
def test_another_question_is_refused(tmp_path, change):
    State(tmp_path / "s", QUESTION).save(1, None)
    with pytest.raises(UsageError, match=f"differs in {next(iter(change))}"):
        State(tmp_path / "s", {**QUESTION, **change})


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"question": {}, "done": "x", "total": 0}'])
def test_what_is_no_note_is_refused(tmp_path, text):
    (tmp_path / "s").write_text(text)
    with pytest.raises(UsageError, match="not a note"):
        State(tmp_path / "s", QUESTION)
    assert (tmp_path / "s").read_text() == text


def test_rows_are_written_by_parts(tmp_path):
    files = {"inputs": tmp_path / "inputs.npy", "exists": tmp_path / "exists.npy"}
    make_files(files, {"inputs": (2, 3, 4), "exists": (3, 4)})
    rows, truths = np.random.default_rng(0).normal(size=(2, 12)), np.arange(12) % 3 == 0
    for name, values in (("inputs", rows), ("exists", truths[None])):
        with files[name].open("r+b") as file:
            target = RowsFile(file, 12)
            for part in (slice(5, 12), slice(0, 5)):
                target.write(part.start, values[:, part])
    np.testing.assert_array_equal(np.load(files["inputs"]), rows.reshape(2, 3, 4))
    np.testing.assert_array_equal(np.load(files["exists"]), truths.reshape(3, 4))


@pytest.mark.parametrize("foreign", [False, True])
def test_what_cannot_be_made_is_told_and_nothing_is_left(tmp_path, monkeypatch, foreign):
    """Also where somebody else writes into a new folder meanwhile; that alone stays."""
    files = {name: tmp_path / "new" / "deep" / f"{name}.npy" for name in ("inputs", "exists")}
    make = np.lib.format.open_memmap

    def second_fails(path, **options):
        if path == files["exists"]:
            if foreign:
                (tmp_path / "new" / "other").write_text("")
            raise OSError("no room")
        return make(path, **options)

    monkeypatch.setattr(np.lib.format, "open_memmap", second_fails)
    with pytest.raises(OSError, match="no room"):
        make_files(files, {"inputs": (2, 3), "exists": (3,)})
    assert [item.name for item in tmp_path.rglob("*")] == (["new", "other"] if foreign else [])


def test_a_question_is_plain_json(tmp_path):
    State(tmp_path / "s", QUESTION).save(1, None)
    assert json.loads((tmp_path / "s").read_text())["question"]["counts"] == [3, 4]
