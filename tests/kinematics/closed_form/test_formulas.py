"""What was begun with one closed form is not ended with another; what changes no formula changes nothing."""

import dataclasses
import shutil

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closed_form import formulas as module
from assur.kinematics.closed_form.formulas import formulas
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import stored_sweep

LINE = "across = sign * ns.sqrt(reach)"
OTHER = LINE.replace("reach", "reach * 1.0")  # as right, and another formula


def changed(folder, old, new):
    """The five-bar from a copy of its folder, with its closed form changed."""
    shutil.copytree(assur.load("fivebar").folder, folder, ignore=shutil.ignore_patterns("__pycache__"))
    path = folder / "closed_form.py"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    return assur.load(str(folder / "mechanism.toml"))


def test_a_formula_counts_and_a_comment_does_not(tmp_path):
    own = assur.load("fivebar")
    told = changed(tmp_path / "told", LINE, f"{LINE}  # to one side")
    other = changed(tmp_path / "other", LINE, OTHER)
    for problem in ("inverse", "direct"):
        assert formulas(told, problem) == formulas(own, problem)
        assert formulas(other, "inverse")["formulas"] != formulas(own, "inverse")["formulas"]


def test_a_size_that_zero_is_judged_against_counts(tmp_path):
    own = assur.load("fivebar")
    factor = dataclasses.replace(own.closed_form.factor_list[0], scale="2 * g")
    form = dataclasses.replace(own.closed_form, factor_list=(factor, *own.closed_form.factor_list[1:]))
    assert formulas(dataclasses.replace(own, closed_form=form), "inverse") != formulas(own, "inverse")


@pytest.mark.parametrize("problem", ["inverse", "direct"])
def test_a_stored_sweep_is_not_carried_on_with_other_formulas(tmp_path, problem):
    own, other = assur.load("fivebar"), changed(tmp_path / "other", LINE, OTHER)
    names = own.platform.pose if problem == "inverse" else tuple(item.name for item in own.inputs)
    grid = Grid(names, (0.1, 0.2), (0.9, 1.1), (3, 2))
    with stored_sweep(own, problem, grid).store(tmp_path / "kept") as store:
        store.open()
    kept = stored_sweep(other, problem, grid).store(tmp_path / "kept")
    with kept, pytest.raises(UsageError, match="another question; it differs in formulas"):
        kept.open()


def test_nor_with_another_version(tmp_path, monkeypatch):
    sweep = stored_sweep(assur.load("fivebar"), "inverse", Grid(("x", "y"), (0.1, 0.2), (0.9, 1.1), (3, 2)))
    with sweep.store(tmp_path) as store:
        store.open()
    monkeypatch.setattr(module, "version", lambda _: "0.0.1")
    with sweep.store(tmp_path) as kept, pytest.raises(UsageError, match="another question; it differs in version"):
        kept.open()
