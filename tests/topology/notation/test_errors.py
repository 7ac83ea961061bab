"""Messages point at their place, whatever the text is made of."""

import pytest

from assur.errors import UsageError
from assur.topology.notation import NotationError, parse_chain, parse_chains


@pytest.mark.parametrize(
    ("text", "column"),
    [("R[x] Q", 5), ("R[x]\tQ", 5), ("R[x]\nQ", 5), ("◇Q", 1), ("R[x] 日 Q", 5), ("Ｒ Q", 3), ("R\u0301", 1)],
)
def test_the_caret_stands_under_the_place(text, column):
    with pytest.raises(NotationError) as error:
        parse_chain(text)
    _, _, caret, *_ = error.value.message.splitlines()
    assert caret.index("^") - 2 == column


def test_a_long_text_is_shown_around_the_place():
    with pytest.raises(NotationError) as error:
        parse_chain("R[x] " * 30 + "Q" + " R[x]" * 20)
    _, shown, caret, *_ = error.value.message.splitlines()
    assert shown[caret.index("^")] == "Q"
    assert len(shown) < 90


def test_what_a_caller_can_ask():
    with pytest.raises(UsageError) as caught:
        parse_chains(["R[x]", "P[y] T"])
    error = caught.value
    assert (error.limb, error.text, error.position, error.offending) == (2, "P[y] T", 5, "'T'")
    assert "R, P, H, C, U, S" in error.expected
    assert "limb 2" in str(error)
    assert "T is not a joint" in error.hint
    assert error.exit_code == 2


def test_signs_that_look_like_nothing_are_named():
    with pytest.raises(NotationError, match=r"U\+200B ZERO WIDTH SPACE"):
        parse_chain("R\u200bR")
