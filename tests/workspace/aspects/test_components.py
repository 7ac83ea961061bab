"""Components and links on boxes that are laid out by hand."""

import numpy as np

from assur.workspace.aspects import components as module
from assur.workspace.aspects.neighbours import neighbours
from assur.workspace.certified.boxes import Boxes


def row(*cells):
    """Unit squares with their lower left corners at cells."""
    low = np.array(cells, dtype=float).T.reshape(2, -1)
    return Boxes(low, low + 1)


def signs(*values):
    return np.array(values, dtype=np.int8).reshape(len(values), -1)


def components(boxes):
    return module.components(neighbours(boxes, boxes[:0]))


def links(certain, signs, undecided, possible):
    return module.links(neighbours(certain, undecided), signs, possible)


def test_components_are_numbered_by_their_first_box():
    assert components(row((5, 0), (0, 0), (6, 0), (1, 0), (1, 1))).tolist() == [0, 1, 0, 1, 1]


def test_a_corner_joins_nothing_but_does_not_tell_apart():
    found = links(row((0, 0), (1, 1)), signs([1], [1]), row(), np.zeros((0, 1), dtype=np.int8))
    assert found.component.tolist() == [0, 1]
    assert found.group.tolist() == [0, 0]


def test_a_chain_of_undecided_boxes_may_join():
    certain, undecided = row((0, 0), (3, 0)), row((1, 0), (2, 0))
    found = links(certain, signs([1], [1]), undecided, signs([0], [1]))
    assert found.group[0] == found.group[1]
    assert found.reached[found.group[0]].tolist() == [0, 1]
    assert found.chains(1).tolist() == [True, True]


def test_a_sign_that_is_known_in_an_undecided_box_breaks_the_chain():
    certain, undecided = row((0, 0), (3, 0)), row((1, 0), (2, 0))
    found = links(certain, signs([1], [1]), undecided, signs([0], [-1]))
    assert found.group[0] != found.group[1]
    assert sorted(item.tolist() for item in found.reached) == [[], [0]]


def test_other_signs_are_another_group_though_boxes_between_allow_both():
    found = links(row((0, 0), (2, 0)), signs([1], [-1]), row((1, 0)), signs([0]))
    assert found.group[0] != found.group[1]
    assert [item.tolist() for item in found.reached] == [[0], [0]]


def test_only_boxes_on_a_shortest_chain_are_named():
    certain = row((0, 0), (2, 0))
    undecided = row((1, 0), (0, 5), (0, 1), (0, 2))  # the last two are beside, the second is alone
    found = links(certain, signs([1], [1]), undecided, signs([0], [0], [0], [0]))
    assert found.chains(1).tolist() == [True, False, False, False]
    assert found.reached[0].tolist() == [0, 2, 3]


def test_nothing_at_all():
    found = links(row(), np.zeros((0, 2), dtype=np.int8), row((0, 0)), np.zeros((1, 2), dtype=np.int8))
    assert found.group.tolist() == []
    assert found.reached == ()
