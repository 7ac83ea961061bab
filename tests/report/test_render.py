"""One macro for each kind: what each of them shows, whatever made it."""

import re
from typing import get_args

import numpy as np
import pytest

from assur.report.render import MACROS, Hyperlinks, Page, page_html
from assur.results import kinds
from assur.results.kinds import (
    Facts,
    Formulas,
    Matrix,
    Picture,
    PrintedFormula,
    Scalar,
    Section,
    Table,
)

LINE = PrintedFormula("<math><mi>q</mi></math>", "(7)", "said")
SAMPLES = {
    Scalar: (
        Scalar("volume", 12345.678, "mm³", "somehow", 12.0),
        ["volume", "12\u202f346", "± 12", "mm³", "somehow"],
    ),
    Facts: (Facts("Said", (("who", "me"),)), ["Said", "who", "me"]),
    Table: (
        Table("T", ("a", "b"), ((1.5, None), ("x", LINE)), "note"),
        ["1.5", "–", "<mi>q</mi>", "note"],
    ),
    Matrix: (
        Matrix("M", np.array([[1.0, -2.5]]), ("r",), ("c", "d")),
        ["M", "−2.5", "r", "d"],
    ),
    Formulas: (
        Formulas("L", (LINE, PrintedFormula("<math></math>", "8"))),
        ["<mi>q</mi>", "(7)", "(8)", "said"],
    ),
    Picture: (
        Picture("p", "3A", "Thing", "It is $x_1$.", b"PNG", 20, 10),
        ["Figure 3A. Thing.", "UE5H", 'alt="Thing"', "<msub>"],
    ),
    Section: (
        Section("Inner", "One.\n\nTwo."),
        ["<h3>Inner", "<p>One.</p>", "<p>Two.</p>"],
    ),
}


def shown(*results, text=""):
    return page_html(Page("T", "", "", (Section("Outer", text, results),)))


def test_every_kind_has_a_macro_and_a_sample():
    assert {*get_args(kinds.Result), Section} == set(MACROS) == set(SAMPLES)


@pytest.mark.parametrize("kind", SAMPLES, ids=lambda kind: kind.__name__)
def test_a_kind_is_shown(kind, read):
    item, expected = SAMPLES[kind]
    page = shown(item)
    assert read(page).faults == []
    for text in expected:
        assert text in page, text


def test_nothing_a_result_says_is_markup():
    nasty = "<b>&\"'"
    page = shown(
        Scalar(nasty, 1.0, nasty, nasty),
        Facts(nasty, ((nasty, nasty),)),
        Table(nasty, (nasty,), ((nasty,),), nasty, ("ok",)),
        Matrix(nasty, np.eye(1), (nasty,), (nasty,)),
        Formulas(nasty, (PrintedFormula("", nasty, nasty),), nasty),
        Picture(nasty, nasty, nasty, f"{nasty} ${nasty}$", b"", 1, 1),
        Section(nasty, nasty),
        text=nasty,
    )
    assert "<b>&" not in page.replace("<b>&lt;", "").replace("<b>Figure &lt;", "")
    assert page.count("<b>&lt;") == 1  # the bold title of the formulas


def test_numbers_stand_right_and_words_left():
    page = shown(Table("T", ("n", "w", "m"), (("−1.5", "a", "++-"), ("2·10⁻⁷", "7", "+"))))
    assert '<th scope="col" class="number">n</th><th scope="col">w</th><th scope="col">m</th>' in page
    assert "<code>++-</code>" in page


def test_a_long_table_of_different_marks_can_be_filtered(read):
    rows = tuple((str(k), "ok" if k else "wrong") for k in range(12))
    marks = tuple(row[1] for row in rows)
    page = shown(Table("Long", ("a", "b"), rows, marks=marks, folded=True))
    inputs = [attributes for tag, attributes in read(page).tags if tag == "input"]
    assert [attributes["class"] for attributes in inputs] == ["all", "wrong", "ok"]
    assert len({attributes["name"] for attributes in inputs}) == 1
    assert '<details class="fold"><summary>Long' in page
    assert "<input" not in shown(Table("Short", ("a", "b"), rows[:5], marks=marks[:5]))
    assert "<input" not in shown(Table("Same", ("a", "b"), rows, marks=("ok",) * 12))


def test_a_verdict_is_coloured_where_it_stands_in_words():
    page = shown(Table("T", ("a", "b"), (("wrong way", "wrong in x, see E3"),), marks=("wrong",)))
    assert '<td>wrong way</td><td><span class="verdict">wrong in x, see E3</span></td>' in page.replace("\n", "")


def test_an_id_is_a_link_where_one_is_told_to_see_it():
    page = shown(
        Facts("E3 · Table 1", (("printed", "x"),)), Table("T", ("a",), (("ok, see E3",), ("E3 to F3",), ("see E9",)))
    )
    assert 'see <a href="#e3-table-1">E3</a>' in page
    assert "<td>E3 to F3</td>" in page
    assert "see E9" in page


def test_a_preprint_is_a_link():
    assert '<a href="https://arxiv.org/abs/1907.08432">arXiv:1907.08432</a>' in shown(text="as arXiv:1907.08432 says")


def test_scalars_that_stand_together_are_one_block():
    page = shown(Scalar("a", 1.0), Scalar("b", None), Facts("f", ()), Scalar("c", 2.0))
    assert page.count('<dl class="scalars">') == 2
    assert '<span class="value">–</span>' in page


def test_a_formula_in_a_caption_carries_its_latex():
    said = str(Hyperlinks({}).captioned(r"signs of $\alpha_{1} < u$ & more"))
    assert said.count("<math") == said.count('<annotation encoding="application/x-tex">') == 1
    (latex,) = re.findall(r'application/x-tex">(.*?)</annotation>', said)
    assert latex.replace(" ", "") == r"\alpha_{1}&lt;u"
