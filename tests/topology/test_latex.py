import re

import pytest

import assur
from assur.model.registry import topology_names
from assur.topology.latex import equations, fragment, name
from catalogue import each, topology_of

NAMES = sorted({*assur.names(), *topology_names()})
COMMANDS = {
    *(
        "begin",
        "end",
        "left",
        "right",
        "quad",
        "text",
        "mathrm",
        "frac",
        "dim",
        "min",
        "sum",
        "bigcap",
        "bigcup",
        "cup",
    ),
    *("cap", "notag", "parallel", "perp", "Diamond", "rho", "xi", "Delta", "kappa", "usepackage"),
    *("hline", "linewidth", "allowdisplaybreaks"),
}
"""Those of LaTeX, amsmath and amssymb that may be there."""


def pairs(text, opening, closing):
    return len(re.findall(opening, text)), len(re.findall(closing, text))


@pytest.mark.parametrize("mechanism", each(NAMES))
def test_the_fragment_is_plain_latex_that_closes_what_it_opens(mechanism):
    text = fragment(topology_of(mechanism))
    assert text.isascii()
    assert set(re.findall(r"\\([A-Za-z]+)", text)) <= COMMANDS
    bare = re.sub(r"\\[{}_]", "", text)
    depth = 0
    for sign in bare:
        depth += {"{": 1, "}": -1}.get(sign, 0)
        assert depth >= 0
    assert depth == 0
    for opening, closing in (
        (r"\\left", r"\\right"),
        (r"\\begin\{align\}", r"\\end\{align\}"),
        (r"begin\{bm", r"end\{bm"),
    ):
        first, second = pairs(text, opening, closing)
        assert first == second
    lines = text.split("\\begin{align}\n")[1].split("\n\\end{align}")[0].split("\n")
    assert sum("&=" in line for line in lines) == len(equations(topology_of(mechanism)))
    assert all(line.count("&") == 1 for line in lines)
    assert [line.endswith(" \\\\") for line in lines] == [True] * (len(lines) - 1) + [False]


@pytest.mark.parametrize("mechanism", NAMES)
def test_the_equations_hold_as_written(mechanism):
    """The numbers between the last two signs of equality, computed."""
    found = topology_of(mechanism)
    for item in equations(found):
        sides = item.right.split(" = ")
        if item.number in ("(3)", "(5)", "(6)"):
            written = re.sub(r"\|([^|]*)\|", r"abs(\1)", sides[-2])
            written = written.replace(r"\frac{1}{2}", "0.5 *")
            assert re.fullmatch(r"[-+0-9abs().* ]+", written), written
            assert eval(written) == int(sides[-1])  # noqa: S307  # digits and signs, looked at the line before


def test_indices_are_those_of_the_names():
    assert [name(text) for text in ("P", "R12", "leg1.A")] == ["P", "R_{12}", r"\mathrm{leg1.A}"]


def test_the_papers_derivation_has_its_unions_and_its_intersection():
    """Two hybrid chains: an inner loop with two rotations more, and three translations; what both have."""
    text = fragment(topology_of("zeng2019"))
    for line in (
        r"\begin{bmatrix} t^3 \\ r^2(\parallel\Diamond(",
        r"M_{b_{2}} &= \begin{bmatrix} t^1(\parallel P_{3}) \\ r^0 \end{bmatrix} \cup \begin{bmatrix} t^1(",
        r"r^2(\parallel\Diamond(R_{12}, R_{3})) \end{bmatrix} \cap \begin{bmatrix} t^3 \\ r^0 \end{bmatrix}",
        r"= \begin{bmatrix} t^3 \\ r^0 \end{bmatrix}, \quad \dim M_{Pa} = 3",
        r"F &= \sum_{i=1}^{m} f_i - \sum_{j=1}^{v} \xi_{L_j} = 11 - (3 + 5) = 3",
        r"= \frac{1}{2} (|+1| + |-1|) = 1",
    ):
        assert line in text, line
