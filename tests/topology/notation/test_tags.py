"""Tags: three neighbours that stand for one planar loop."""

import pytest

from assur.topology.notation import NotationError, parse_chain, plain_text


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ("R(2P4R)", 0, "three neighbours"),
        ("P(2P4R) ⊥ R(2P4R) - R", 0, "three neighbours"),
        ("P(2P4R) ⊥ R(2P4R) ∥ R(6R)", 0, "three neighbours"),
        ("◇(P(2P4R), P(2P4R)) - {S|S} - R(2P4R)", 0, "three neighbours"),
        ("R - ◇(P(2P4R), P(6R)) ⊥ R(2P4R)", 4, "a diamond of two loops"),
        ("◇(P(2P4R), P) ⊥ R(2P4R)", 0, "a diamond of two loops"),
        ("◇(P(2P4R), R(2P4R)) ⊥ R(2P4R)", 0, "two P"),
        ("◇(P(2P4R), P(2P4R)) ⊥ P(2P4R)", 22, "one rotation"),
        ("R(4R) ∥ R(4R)", 1, "six joints"),
        ("R(5R) ∥ R(5R)", 1, "six joints"),
        ("R(3P2R) ∥ R(3P2R)", 1, "six joints"),
        ("R(5PR) ∥ R(5PR) ∥ R(5PR)", 1, "two or more of them R"),
        ("R(7R) ∥ R(7R) ∥ R(7R)", 1, "three freedoms"),
        ("R(6R)@A ∥ R(6R) ∥ R(6R)", 0, "a label"),
        ("P1(6R) ⊥ R(6R) ∥ R(6R)", 0, "has no such P"),
        ("P[x](6R) ⊥ R(6R) ∥ R(6R)", 0, "has no such P"),
        ("R1(4P2R) ∥ R2(4P2R) ∥ R3(4P2R)", 22, "has no such R"),
    ],
)
def test_tags_that_make_no_loop(text, column, words):
    with pytest.raises(NotationError) as error:
        parse_chain(text)
    assert error.value.position == column
    assert words in str(error.value)


def test_two_loops_with_one_tag():
    loop = "◇(P[{}](2P4R), P(2P4R)) ⊥ R[{}](2P4R)"
    text = plain_text(parse_chain(f"{loop.format('y', 'x')} ∥ {loop.format('x', 'y')}"))
    first, second = "{P[y] R[x] R[x] | P[y] R[x] R[x]}", "{P[x] R[y] R[y] | P[x] R[y] R[y]}"
    assert text == f"{first} {second}"
