import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

import assur
from assur.report.formulas.latex import THIN, bracket, latex_mathml, name_mathml
from assur.report.formulas.symbols import FUNCTIONS, GREEK, LIMITS, OPERATORS, TABLES

ROOT = Path(__file__).parents[3]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
"""README and the other pages at the top, and those of the site; what reports write is tested with the reports."""

MATRIX = (
    '<mrow class="matrix"><mtable><mtr><mtd><mi>a</mi></mtd><mtd><mi>b</mi></mtd></mtr>'
    "<mtr><mtd><mi>c</mi></mtd></mtr></mtable></mrow>"
)

MINUS = '<mo lspace="0" rspace="0">−</mo>'
PAIR = '<mfrac linethickness="0"><mi>n</mi><mi>k</mi></mfrac>'


def bracketed(inner):
    return f"{bracket('(')}{inner}{bracket(')')}"


def accented(base, sign):
    return f'<mover accent="true">{base}<mo stretchy="false">{sign}</mo></mover>'


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
        ("-x", f"{MINUS}<mi>x</mi>"),
        ("y=-x", f"<mi>y</mi><mo>=</mo>{MINUS}<mi>x</mi>"),
        ("y<-x", f"<mi>y</mi><mo>&lt;</mo>{MINUS}<mi>x</mi>"),
        ("y-x", "<mi>y</mi><mo>−</mo><mi>x</mi>"),
        ("a/b", '<mi>a</mi><mo lspace="0" rspace="0">/</mo><mi>b</mi>'),
        ("^{7}", "<msup><mrow></mrow><mn>7</mn></msup>"),
        ("O'", "<mi>O</mi><mo>′</mo>"),
        (r"\frac12", "<mfrac><mn>1</mn><mn>2</mn></mfrac>"),
        (r"\tfrac1{2a}", "<mfrac><mn>1</mn><mrow><mn>2</mn><mi>a</mi></mrow></mfrac>"),
        (r"\frac\alpha3", "<mfrac><mi>α</mi><mn>3</mn></mfrac>"),
        ("x^12", "<msup><mi>x</mi><mn>1</mn></msup><mn>2</mn>"),
        (r"\dot\phi", accented("<mi>φ</mi>", "˙")),
        (r"\hat{u}_1", f"<msub>{accented('<mi>u</mi>', '^')}<mn>1</mn></msub>"),
        (r"\vec a\ddot b", accented("<mi>a</mi>", "→") + accented("<mi>b</mi>", "¨")),
        (r"\phantom{-}", f"<mphantom><mrow>{MINUS}</mrow></mphantom>"),
        (r"\binom nk", f"<mrow><mo>(</mo>{PAIR}<mo>)</mo></mrow>"),
        (r"\tag{7}", '<mspace width="2em"/><mtext>(7)</mtext>'),
        (r"\max_i", "<munder><mi>max</mi><mi>i</mi></munder>"),
        (r"\operatorname{ab}\$", "<mtext>ab</mtext><mi>$</mi>"),
        (r"\Bigl[x\Bigr.", f"{bracket('[')}<mi>x</mi>"),
        (r"\left(x\right)", bracketed("<mi>x</mi>")),
        (r"\text{so, a\_b}", "<mtext>so, a_b</mtext>"),
        (r"\mathrm{ab}_1", "<msub><mtext>ab</mtext><mn>1</mn></msub>"),
        (r"a\parallel\Diamond", "<mi>a</mi><mo>∥</mo><mo>◇</mo>"),
        (r"\begin{bmatrix} a & b \\ c \end{bmatrix}^2", f"<msup>{MATRIX}<mn>2</mn></msup>"),
        (r"\begin{bmatrix} a & b \\ c \\ \end{bmatrix}", MATRIX),
        ("a<b&c", "<mi>a</mi><mo>&lt;</mo><mi>b</mi><mo>&amp;</mo><mi>c</mi>"),
    ],
)
def test_latex(source, expected):
    assert latex_mathml(source) == expected


@pytest.mark.parametrize(
    "source", [r"\unknown", "x_", r"\frac1", "{x", "x}", r"\begin{bmatrix} a", r"\begin{x}a\end{x}"]
)
def test_what_is_not_understood_is_shown_as_it_stands_and_marked(source):
    assert latex_mathml(source) == f"<merror><mtext>{source}</mtext></merror>"


@pytest.mark.parametrize("words", [GREEK, FUNCTIONS, OPERATORS, LIMITS])
def test_every_word_of_the_tables_is_one_sign(words):
    for word in words:
        written = latex_mathml(f"\\{word}")
        assert "merror" not in written
        assert len(ElementTree.fromstring(f"<math>{written}</math>")) == 1


@pytest.mark.parametrize("name", TABLES)
def test_a_table_has_rows_and_cells_wherever_it_stands(name):
    table = rf"\begin{{{name}}} a &= -b \\ \dot c &= \binom{{n}}{{k}} \end{{{name}}}"
    for source in (table, rf"\frac{{{table}}}{{2}}", rf"x = {table}^2"):
        found = ElementTree.fromstring(f"<math>{latex_mathml(source)}</math>")
        rows = found.findall(".//mtable/mtr")
        assert [["".join(cell.itertext()) for cell in row] for row in rows] == [["a", "=−b"], ["c˙", "=(nk)"]]


@pytest.mark.parametrize(
    ("source", "apart"),
    [(r"2\sin x", 1), (r"x_1\cos^2 x", 1), (r"(a)\min b", 1), (r"\sin x", 0), (r"=\sin x", 0), (r"2x", 0)],
)
def test_a_function_stands_apart_from_what_it_is_multiplied_with(source, apart):
    assert latex_mathml(source).count(THIN) == apart


@pytest.mark.parametrize("sign", ["\\pm ", "\\parallel ", "\\perp ", "-", "+"])
@pytest.mark.parametrize(("source", "close"), [("%sR", 1), ("(%sR)", 1), (r"x\le%sR", 1), ("{a}%sR", 0), ("(a%sR)", 0)])
def test_a_sign_with_nothing_to_join_stands_close(sign, source, close):
    found = ElementTree.fromstring(f"<math>{latex_mathml(source % sign)}</math>").iter("mo")
    assert sum(item.get("stretchy") is None and item.get("lspace") == "0" for item in found) == close


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
        assert "<merror>" not in mathml


def formulas(page):
    """LaTeX between dollar signs in a page of Markdown, code left out."""
    text = re.sub(r"^```.*?^```|`[^`\n]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    displayed = re.findall(r"\$\$(.+?)\$\$", text, re.DOTALL)
    return displayed + re.findall(r"(?<!\\)\$([^$\n]+?)(?<!\\)\$", re.sub(r"\$\$.+?\$\$", "", text, flags=re.DOTALL))


def test_all_that_pages_write_is_understood():
    written = {(page.name, latex) for page in PAGES for latex in formulas(page)}
    assert len(written) > 100
    assert len({name for name, _ in written}) >= 4
    for name, latex in written:
        mathml = latex_mathml(latex)
        ElementTree.fromstring(f"<math>{mathml}</math>")
        assert "<merror>" not in mathml, (name, latex)
