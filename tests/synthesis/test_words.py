from itertools import product

import pytest

from assur.synthesis.words import FREEDOMS, words


def test_every_word_once_with_its_freedoms():
    found = list(words(5, 5))
    assert len(found) == len(set(found)) > 0
    assert {sum(FREEDOMS[letter] for letter, _ in word) for word in found} == {5}


def test_the_first_axis_is_x_and_new_ones_follow_in_order():
    for word in words(4, 4):
        axes = [axis for _, axis in word]
        assert list(dict.fromkeys(axes)) == ["x", "y", "z"][: len(set(axes))]


def test_slides_in_a_row_are_independent():
    """By hand: of P and P(4R) in a row, three are independent unless two are one line or all in one plane."""
    slides = {word for word in words(3, 3) if {letter for letter, _ in word} <= {"P", "A"}}
    letters = list(product("PA", "xyz"))
    every = {word for word in product(letters, repeat=3) if word[0][1] == "x"}
    rest = {word for word in every if _by_hand(word)}
    assert slides == {word for word in rest if _in_order([axis for _, axis in word])}


def _in_order(axes):
    return list(dict.fromkeys(axes)) == ["x", "y", "z"][: len(set(axes))]


def _by_hand(word):
    """Rado's condition: every n of the spaces (line of a P, plane across the axis of a P(4R)) span n dimensions."""
    spaces = [{axis} if letter == "P" else {"x", "y", "z"} - {axis} for letter, axis in word]
    return all(
        len(set().union(*(space for space, chosen in zip(spaces, choice, strict=True) if chosen))) >= sum(choice)
        for choice in product((0, 1), repeat=3)
    )


def test_a_single_r_turns_only_with_the_platform():
    lonely = (("P", "x"), ("P", "y"), ("P", "z"), ("R", "x"))
    assert lonely not in set(words(4, 4))
    about = (("P", "x"), ("P", "y"), ("P", "z"), ("R", "z"))
    assert about in {tuple(word) for word in words(4, 4, always="z")}


def test_a_platform_that_turns_needs_an_axis_to_turn_about():
    assert all("z" in {axis for letter, axis in word if letter in "RCBD"} for word in words(4, 4, always="z"))


@pytest.mark.parametrize("ball", [False, True])
def test_a_ball_joint_is_there_once_where_it_is_asked_for(ball):
    found = {sum(letter == "S" for letter, _ in word) for word in words(6, 6, ball=ball)}
    assert found == {int(ball)}


def test_joints_are_counted_with_crossing_neighbours_as_one():
    upu = (("R", "x"), ("R", "y"), ("P", "x"), ("R", "y"), ("R", "x"))
    assert upu in set(words(5, 3))
    assert upu not in set(words(5, 2))
