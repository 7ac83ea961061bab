"""Ties: of a drafted file each number may be changed alone; where loops need more, a formula or a comment says so."""

import re
from functools import cache
from pathlib import Path

import pytest

from assur.kinematics.validation.check import faults
from assur.model.file.reader import read_text
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.ties import ties
from assur.topology.notation import parse_chains

PATH = Path("my.toml")
TWIN = "{P[y] R[x] R[x] | P[y] R[x] R[x]}"
SIZE = re.compile(r"(\w+ +)= \{ value = ([-\d.e]+), meaning", re.MULTILINE)
deep = pytest.mark.deep
KINDS = [
    (TWIN, "P[y] U[x,y] S"),
    pytest.param(("H[x] R[x] R[x]", "R[y] R[y] R[y]"), marks=deep),
    pytest.param((f"{TWIN} R[y] R[y]", "P[y] P(4R)[y] P(4R)[x]"), marks=deep),
    pytest.param((f"{TWIN} R[y] R[y]", "R[z] R[z] C[z]"), marks=deep),
    pytest.param(("{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "C[z] R[z]"), marks=deep),
    pytest.param(("{P[z] R[0,1,0.5] R[0,1,0.5] | P[z] R[0,1,0.5] R[0,1,0.5]} R[z]", "U S"), marks=deep),
    pytest.param(("P[x] R[y] P(4R)[z] R[y]", "P[y] R[z] P(4R)[x] R[z]", "P[z] R[x] P(4R)[y] R[x]"), marks=deep),
    pytest.param(("{P[x] R[y] R[y] | P[x] R[y] R[y]} P[y]", "P[z] R[z] R[z] P[x]"), marks=deep),
    pytest.param(("R[1,1,0] R[1,1,0] R[1,1,0]", "R[y] R[y] R[y]"), marks=deep),
    pytest.param(("P(4R)[x] P(4R)[y]", "P(4R)[y] P(4R)[x]"), marks=deep),
    pytest.param(("P[z] R[z] R[z] R[z]",) * 5, marks=deep),
    pytest.param(("{R[x]@O R[0.6,0,0.8]@O | R[y]@O R[0,0.6,0.8]@O R[1,1,1]@O}", "U S"), marks=deep),
]


@cache
def draft(chains: tuple[str, ...], *, coordinates: bool = False) -> str:
    return drafted(parse_chains(chains), PATH, coordinates=coordinates).text


@pytest.mark.parametrize("coordinates", [False, pytest.param(True, marks=deep)])
@pytest.mark.parametrize("chains", KINDS)
def test_each_number_of_a_draft_may_be_changed_alone(chains, coordinates):
    """By three per cent: the file of the changed number is read and closed anew, and has all freedoms."""
    text = draft(chains, coordinates=coordinates)
    sizes = list(SIZE.finditer(text))
    assert sizes
    for size in sizes:
        changed = text.replace(size[0], f"{size[1]}= {{ value = {1.03 * float(size[2]):.12g}, meaning")
        assert faults(read_text(changed, PATH)) == (), size[1]


def test_an_offset_across_a_plane_that_two_branches_share_is_a_formula_of_the_others():
    """Both branches move in planes x = const: the loop's offsets along x add up to nothing."""
    text = draft((TWIN, "P[y] U[x,y] S"))
    assert 'xC     = { value = "rA - e1"' in text
    alone = text.replace('value = "rA - e1"', "value = 100")
    (tie,) = ties(read_text(alone, PATH))
    assert tie.formula == "rA - e1"
    assert tie.linear
    assert "close" in str(faults(read_text(alone.replace("value = 100,", "value = 103,"), PATH))[0])


def test_what_no_formula_ties_is_named():
    """The same place by a radius and an angle."""
    text = draft((TWIN, "P[y] U[x,y] S"))
    polar = text.replace('value = "rA - e1"', "value = 141.42135623730951").replace(
        'value = 100, meaning = "platform: C along Y", sign = "any"',
        'value = 45, meaning = "platform: C about Z", sign = "any", unit = "deg"',
    )
    polar = polar.replace('["xC", "yC", 0]', '["xC*cos(yC)", "xC*sin(yC)", 0]')
    (tie,) = ties(read_text(polar, PATH))
    assert not tie.linear
    assert set(tie.names) == {"rA", "e1", "xC", "yC"}
