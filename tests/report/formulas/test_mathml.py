from xml.etree import ElementTree

import numpy as np

from assur.report.formulas.mathml import display, equation, inline, matrix_mathml, term_mathml
from assur.report.formulas.trace import POINTS, Book, Letter, Tracing, leaf

BOOK = Book()
X = leaf(BOOK, Letter("x", "<mi>x</mi>"), np.arange(1.0, POINTS + 1))
COS = leaf(BOOK, Letter("a", "<mi>α</mi>", "cos"), np.linspace(0.1, 0.9, POINTS))


def said(mathml):
    return (
        "".join(ElementTree.fromstring(f"<math>{mathml}</math>").itertext()).replace("\u2061", "").replace("\u2062", "")
    )


def test_a_sum_over_a_number_needs_no_brackets():
    assert said(term_mathml((X + 1) / 2)) == "x+12"
    assert "<mfrac>" in term_mathml((X + 1) / 2)


def test_a_sum_in_a_product_has_brackets():
    assert said(term_mathml(3 * (X + 1))) == "3(x+1)"


def test_the_power_of_a_function_stands_at_its_name():
    assert "<msup><mi>cos</mi><mn>2</mn></msup>" in term_mathml(COS * COS)


def test_roots_and_zero():
    assert term_mathml(Tracing(BOOK).sqrt(X)).startswith("<msqrt>")
    assert term_mathml(X - X) == "<mn>0</mn>"


def test_a_minus_stands_close_to_what_it_negates():
    """After an equals sign a browser would take it for a difference's."""
    assert equation("<mi>y</mi>", term_mathml(-X)).count('<mo lspace="0" rspace="0">−</mo>') == 1
    assert term_mathml(COS - X).count("<mo>−</mo>") == 1


def test_a_matrix_has_its_rows():
    rows = ElementTree.fromstring(matrix_mathml([[X, X], [X, COS], [X, X]]))
    assert [len(row) for row in rows.iter("mtr")] == [2, 2, 2]


def test_the_spoken_text_is_escaped():
    words = 'a "<b>"'
    for made in (
        display("<mi>x</mi>", words),
        inline("<mi>x</mi>", words),
        equation("<mi>x</mi>", "<mn>1</mn>", words),
    ):
        assert ElementTree.fromstring(made).get("alttext") == words
