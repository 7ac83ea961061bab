"""Rendering: sections of results as one HTML page; one macro for each kind, and nothing that knows an analysis."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from html import escape

import jinja2
from markupsafe import Markup

from assur.report.formulas.latex import latex_mathml
from assur.report.formulas.mathml import inline
from assur.report.formulas.tex import annotated
from assur.results import typeset_text
from assur.results.kinds import (
    FLOATING,
    RIGHTS,
    Cell,
    Facts,
    Formulas,
    Matrix,
    Picture,
    PrintedFormula,
    Result,
    Scalar,
    Section,
    Table,
)

MACROS: dict[type, str] = {
    Scalar: "scalars",
    Facts: "facts",
    Table: "table",
    Matrix: "matrix",
    Formulas: "formulas",
    Picture: "picture",
    Section: "section",
}
FILTERED = 12
"""A table with as many rows and different marks can be filtered by them."""

SEPARATOR = " · "
"""Between the id of an entry and the rest of its title."""

_ENTRY = re.compile(r"(?<=\bsee )[A-Z]\d+\b|(?<=\bevidence of )[A-Z]\d+\b|^[A-Z]\d+$")
_SIGNS = re.compile(r"[+-][+0-]*|[+0-]*[+-]")
_NUMBER = re.compile(r"[−-]?[\d\u202f]+(\.\d+)?(·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?( (±|to) .*)?|–")
_ARXIV = re.compile(r"arXiv:(\d{4}\.\d{4,5})")


@dataclass(frozen=True)
class Page:
    """A report: title, what it is about, and its sections."""

    title: str
    eyebrow: str
    lead: str
    sections: tuple[Section, ...]


def page_html(page: Page) -> str:
    """The whole page, self-contained; the same bytes for the same page.

    >>> "&lt;b&gt;" in page_html(Page("<b>", "", "", ()))
    True
    """
    links = Hyperlinks(dict(_entries(page.sections)))
    return (
        _environment()
        .get_template("page.html")
        .render(page=page, cell=links.cell, cited=links.cited, captioned=links.captioned)
    )


@lru_cache(maxsize=1)
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("assur.report", "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        slug=slug,
        scalar=scalar_text,
        error=error_text,
        first_words=first_words,
        short=typeset_text.short,
        base64=_base64,
        paragraphs=_paragraphs,
    )
    environment.globals.update(
        blocks=blocks,
        filled=filled,
        numeric=numeric_columns,
        filtered=filtered,
        separator=SEPARATOR,
        trusted=lambda formula: Markup(annotated(formula.mathml)),
    )
    return environment


def blocks(results: Iterable[Result | Section]) -> list[tuple[str, object]]:
    """(macro, item) for each result; scalars and matrices that stand together are one block."""
    grouped: list[tuple[str, object]] = []
    for result in results:
        name = MACROS[type(result)]
        if name in ("scalars", "matrix"):
            if grouped and grouped[-1][0] == name:
                grouped[-1][1].append(result)  # type: ignore[attr-defined]  # a list, made below
            else:
                grouped.append((name, [result]))
        else:
            grouped.append((name, result))
    return grouped


@dataclass(frozen=True)
class Hyperlinks:
    """Text with links: names of preprints to their place, ids of entries ("E1 · ...") to where they stand."""

    entries: Mapping[str, str]

    def cell(self, value: Cell) -> Markup:
        """A cell of a table."""
        if isinstance(value, PrintedFormula):
            return Markup(annotated(value.mathml))  # made by assur.report.formulas, which escapes
        if value is None:
            return Markup('<span class="none">–</span>')
        if isinstance(value, str) and _SIGNS.fullmatch(value):
            return Markup(f"<code>{value}</code>")  # signs only
        return self.cited(typeset_text.short(value) if isinstance(value, float) else value)

    def cited(self, text: str) -> Markup:
        """Escaped text with its links."""
        linked = _ARXIV.sub(r'<a href="https://arxiv.org/abs/\1">arXiv:\1</a>', escape(text))
        return Markup(_ENTRY.sub(self._entry, linked))  # escaped here

    def captioned(self, text: str) -> Markup:
        """A caption with its links, what stands between dollar signs as mathematics."""
        parts = re.split(r"\$([^$]+)\$", text)
        shown = [
            self.cited(part) if place % 2 == 0 else Markup(annotated(inline(latex_mathml(part), part)))
            for place, part in enumerate(parts)
        ]
        return Markup("").join(shown)

    def _entry(self, match: re.Match[str]) -> str:
        anchor = self.entries.get(match[0])
        return f'<a href="#{anchor}">{match[0]}</a>' if anchor else match[0]


def _entries(sections: Iterable[Section]) -> Iterator[tuple[str, str]]:
    """(id, anchor) of every entry whose title begins with an id and a dot."""
    for section in sections:
        for result in section.results:
            if isinstance(result, Facts) and SEPARATOR in result.title:
                yield result.title.partition(SEPARATOR)[0], slug(result.title)
        yield from _entries(result for result in section.results if isinstance(result, Section))


def slug(text: str) -> str:
    """An anchor: letters and digits, lower case.

    >>> slug("E1 · Eq. (9)")
    'e1-eq-9'
    """
    return "-".join(re.findall(r"[^\W_]+", text.lower()))


def scalar_text(scalar: Scalar) -> str:
    """Value of a scalar, to the second digit of its error; where it has only bounds, these."""
    if scalar.value is None:
        return (
            typeset_text.NOTHING
            if scalar.low is None or scalar.high is None
            else typeset_text.bounds(scalar.low, scalar.high)
        )
    return _parts(scalar)[0]


def first_words(right: str) -> str:
    """What stands before the details of a right.

    >>> first_words("proved by interval arithmetic: these and no other"), first_words("exact: counted")
    ('proved', 'exact')
    >>> first_words("proved by interval arithmetic one by one; that there is no other, in floating point")
    'proved in part'
    """
    if right.startswith("proved") and FLOATING in right:
        return "proved in part"
    return next((word for word in RIGHTS if right.startswith(word)), right.partition(":")[0])


def error_text(scalar: Scalar) -> str:
    """Error of a scalar, empty where there is none."""
    return "" if scalar.value is None else _parts(scalar)[2]


def _parts(scalar: Scalar) -> tuple[str, str, str]:
    return typeset_text.with_error(scalar.value or 0.0, scalar.error or 0.0).partition(" ± ")


def filled(table: Table) -> Table:
    """The table without columns in which nothing stands.

    >>> filled(Table("t", ("a", "b"), (("1", ""), ("2", "")))).columns
    ('a',)
    """
    kept = [k for k in range(len(table.columns)) if any(row[k] != "" for row in table.rows)]
    if not table.rows or len(kept) == len(table.columns):
        return table
    rows = tuple(tuple(row[k] for k in kept) for row in table.rows)
    return replace(table, columns=tuple(table.columns[k] for k in kept), rows=rows)


def numeric_columns(table: Table) -> list[bool]:
    """Which columns hold numbers only, and stand right-aligned."""
    columns = zip(*table.rows, strict=True)
    return [all(_is_number(value) for value in column) and any(column) for column in columns]


def _is_number(value: Cell) -> bool:
    return value is None or isinstance(value, float) or (isinstance(value, str) and bool(_NUMBER.fullmatch(value)))


def filtered(table: Table) -> list[str]:
    """The marks by which a long table can be filtered."""
    marks = list(dict.fromkeys(mark for mark in table.marks if mark))
    return marks if len(table.rows) >= FILTERED and len(marks) > 1 else []


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


def _paragraphs(text: str) -> Sequence[str]:
    return [part for part in text.split("\n\n") if part]
