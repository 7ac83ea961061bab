"""One set of findings for all tests of the report: the analyses are made once."""

import re
import shutil
from html.parser import HTMLParser
from pathlib import Path

import pytest

import assur
from assur.report.findings import Findings
from assur.report.render import page_html
from assur.report.report import report_html, report_page
from assur.results.kinds import RIGHTS, Scalar, Section, Table

RESOLUTION = 20
VOID = {"meta", "input", "img", "br", "mspace", "path"}


@pytest.fixture(scope="session")
def findings():
    """Of the paper's mechanism, without figures."""
    return Findings(assur.load("zeng2019"), resolution=RESOLUTION, illustrated=False)


@pytest.fixture(scope="session")
def page(findings):
    return report_page(findings)


@pytest.fixture(scope="session")
def html(page):
    return page_html(page)


@pytest.fixture(scope="session")
def fourbar():
    """A mechanism without closed form and without reference data."""
    return assur.load(Path(__file__).parents[1] / "model" / "fourbar.toml")


@pytest.fixture(scope="session")
def bare(fourbar):
    """The page of a mechanism without closed form."""
    return report_html(fourbar, figures=False)


@pytest.fixture(scope="session")
def delta():
    """A mechanism in space without closed form and without reference data."""
    return assur.load(Path(__file__).parents[1] / "model" / "file" / "delta.toml")


@pytest.fixture(scope="session")
def fivebar_graph(tmp_path_factory):
    """The file of the five-bar alone, without its closed form and its reference data."""
    folder = tmp_path_factory.mktemp("graph")
    own = Path(assur.__file__).parent / "mechanisms" / "fivebar" / "mechanism.toml"
    return assur.load(shutil.copy(own, folder / "fivebar.toml"))


class Document(HTMLParser):
    """Tags that are closed in order, with their attributes, and the text of table cells by row."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.faults: list[str] = []
        self.tables: dict[str, list[tuple[str, list[str]]]] = {}
        self.words: dict[str, str] = {}
        self._table: str | None = None
        self.feed(text)
        self.close()
        self.faults += [f"never closed: {tag}" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag == "table":
            self._table = ""
        elif tag == "tr" and self._table:
            self.tables[self._table].append((dict(attributes).get("class") or "", []))
        elif tag in ("td", "th") and self._table:
            self.tables[self._table][-1][1].append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")
        else:
            self.open.pop()
        if tag == "caption":
            self.tables[self._table] = []
        if tag == "table":
            self._table = None

    def handle_data(self, data):
        for tag in set(self.open):
            self.words[tag] = self.words.get(tag, "") + data
        if "caption" in self.open:
            self._table = (self._table or "") + data
        elif self._table and ("td" in self.open or "th" in self.open):
            self.tables[self._table][-1][1][-1] += data


@pytest.fixture(scope="session")
def read():
    """A page as a `Document`."""
    return Document


@pytest.fixture(scope="session")
def document(html):
    return Document(html)


@pytest.fixture(scope="session")
def results_of():
    """A function: every result of a kind on a page, those of sections inside sections too."""
    return _results


@pytest.fixture(scope="session")
def without_right():
    """A function: names of the numbers of which a page does not say by what right they are known."""
    return _without_right


def _results(page, kind):
    waiting = list(page.sections)
    while waiting:
        for item in waiting.pop(0).results:
            if isinstance(item, Section):
                waiting.append(item)
            elif isinstance(item, kind):
                yield item


def _without_right(page):
    found = [item.name for item in _results(page, Scalar) if not item.known_by.startswith(RIGHTS)]
    return found + [
        table.title
        for table in _results(page, Table)
        if any(re.match(r"(area|length|volume|inside)\b", column) for column in table.columns)
        and not table.known_by.startswith(RIGHTS)
    ]
