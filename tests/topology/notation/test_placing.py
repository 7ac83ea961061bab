"""Directions from signs: what is asked for holds, what is not said is nowhere so by accident."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import NEARLY, parallel, perpendicular
from assur.topology.notation import NotationError, parse_chain, parse_chains, plain_text

HOLDS = {"∥": parallel, "⊥": perpendicular}


def axes(text):
    return [axis for joint in parse_chain(text).joints for axis in joint.axes]


@given(st.lists(st.sampled_from(["∥", "⊥", "-"]), min_size=1, max_size=12))
def test_neighbours_lie_as_the_signs_say_and_others_do_not(signs):
    """Of R's in series: only parallel runs are parallel, only neighbouring runs with ⊥ between them perpendicular."""
    found = axes("R" + "".join(f"{sign}R" for sign in signs))
    runs = np.cumsum([0, *(sign != "∥" for sign in signs)])
    right = {(runs[i], runs[i + 1]) for i, sign in enumerate(signs) if sign == "⊥"}
    assert found[0] == (0, 0, 1)
    for i, j in combinations(range(len(found)), 2):
        cosine, sine = abs(np.dot(found[i], found[j])), np.linalg.norm(np.cross(found[i], found[j]))
        assert parallel(found[i], found[j]) if runs[i] == runs[j] else sine > NEARLY
        assert perpendicular(found[i], found[j]) if (runs[i], runs[j]) in right else cosine > NEARLY


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("R ∥ R[x] ∥ R", "R[x] R[x] R[x]"),
        ("R[x] ⊥ R ⊥ R[y]", "R[x] R[z] R[y]"),
        ("R[x] ∥ R[-x]", "R[x] R[-x]"),
        ("R[-x] ∥ R", "R[-x] R[-x]"),
        ("◇(P[x], P[y]) ⊥ R ∥ R", "P[x] P[y] R[z] R[z]"),
        ("R[z] ⊥ ◇(P[x], P[y])", None),
        ("R ⊥ ◇(P[x], P[y])", "R[z] P[x] P[y]"),
        ("◇(P[x], P[y]) ∥ R ⊥ P[1,1,0]", "P[x] P[y] R[1,-1,0] P[1,1,0]"),
        ("◇(P[x], P[y]) ∥ ◇(R, R[x]) - R[1,2,0] ⊥ R ⊥ R[1,1,0]", None),
        ("U[x,y] ∥ R", "U[x,y] R[y]"),
        ("R ∥ U[x,y]", "R[x] U[x,y]"),
        ("C[x] / R ⌢ S", "C[x]@A R[x]@A S@A"),
        ("P[x] / R", "P[x] R[x]"),
        ("R[x]@B / R - R[x] ⌢ R[y]", "R[x]@B R[x]@B R[x]@A R[y]@A"),
        ("R@B[x] ⌢ R[y] ⌢ R[z]", "R[x]@B R[y]@B R[z]@B"),
        ("R[x] ⌢ R@B[y] ⌢ R[z]@B", "R[x]@B R[y]@B R[z]@B"),
    ],
)
def test_what_is_placed_places_the_rest(text, expected):
    if expected:
        assert plain_text(parse_chain(text)) == expected
    else:
        parse_chain(text)


def test_a_u_without_directions_has_perpendicular_axes():
    (universal,) = parse_chain("U").elements
    assert universal.general
    assert perpendicular(*universal.axes)
    _, universal, _ = parse_chain("R[x] ∥ U ∥ R").elements
    assert universal.axes[0] == (1, 0, 0)
    assert not universal.general
    assert perpendicular(*universal.axes)


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("R[x] ∥ R[y]", 5),
        ("R[x] ⊥ R[x]", 5),
        ("R[x] ⊥ R[1,1,0]", 5),
        ("R[x] ∥ R ∥ R[y]", 9),
        ("R[x] ∥ R ⊥ R ⊥ R[x] ∥ R[z]", 20),
        ("R[x] / R[y]", 5),
        ("R[x] ⌢ R[x]", 5),
        ("R[x] ⌢⊥ R[1,1,0]", 5),
        ("U[x,x]", 4),
        ("U[x,-x]", 4),
        ("U[1,2,0; -2,-4,0]", 9),
        ("◇(P[x], P[x]) ⊥ R", 0),
        ("◇(P[x], P[y]) ⊥ R[x]", 14),
        ("◇(P[x], P[y]) ∥ R[z]", 14),
        ("◇(P[x], P[y]) ⊥ R ⊥ R[z]", 18),
        ("R@A ⌢ R@B", 4),
        ("R@A / R ⌢ R@B", 8),
    ],
)
def test_contradictions(text, column):
    with pytest.raises(NotationError, match="a contradiction") as error:
        parse_chain(text)
    assert error.value.position == column


@pytest.mark.parametrize("sign", ["∥", "⊥", "/", "⌢"])
@pytest.mark.parametrize("element", ["P(4R)", "Pa[x]", "{R|S}"])
def test_signs_beside_what_has_no_one_axis(sign, element):
    for text in (f"R {sign} {element}", f"{element} {sign} R"):
        with pytest.raises(NotationError, match="beside") as error:
            parse_chain(text)
        assert error.value.position == text.index(sign)
        assert "place the axes" in error.value.hint


@pytest.mark.parametrize("text", ["R ∥ S", "S ⊥ R", "S / R", "P ⌢ R", "R ⌢ P", "◇(P,P) / R", "◇(R,R) ⌢ R"])
def test_signs_that_a_neighbour_gives_no_meaning(text):
    with pytest.raises(NotationError, match="beside"):
        parse_chain(text)


@pytest.mark.parametrize(
    ("texts", "limb", "column"),
    [
        (["R[x] P[1,0.0001,0]"], 0, 7),
        (["R[x] P[0.0001,1,0]"], 0, 7),
        (["R[1,0.0005,0] P[y]"], 0, 2),
        (["R[0.866,0.5,0] {R[0.8661,0.5,0] | S}"], 0, 18),
        (["U[0.866,0.5,0; -0.5,0.8661,0]"], 0, 15),
        (["R[0.5,0.866,0]", "P[x] R[-0.8661,0.5,0]"], 2, 7),
        (["R[0.5,0.8661,0]", "P[0.866,0.5,0]", "P[-0.866,0.5,0]"], 3, 2),
        (["P[x]", "P(4R)[x] R[1,1e-6,0]"], 2, 11),
    ],
)
def test_slips_of_the_pen(texts, limb, column):
    with pytest.raises(NotationError, match="nearly but not exactly") as error:
        parse_chains(texts)
    assert (error.value.limb, error.value.position) == (limb, column)
    assert "more digits" in error.value.hint


def test_directions_that_are_clearly_different_are_no_slips():
    parse_chains(["R[1,0.01,0] P[0.01,1,0]", "R[x] R[1,1e-12,0]"])


@pytest.mark.parametrize(
    ("first", "placed"),
    [
        ("-R ∥ R ⊥ P-", "-R[x] ∥ R ⊥ P-"),
        ("R-R-P-R", "R[x]-R-P-R"),
        ("U-P-S", "U[x,y]-P-S"),
        ("S-R-P", "S-R[x]-P"),
        ("{P∥R|P-R}", "{P[x]∥R|P-R}"),
        ("-P3-P(4R)-P(4R)-", "-P3[y]-P(4R)-P(4R)-"),
        ("◇(P,P)⊥R", "◇(P[x],P)⊥R"),
        ("HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R3 ∥ R4-}", "HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R[x](2P4R) ⊥ R3 ∥ R4-}"),
        ("HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R3 ∥ R4-}", "HSOC{-◇(P1[y](2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R3 ∥ R4-}"),
    ],
)
def test_the_literature_says_nothing_between_limbs(first, placed):
    assert parse_chain(first)
    assert parse_chains([first])
    assert parse_chains([placed, "P[x]"])
    with pytest.raises(NotationError, match="the direction of its first axis") as error:
        parse_chains(["P[x]", first])
    assert error.value.limb == 2
    assert "R[x]" in error.value.hint


def test_limbs_that_need_no_placing():
    assert len(parse_chains(["U P S", "R R", "S-S", "SOC{S}"])) == 4
