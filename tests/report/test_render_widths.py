"""The page in a browser as narrow as a telephone and as wide as a desk: no formula is cut, each is copied as LaTeX."""

from functools import lru_cache

import pytest

import assur
from assur.report.findings import Findings
from assur.report.numbering import Numbering
from assur.report.render import Page, page_html
from assur.report.sections.position import position
from assur.report.sections.topology import topology
from assur.report.sections.velocity import velocity
from own_machines import own_machine

pytestmark = pytest.mark.browser

WIDTHS = (390, 820, 1440)
CUT = """() => [...document.querySelectorAll("math")].filter(formula => {
  const right = Math.max(...[...formula.querySelectorAll("*")].map(part => part.getBoundingClientRect().right));
  for (let box = formula.parentElement; box; box = box.parentElement) {
    const room = box.getBoundingClientRect();
    if (getComputedStyle(box).overflowX !== "visible" && right > room.right + 0.5) return true;
  }
  return right > innerWidth + 0.5;
}).map(formula => formula.querySelector("annotation")?.textContent ?? formula.textContent)"""
SMALLEST = 9
"""Pixels below which nobody reads a letter."""


@lru_cache
def with_formulas(name):
    """What has formulas in the report of the paper's mechanism, or of one of one's own."""
    findings = Findings(assur.load(name) if name == "zeng2019" else own_machine(name), illustrated=False)
    sections = [make(findings) for make in (topology, position, velocity)]
    return page_html(Page(name, "", "", Numbering().numbered(sections)))


@pytest.fixture(params=["zeng2019", "hybrid"])
def shown(browser, request):
    page = browser.new_page(viewport={"width": WIDTHS[-1], "height": 900})
    page.set_content(with_formulas(request.param))
    yield page
    page.close()


def test_no_formula_is_cut_and_all_can_be_read(shown):
    assert shown.locator("math .wraps").count() > 10
    for width in WIDTHS:
        shown.set_viewport_size({"width": width, "height": 900})
        shown.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        assert shown.evaluate(CUT) == []
        assert shown.evaluate("document.documentElement.scrollWidth") == width
        sizes = shown.evaluate("[...document.querySelectorAll('.math math')].map(f => getComputedStyle(f).fontSize)")
        assert min(float(size.removesuffix("px")) for size in sizes) >= SMALLEST


def test_a_formula_that_may_not_shrink_or_break_is_noticed(shown):
    shown.add_style_tag(content=".wraps { flex-wrap: nowrap } .math math { font-size: 30px !important }")
    assert shown.evaluate(CUT)


def test_every_equation_has_a_number_and_gives_its_latex_at_a_click(shown):
    numbers = shown.locator(".formulas .equation a").all_text_contents()
    assert numbers == [f"({k})" for k in range(1, len(numbers) + 1)]
    assert len(numbers) == shown.locator(".formulas .line").count() > 20
    shown.evaluate("navigator.clipboard ? navigator.clipboard.writeText = async t => { window.taken = t } : 0")
    shown.evaluate("document.execCommand = () => { window.taken = document.activeElement.value }")
    line = shown.locator(".formulas .line").nth(7)
    line.locator("button").click()
    assert shown.evaluate("window.taken") == line.locator("annotation").text_content()
