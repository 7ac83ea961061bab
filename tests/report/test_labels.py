"""Labels that cannot be set: each is a fault with its line, and figures and report fall back to the name."""

import dataclasses
import shutil
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from matplotlib.mathtext import MathTextParser

from assur.figures.catalogue import draw
from assur.figures.labels import _PLAIN, is_settable, label
from assur.model.registry import load_record, names
from assur.report.formulas.latex import is_understood, symbol_mathml
from assur.report.labels import label_faults

BAD = [r"\theta_{1", "x_a_b", r"\nosuchword", "a$b", "x^", r"\frac{1}", "{" * 400 + "}" * 400, "a\nb"]


@pytest.fixture
def fourbar(tmp_path):
    """The path of a file of one's own, given what stands for its input's latex."""
    text = (Path(__file__).parents[1] / "model" / "fourbar.toml").read_text(encoding="utf-8")
    path = tmp_path / "fourbar.toml"

    def written(old: str, new: str) -> Path:
        assert old in text
        path.write_text(text.replace(old, new), encoding="utf-8")
        return path

    return written


@pytest.mark.parametrize("name", names())
def test_the_labels_of_the_catalogue_can_be_set(name):
    assert label_faults(load_record(name)) == ()


@pytest.mark.parametrize("latex", BAD)
def test_a_label_that_cannot_be_set_is_drawn_as_its_name(latex):
    assert not is_settable(latex) or not is_understood(latex)
    assert is_settable(label(latex, "yA1"))
    assert "merror" not in symbol_mathml(latex, "yA1")


@pytest.mark.parametrize("name", ["q_a_b", "q_", "_", "O'", "theta", "a" * 100, "leg1.q_x_y"])
def test_any_name_can_be_set(name):
    assert is_settable(label("", name))
    assert is_settable(label(name, name))


@pytest.mark.parametrize("latex", [r"\\theta_{1", "a$b", r"\\nosuchword"])
def test_a_bad_label_is_a_fault_with_its_line(assur_check, fourbar, latex):
    path = fourbar(r'latex = "\\theta"', f'latex = "{latex}"')
    (problem,) = assur_check(path)
    assert (problem.file, problem.line, problem.path) == (str(path), 28, "inputs.A.latex")
    assert latex.replace("\\\\", "\\") in problem.given


@pytest.fixture
def assur_check():
    return lambda path: label_faults(load_record(path))


def test_bad_labels_of_the_files_beside_it_are_faults_too(tmp_path):
    source = load_record("zeng2019").folder
    for name in ("mechanism.toml", "closed_form.py", "figures.toml"):
        shutil.copy(source / name, tmp_path / name)
    beside = {"figures.toml": 'latex = "', "closed_form.py": 'latex="'}
    lines = {}
    for name, start in beside.items():
        text = (tmp_path / name).read_text(encoding="utf-8")
        place = text.index(start) + len(start)
        lines[str(tmp_path / name)] = text.count("\n", 0, place) + 1
        (tmp_path / name).write_text(text[:place] + "{" + text[place:], encoding="utf-8")
    problems = label_faults(load_record(tmp_path / "mechanism.toml"))
    assert {problem.file: problem.line for problem in problems} == lines


def test_figures_of_an_input_with_a_bad_name_and_label_are_drawn():
    record = load_record("fivebar")
    inputs = tuple(dataclasses.replace(item, name="q_a_b", latex=r"\theta_{1") for item in record.inputs)
    form = record.closed_form
    factors = tuple(dataclasses.replace(item, latex="x_{") for item in form.factor_list)
    changed = dataclasses.replace(record, inputs=inputs, closed_form=dataclasses.replace(form, factor_list=factors))
    for name in ("model", "solutions"):
        assert draw(changed, name)


PIECES = (*"abXY019)|(-+=/, ^_", r"\alpha", r"\varphi", r"\sin", r"\mathbf{u}", r"\times", r"\det", r"\,", r"\ ")
PIECES += ("_1", "_{1y}", "_{B_2}", "_{1,2}", "^2", r"\cdot", r"\pm", r"\angle", r"\partial", r"\Pi", r"\cos")


@given(st.lists(st.sampled_from(PIECES), min_size=1, max_size=9).map("".join))
def test_what_is_taken_for_settable_by_its_letters_is_set(latex):
    assume(latex.strip() and _PLAIN.fullmatch(latex))
    MathTextParser("path").parse(f"${latex}$")


def test_an_index_of_an_index_or_a_power_of_a_power_is_not_taken_for_it():
    for latex in ("a_b_c", "a^2^2", r"\alphax", "a_{1", "^2", r"\sqrt{a}"):
        assert not _PLAIN.fullmatch(latex)
