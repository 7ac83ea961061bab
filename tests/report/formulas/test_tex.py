import re
from xml.etree import ElementTree

import pytest

from assur.report.formulas.latex import latex_mathml
from assur.report.formulas.mathml import display
from assur.report.formulas.tex import WIDEST, annotated, broken_tex, tex
from assur.results.kinds import Formulas, PrintedFormula, Section, Table

ROUND = (
    r"\frac{l_{2}^{2}-B^{2}}{4}",
    r"\sqrt{x+1}",
    r"\begin{bmatrix}1 & 0 \\ \sin \alpha & -\cos \beta\end{bmatrix}",
    r"\bigcap_{i=1}^{j}M_{b_{i}}",
    r"\dot{q}+\mathbf{u}_{1}\cdot \mathbf{t}",
    r"\text{50 \% of }x\ge 0",
    r"t^{2}(\perp R_{12})\cup r^{1}(\parallel R)",
)


def formulas(sections):
    for section in sections:
        for result in section.results:
            if isinstance(result, Section):
                yield from formulas([result])
            elif isinstance(result, Formulas):
                yield from (line.mathml for line in result.lines)
            elif isinstance(result, Table):
                yield from (cell.mathml for row in result.rows for cell in row if isinstance(cell, PrintedFormula))


@pytest.mark.parametrize("latex", ROUND)
def test_what_is_read_and_written_again_is_the_same_formula(latex):
    """By the other way: the report's own reader of LaTeX makes the same markup of what is written."""
    mathml = display(latex_mathml(latex))
    assert display(latex_mathml(tex(mathml))) == mathml


def test_every_formula_of_a_report_is_ascii_with_braces_in_pairs(page):
    every = list(dict.fromkeys(formulas(page.sections)))
    assert len(every) > 100
    for mathml in every:
        for latex in (tex(mathml), broken_tex(mathml)):
            bare = re.sub(r"\\[{}]", "", latex)
            assert latex.isascii(), latex
            assert bare.count("{") == bare.count("}"), latex
            assert "<" not in re.sub(r"\\text\{[^}]*\}", "", latex).replace(" < ", ""), latex


def test_a_formula_carries_its_latex_and_stays_as_it_was_beside_it():
    mathml = display(latex_mathml(r"a<\frac{1}{2}"), "a less than a half")
    root = ElementTree.fromstring(annotated(mathml))
    [semantics] = root
    shown, note = semantics
    assert ElementTree.tostring(shown) == ElementTree.tostring(ElementTree.fromstring(mathml)[0])
    assert (note.tag, note.get("encoding")) == ("annotation", "application/x-tex")
    assert note.text == tex(mathml)
    assert root.get("alttext") == "a less than a half"


def test_a_long_sum_is_broken_before_its_signs_and_never_inside_brackets():
    terms = [f"a_{{{k}}}(b+c)" for k in range(40)]
    latex = broken_tex(display(latex_mathml("s=" + "+".join(terms))))
    lines = latex.removeprefix(r"\begin{aligned}").removesuffix(r"\end{aligned}").split(r" \\ &\quad ")
    assert len(lines) > 2
    for line in lines[1:]:
        assert line.startswith("+")
    for line in lines:
        assert line.count("(") == line.count(")")
        assert len(re.sub(r"[_{}&]", "", line)) <= 1.5 * WIDEST
