"""Tables of formulas as a browser lays them out, by the style sheets of the report and of the site."""

from pathlib import Path

import pytest

from assur.report.formulas.latex import latex_mathml

ROOT = Path(__file__).parents[3]
SHEETS = [ROOT / "src/assur/report/templates/style.css", ROOT / "docs/_static/site.css"]
PLACES = """rows => [...document.querySelectorAll("mtr")].map(row => [...row.children].map(cell => {
  const parts = [...cell.children].map(part => part.getBoundingClientRect());
  return [Math.min(...parts.map(part => part.left)), Math.max(...parts.map(part => part.right))];
}))"""


@pytest.mark.browser
@pytest.mark.parametrize("sheet", SHEETS, ids=[path.name for path in SHEETS])
@pytest.mark.parametrize(
    ("latex", "edges"),
    [
        (r"\begin{aligned} a &= b + c \\ a + b + c &= d \end{aligned}", (1, 0)),
        (r"\begin{cases} a & b + c \\ a + b + c & d \end{cases}", (0, 0)),
    ],
)
def test_columns_stand_in_line(browser, sheet, latex, edges):
    """Of the first and second column the left edges (0) or the right ones (1) are the same in every row."""
    page = browser.new_page()
    style = sheet.read_text(encoding="utf-8")
    page.set_content(f'<style>{style}</style><math display="block"><mrow>{latex_mathml(latex)}</mrow></math>')
    first, second = page.evaluate(PLACES)
    page.close()
    for column, edge in enumerate(edges):
        assert first[column][edge] == pytest.approx(second[column][edge], abs=0.5)
        assert abs(first[column][1 - edge] - second[column][1 - edge]) > 5
