"""Undo and redo as values."""

from assur.view.undo import MOST, History


def test_nothing_to_undo_changes_nothing():
    assert History(1).back() == History(1)
    assert History(1).on() == History(1)


def test_a_drag_is_one_step():
    found = History(0)
    for value in (1, 2, 3):
        found = found.then(value, "slider")
    assert found.back().present == 0
    assert found.back().on().present == 3


def test_after_an_undo_a_drag_of_the_same_thing_is_a_new_step():
    found = History(0).then(1, "slider").back().then(2, "slider")
    assert found.back().present == 0
    assert found.on() == found


def test_changes_without_a_label_stand_alone():
    assert History(0).then(1).then(2).back().present == 1


def test_a_new_change_forgets_what_was_undone():
    assert History(0).then(1).then(2).back().then(3).on().present == 3


def test_only_so_many_are_kept():
    found = History(0)
    for value in range(1, MOST + 50):
        found = found.then(value)
    assert len(found.past) == MOST


def test_after_a_rest_a_drag_of_the_same_thing_is_a_new_step():
    assert History(0).then(1, "slider").alone().then(2, "slider").back().present == 1
