from types import SimpleNamespace

import numpy as np

from assur.numerics.vectors import about_z
from assur.report.formulas.letters import core_letters, is_rotation, parts_of, varies
from assur.report.formulas.trace import POINTS, Book, Letter, leaf, number

BOOK = Book()
ANGLES = np.linspace(0.2, 1.1, POINTS)
A, B = (leaf(BOOK, Letter(name, ""), np.linspace(k, k + 1, POINTS)) for k, name in enumerate("ab", 1))
COSINE, SINE = (leaf(BOOK, Letter("t", "", name), getattr(np, name)(ANGLES)) for name in ("cos", "sin"))


def names(core):
    return [f"{letter.function} {letter.name}".strip() for letter, _ in core_letters("", (), core)]


def test_what_is_nested_in_core_gets_the_places_it_has():
    legs = [SimpleNamespace(lever=A, rod=(A, B, 0)), SimpleNamespace(lever=B, rod=(1, B, A))]
    core = SimpleNamespace(z=A, arm=(COSINE, SINE), pair=(A, B), legs=legs)
    assert names(core) == [
        "z", "cos arm", "sin arm", "pair_1", "pair_2", "lever_1", "rod_1_1", "rod_1_2", "lever_2", "rod_2_2", "rod_2_3",
    ]  # fmt: skip


def test_plain_numbers_texts_and_rotations_have_no_letters():
    turn = about_z((COSINE, SINE))
    assert is_rotation(turn)
    assert not is_rotation(((A, B, A),) * 3)
    assert not is_rotation((A, B, A))
    assert names(SimpleNamespace(half=0.5, text="x", turn=turn, none=None)) == []


def test_recorded_numbers_of_a_value():
    assert parts_of((A, (1, B), [0, COSINE])) == (A, B, COSINE)
    assert parts_of(3) == ()
    assert varies(A)
    assert not varies(number(BOOK, 0.5))
    assert not varies(0.5)
