"""POC sets in three styles, for every relation that a direction mark can have."""

from typing import get_args

import numpy as np
import pytest

from assur.topology.poc import Mark, PocSet, Relation

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TEXTS = [
    (Mark(), 3, "", "", ""),
    (Mark("parallel", ("P1",), (X,)), 1, "(∥P1)", "(||P1)", r"(\parallel P1)"),
    (Mark("perpendicular", ("R1",), (Y, Z)), 2, "(⊥R1)", "(_|_R1)", r"(\perp R1)"),
    (Mark("plane", ("R12", "R3")), 2, "(∥◇(R12, R3))", "(||<>(R12, R3))", r"(\parallel\Diamond(R12, R3))"),
    (Mark("plane", ("U4",)), 2, "(∥◇(U4))", "(||<>(U4))", r"(\parallel\Diamond(U4))"),
    (Mark("arm", ("R2",)), 1, "(⊥(R2, ρ))", "(_|_(R2, rho))", r"(\perp (R2, \rho))"),
    (Mark("moving"), 2, "(moving)", "(moving)", r"(\text{moving})"),
    (Mark("located"), 1, "(located)", "(located)", r"(\text{located})"),
    (Mark("fixed", (), (Z,)), 1, "(∥[0, 0, 1])", "(||[0, 0, 1])", r"(\parallel [0, 0, 1])"),
    (Mark("fixed", (), (X, Y)), 2, "(⊥[0, 0, 1])", "(_|_[0, 0, 1])", r"(\perp [0, 0, 1])"),
]


def test_every_relation_has_a_text():
    assert {mark.relation for mark, *_ in TEXTS} == set(get_args(Relation))


@pytest.mark.parametrize("item", TEXTS, ids=[f"{mark.relation} {count}" for mark, count, *_ in TEXTS])
def test_texts_in_three_styles(item):
    mark, count, unicode, ascii_text, latex = item
    power = "⁰¹²³"[count]
    translations = PocSet(count, 0, count, t_mark=mark)
    assert translations.text() == str(translations) == f"t{power}{unicode} r⁰"
    assert translations.text("ascii") == f"t^{count}{ascii_text} r^0"
    assert translations.text("ascii").isascii()
    assert translations.text("latex") == rf"\begin{{bmatrix}} t^{count}{latex} \\ r^0 \end{{bmatrix}}"
    rotations = PocSet(0, count, count, r_mark=mark)
    assert rotations.text() == f"t⁰ r{power}{unicode}"
    assert rotations.text("ascii") == f"t^0 r^{count}{ascii_text}"
    assert rotations.text("latex") == rf"\begin{{bmatrix}} t^0 \\ r^{count}{latex} \end{{bmatrix}}"


@pytest.mark.parametrize(
    ("vector", "text"),
    [
        ((0.6, 0.8, 0.0), "0.6, 0.8, 0"),
        ((-0.6, -0.8, -0.0), "0.6, 0.8, 0"),
        ((0.0, -1.0, 0.0), "0, 1, 0"),
        ((1e-9, -1.0, 2e-12), "0, 1, 0"),
        ((-1 / 3, 2 / 3, 2 / 3), "0.333, -0.667, -0.667"),
    ],
)
def test_a_fixed_direction_has_three_digits_and_one_sense(vector, text):
    """A line has no sense: the first of its larger parts is positive, and nothing is minus zero."""
    for sense in (1, -1):
        mark = Mark("fixed", (), (tuple(sense * np.array(vector)),))
        assert str(PocSet(1, 0, 1, mark)) == f"t¹(∥[{text}]) r⁰"


def test_a_fixed_plane_is_named_by_its_normal_whatever_basis_it_has():
    half = float(np.sqrt(0.5))
    for basis in ((X, Y), (Y, X), ((half, half, 0.0), (half, -half, 0.0))):
        assert str(PocSet(2, 1, 3, Mark("fixed", (), basis))) == "t²(⊥[0, 0, 1]) r¹"


@pytest.mark.parametrize(("t", "r", "dim", "dependent"), [(3, 3, 6, 0), (1, 1, 1, 1), (3, 3, 5, 1), (3, 2, 3, 2)])
def test_elements_beyond_the_dimension_are_not_independent(t, r, dim, dependent):
    assert PocSet(t, r, dim).dependent == dependent
