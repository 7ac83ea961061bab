"""No number in a table is ever cut, however narrow the place."""

import io
import re
from itertools import pairwise

import pytest
from rich.console import Console

from assur.cli.ascii_text import ascii_rule
from assur.cli.output import show, table

COLUMNS = ["mode", *(f"q{k} [mm]" for k in range(9)), "status", "meaning", "gap [mm]"]
ROWS = [
    [
        f"+{k}",
        *(f"{-1234.567891 - 100 * k - j:.6f}" for j in range(9)),
        "near_singular",
        "points too far apart",
        "1.2e-15",
    ]
    for k in range(3)
]
WORDS = {word for row in (COLUMNS, *ROWS) for cell in row for word in cell.split()}


def printed(item, width, *, terminal):
    stream = io.StringIO()
    out = Console(file=stream, width=width, force_terminal=terminal, color_system=None, markup=False, highlight=False)
    out.print(item, crop=False)
    return stream.getvalue()


@pytest.mark.parametrize("width", [40, 80, 200])
@pytest.mark.parametrize("terminal", [True, False])
@pytest.mark.parametrize("plain", [True, False])
def test_every_word_is_whole(width, terminal, plain):
    item = table(COLUMNS, ROWS, left=("status", "meaning"))
    text = printed(ascii_rule(item) if plain else item, width, terminal=terminal)
    assert {word for word in text.split() if not set(word) <= set("-─")} == WORDS


@pytest.mark.parametrize("width", [40, 80, 200])
def test_a_terminal_gets_parts_that_fit_and_begin_with_the_first_column(width):
    lines = printed(table(COLUMNS, ROWS, left=("status", "meaning")), width, terminal=True).splitlines()
    assert max(map(len, lines)) <= width
    heads = [line.split()[0] for line, below in pairwise(lines) if below.startswith("─")]
    assert heads == ["mode"] * len(heads)
    assert len(heads) == {40: 6, 80: 3, 200: 1}[width]


def test_elsewhere_one_table_has_lines_as_long_as_they_must_be():
    text = printed(table(COLUMNS, ROWS, left=("status",)), 40, terminal=False)
    assert text.count("─\n") == 1
    assert len(re.findall("^ *[+]", text, re.M)) == len(ROWS)


@pytest.mark.parametrize("width", [40, 80, 200])
def test_the_answer_with_most_columns_prints_the_numbers_of_its_json(assur_cli, monkeypatch, width):
    words = ("direct", "gough_stewart", "1", "1.1", "1.2", "1.1", "1", "1.2")
    solutions = assur_cli(*words, "--json").json["solutions"]
    monkeypatch.setenv("COLUMNS", str(width))
    out = assur_cli(*words).out
    shown = [line.split() for line in out.splitlines() if re.match(r" *[+-][a-z]* +-?\d", line)]
    assert [[float(word) for word in row[1:8]] for row in shown] == [
        pytest.approx(item["pose"], abs=6e-7) for item in solutions
    ]
    assert [float(row[-1]) for row in shown] == [pytest.approx(item["residual"], rel=0.06) for item in solutions]


def test_show_does_not_crop(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "20")
    show([table(COLUMNS, ROWS)])
    assert set(capsys.readouterr().out.split()) >= WORDS
