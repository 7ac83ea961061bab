r"""A report as a folder for LaTeX: the document, its figures as PDF, its tables as LaTeX and CSV; pdflatex sets it."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from assur.figures import catalogue as figures
from assur.figures.labels import formula_text, label
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.formulas.tex import broken_tex, tex
from assur.report.render import Page, error_text, filled, scalar_text, slug
from assur.report.sections.provenance import software
from assur.results import typeset_text
from assur.results.files import write_whole
from assur.results.kinds import (
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
from assur.results.latex_text import prose

DOCUMENT, FIGURES, TABLES = "report.tex", "figures", "tables"
HEAD = r"""\documentclass[10pt,a4paper]{article}
\usepackage{amsmath,amssymb,array,graphicx}
\setlength{\belowcaptionskip}{4pt}
\setlength{\textwidth}{176mm}\setlength{\oddsidemargin}{-8.4mm}\setlength{\evensidemargin}{-8.4mm}
\setlength{\textheight}{240mm}\setlength{\topmargin}{-14mm}
\setcounter{MaxMatrixCols}{40}
\renewcommand{\topfraction}{0.9}\renewcommand{\bottomfraction}{0.8}
\renewcommand{\textfraction}{0.06}\renewcommand{\floatpagefraction}{0.75}
\graphicspath{{figures/}}
\newsavebox{\drawnbox}
\newcommand{\fitted}[1]{\sbox{\drawnbox}{#1}\ifdim\wd\drawnbox>0.94\linewidth
  \resizebox{0.94\linewidth}{!}{\usebox{\drawnbox}}\else\usebox{\drawnbox}\fi}
\sloppy
"""
LEVELS = ("section", "subsection", "subsubsection", "paragraph")
LONGEST, LINES, TALL = 36, 56, 3
"""Rows and lines of a table in print, and the lines of a formula; other rows are in its CSV file."""

PARAGRAPHS = (34, 24, 16, 10)
"""A column whose cells have more letters is set as paragraphs; fewer where the others then fit the page."""

ROOM, LETTER, BETWEEN, NARROWEST = 160.0, 1.55, 4.3, 18.0
"""Of a table in mm: its width, that of a letter on average, the white between columns, and a paragraph at least."""

FORMULA, WORD = 24, 26
"""Letters that a formula in a cell is reckoned as wide as, and those of a word at most that a paragraph is wide for."""


@dataclass(frozen=True)
class Paper:
    """The files of a report for LaTeX by their paths in the folder; figures are drawn from what was found."""

    findings: Findings
    files: dict[str, str | bytes] = field(default_factory=dict)

    def document(self, page: Page) -> str:
        """The document; what it includes is among the files then."""
        record = self.findings.record
        lines = [
            rf"\title{{{prose(page.title or record.name)}}}",
            rf"\author{{{prose(page.eyebrow)}}}\date{{}}",
            r"\begin{document}",
            r"\maketitle",
            *_nomenclature(record),
            *(line for section in page.sections for line in self._section(section, 0)),
            *_bibliography(record),
            r"\end{document}",
        ]
        return HEAD + "\n".join(lines) + "\n"

    def _section(self, section: Section, level: int) -> Iterator[str]:
        yield f"\n\\{LEVELS[min(level, len(LEVELS) - 1)]}{{{prose(section.title)}}}"
        yield from (prose(part) + "\n" for part in section.text.split("\n\n") if part)
        scalars = [item for item in section.results if isinstance(item, Scalar)]
        if scalars:
            yield from self._table(_of_scalars(section.title, scalars))
        for result in section.results:
            if isinstance(result, Section):
                yield from self._section(result, level + 1)
            elif not isinstance(result, Scalar):
                yield from self._result(result)

    def _result(self, result: Result) -> Iterator[str]:
        match result:
            case Facts():
                yield rf"\paragraph{{{prose(result.title)}}}"
                yield r"\begin{description}"
                yield from (rf"\item[{prose(name)}] {prose(text)}" for name, text in result.items)
                yield r"\end{description}"
            case Formulas():
                yield rf"\paragraph{{{prose(result.title)}}} {prose(result.caption)}"
                yield from (line for formula in result.lines for line in _equation(formula))
            case Matrix():
                yield rf"\[\fitted{{$\displaystyle {_matrix(result)}$}}\]"
            case Table():
                yield from self._table(result)
            case Picture():
                yield from self._picture(result)

    def _table(self, whole: Table) -> Iterator[str]:
        table = filled(whole)
        name = f"{len(self.files):02d}-{slug(table.title)[:48] or 'table'}"
        path = f"{TABLES}/{name}"
        self.files[f"{path}.csv"] = table_csv(table)
        self.files[f"{path}.tex"] = table_tex(table)
        rest = len(table.rows) - _in_print(table)
        more = f" {rest} further rows are in the file {path}.csv." if rest > 0 else ""
        known = f" Known by: {table.known_by}." if table.known_by else ""
        yield r"\begin{table}[htbp]\centering\footnotesize"
        yield rf"\caption{{{prose(f'{table.title}. {table.caption}{known}{more}'.strip())}}}\label{{tab:{name}}}"
        yield rf"\fitted{{\input{{{path}}}}}"
        yield r"\end{table}"

    def _picture(self, picture: Picture) -> Iterator[str]:
        record, name = self.findings.record, picture.name
        for ending in ("pdf", "tex"):
            self.files[f"{FIGURES}/{name}.{ending}"] = figures.content(record, name, ending, self.findings)
        yield rf"\input{{{FIGURES}/{name}}}"


def write_paper(findings: Findings, page: Page, folder: str | Path) -> list[Path]:
    """Write a report as a folder for LaTeX and return the paths; `report.tex` comes last, when what it needs is there.

    Errors:
        OutputError: a file that cannot be written; what was there before stays whole.
    """
    paper = Paper(findings)
    document = paper.document(page)
    root = Path(folder)
    for part in (FIGURES, TABLES):
        (root / part).mkdir(parents=True, exist_ok=True)
    return [write_whole(root / path, text) for path, text in {**paper.files, DOCUMENT: document}.items()]


def table_csv(table: Table) -> str:
    r"""A table as CSV: titles, then rows; numbers with every digit, formulas as LaTeX.

    >>> table_csv(Table("t", ("a", "b"), ((0.1, None), ("x, y", 2.0))))
    'a,b\n0.1,\n"x, y",2.0\n'
    """
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(table.columns)
    writer.writerows(
        [tex(cell.mathml) if isinstance(cell, PrintedFormula) else cell for cell in row] for row in table.rows
    )
    return stream.getvalue()


def table_tex(table: Table) -> str:
    r"""A table as a tabular, its first rows where there are many.

    >>> print(table_tex(Table("t", ("a", "b"), (("50 %", 2.0),))))
    \begin{tabular}{ll}
    \hline
    a & b \\
    \hline
    50 \% & 2 \\
    \hline
    \end{tabular}
    <BLANKLINE>
    """
    rows = [[_cell(cell) for cell in row] for row in table.rows[: _in_print(table)]]
    kinds = "".join(
        "l" if own is None else rf">{{\raggedright\arraybackslash}}p{{{own:.0f}mm}}" for own in _paragraphs(table)
    )
    lines = [rf"\begin{{tabular}}{{{kinds}}}", r"\hline", _row(map(prose, table.columns)), r"\hline"]
    return "\n".join([*lines, *map(_row, rows), r"\hline", r"\end{tabular}"]) + "\n"


def _paragraphs(table: Table) -> list[float | None]:
    """Widths in mm of the columns that are set as paragraphs, None for others: so that the page holds all at full size.

    >>> _paragraphs(Table("t", ("a", "b"), (("short", "words " * 40),))), _paragraphs(Table("t", ("a",), (("short",),)))
    ([None, 143.65], [None])
    """
    columns = list(zip(table.columns, *table.rows[:LONGEST], strict=True))
    letters = [max(map(_letters, own)) for own in columns]
    for most in PARAGRAPHS:
        long = [count for count in letters if count > most]
        left = ROOM - BETWEEN * len(letters) - sum(LETTER * count for count in letters if count <= most)
        if left >= NARROWEST * len(long):
            break
    share = max(left, NARROWEST * len(long)) / sum(map(math.sqrt, long), start=1e-300)
    words = [max(len(word) for cell in own for word in [*str(cell).split(), ""]) for own in columns]
    return [
        max(min(LETTER * count, share * math.sqrt(count)), LETTER * min(word, WORD)) if count > most else None
        for count, word in zip(letters, words, strict=True)
    ]


def _in_print(table: Table) -> int:
    """How many of the first rows a page has room for.

    >>> _in_print(Table("t", ("a",), (("short",),) * 50)), _in_print(Table("t", ("a",), (("words " * 300,),) * 50))
    (36, 3)
    """
    widths, lines = _paragraphs(table), 0
    for count, row in enumerate(table.rows[:LONGEST]):
        lines += max(
            TALL if isinstance(cell, PrintedFormula) else math.ceil(LETTER * _letters(cell) / width) if width else 1
            for cell, width in zip(row, widths, strict=True)
        )
        if lines > LINES:
            return max(count, 1)
    return min(len(table.rows), LONGEST)


def _letters(cell: Cell) -> int:
    if isinstance(cell, PrintedFormula):
        return FORMULA
    return len(typeset_text.short(cell)) if isinstance(cell, float) else len(str(cell or "--"))


def _row(cells: Iterable[str]) -> str:
    """A row; one with matrices stands off from the next."""
    row = " & ".join(cells)
    return row + (r" \\[3pt]" if "matrix}" in row else r" \\")


def _cell(cell: Cell) -> str:
    if isinstance(cell, PrintedFormula):
        return f"${tex(cell.mathml)}$"
    if cell is None:
        return "--"
    return prose(typeset_text.short(cell) if isinstance(cell, float) else cell)


def _of_scalars(title: str, scalars: list[Scalar]) -> Table:
    rows = tuple(
        (
            item.name,
            f"{scalar_text(item)}{f' ± {error_text(item)}' if error_text(item) else ''} {item.unit}".strip(),
            item.known_by,
            item.note,
        )
        for item in scalars
    )
    return Table(f"{title}: numbers", ("quantity", "value", "known by", "note"), rows)


def _equation(formula: PrintedFormula) -> Iterator[str]:
    """A line of mathematics, which LaTeX numbers as the page does, and below it what it says."""
    yield r"\begin{equation}"
    yield rf"\fitted{{$\displaystyle {broken_tex(formula.mathml)}$}}"
    yield r"\end{equation}"
    if formula.words:
        yield rf"\noindent {prose(formula.words)}\par"


def _matrix(matrix: Matrix) -> str:
    rows = r" \\ ".join(
        " & ".join(prose(typeset_text.short(float(value) + 0.0)).replace("$", "") for value in row)
        for row in matrix.values
    )
    return rf"\text{{{prose(matrix.name)}}} = \begin{{bmatrix}}{rows}\end{{bmatrix}}"


def _nomenclature(record: MechanismRecord) -> Iterator[str]:
    """Every input, coordinate and dimension, with its value and unit."""
    yield r"\section*{Nomenclature}"
    yield r"\begin{description}\setlength{\itemsep}{0pt}\setlength{\parskip}{0pt}"
    for item in record.inputs:
        what = f"input, the {item.coordinate.kind} of joint {item.coordinate.joint}"
        yield rf"\item[${label(item.latex, item.name)}$] {prose(what)}"
    for name in record.platform.pose:
        yield rf"\item[${label('', name)}$] coordinate of the platform"
    for name, dimension in record.parameters.items():
        unit = "" if dimension.unit == "1" else f" {dimension.unit}"
        words = f": {dimension.meaning}" if dimension.meaning else ""
        yield rf"\item[{formula_text(name)}] {prose(f'{dimension.value:g}{unit}{words}')}"
    yield r"\end{description}"


def _bibliography(record: MechanismRecord) -> Iterator[str]:
    yield r"\begin{thebibliography}{9}"
    if record.source:
        yield rf"\bibitem{{mechanism}} {prose(record.source)}"
    yield rf"\bibitem{{assur}} {prose(software())}"
    yield r"\end{thebibliography}"
