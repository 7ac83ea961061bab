from __future__ import annotations

from xml.etree import ElementTree

import pytest

import assur
from assur.report.formulas.latex import latex_mathml, name_mathml

MATRIX = (
    '<mrow class="matrix"><mtable><mtr><mtd><mi>a</mi></mtd><mtd><mi>b</mi></mtd></mtr>'
    "<mtr><mtd><mi>c</mi></mtd></mtr></mtable></mrow>"
)


def bracketed(inner):
    return "".join(
        f'<mo stretchy="false" lspace="0" rspace="0">{sign}</mo>{inner if sign == "(" else ""}' for sign in "()"
    )


def said(mathml):
    return "".join(ElementTree.fromstring(f"<math>{mathml}</math>").itertext())


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (r"\alpha", "<mi>α</mi>"),
        ("l_2^2", "<msubsup><mi>l</mi><mn>2</mn><mn>2</mn></msubsup>"),
        (r"\sqrt{x}", "<msqrt><mi>x</mi></msqrt>"),
        (r"\frac{1}{2}", "<mfrac><mn>1</mn><mn>2</mn></mfrac>"),
        (r"\sum_j", "<munder><mo>∑</mo><mi>j</mi></munder>"),
        ("-x", "<mo>−</mo><mi>x</mi>"),
        ("^{7}", "<msup><mrow></mrow><mn>7</mn></msup>"),
        ("O'", "<mi>O</mi><mo>′</mo>"),
        (r"\unknown", "<mtext>\\unknown</mtext>"),
        ("x_", "<mtext>x_</mtext>"),
        (r"\left(x\right)", bracketed("<mi>x</mi>")),
        (r"\text{so, a\_b}", "<mtext>so, a_b</mtext>"),
        (r"\mathrm{ab}_1", "<msub><mtext>ab</mtext><mn>1</mn></msub>"),
        (r"\parallel\Diamond", "<mo>∥</mo><mo>◇</mo>"),
        (r"\begin{bmatrix} a & b \\ c \end{bmatrix}^2", f"<msup>{MATRIX}<mn>2</mn></msup>"),
        (r"\begin{bmatrix} a", r"<mtext>\begin{bmatrix} a</mtext>"),
        ("a<b&c", "<mi>a</mi><mo>&lt;</mo><mi>b</mi><mo>&amp;</mo><mi>c</mi>"),
    ],
)
def test_latex(source, expected):
    assert latex_mathml(source) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [("l1", "l1"), ("alpha", "α"), ("s_alpha", "sα"), ("theta12", "θ12"), ("sin_b1", "sin\u2061b1"), ("a<b", "a<b")],
)
def test_names(name, expected):
    assert said(name_mathml(name)) == expected


def test_a_difference_of_angles_in_a_name():
    assert said(name_mathml("sin_beta_minus_alpha")) == "sin\u2061(β−α)"


@pytest.mark.parametrize("name", assur.names())
def test_all_that_mechanisms_write_is_understood(name):
    record = assur.load(name)
    form = record.closed_form
    sources = [item.latex for item in (*record.inputs, *form.factor_list, *form.quantity_list)]
    sources += [item.latex for item in (*form.direct_margins, *form.inverse_margins)]
    written = [latex_mathml(source) for source in sources if source]
    assert written
    for mathml in written:
        ElementTree.fromstring(f"<math>{mathml}</math>")
        assert "<mtext>" not in mathml
