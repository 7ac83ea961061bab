"""Adjacency against every pair compared: random halvings of one box, on a line, in a plane and in space."""

import itertools

import numpy as np
import pytest

from assur.workspace.aspects import adjacency
from assur.workspace.aspects.adjacency import contacts, shared_faces
from assur.workspace.certified.boxes import Boxes, together
from work import calls

LOW, HIGH = np.array([-1.1, 0.3, 2.7]), np.array([0.7, 5.1, 3.3])


def halved(size, count, rng, low=LOW, high=HIGH, kept=0.8):
    """About `count` boxes of any shape from one, some of which are taken out."""
    boxes = Boxes(low[:size, None].copy(), high[:size, None].copy())
    while len(boxes) < count:
        chosen = rng.random(len(boxes)) < 0.5
        if chosen.any():
            axes = rng.integers(0, size, int(chosen.sum()))
            boxes = together([boxes[~chosen], boxes[chosen].halved(axes)])
    return boxes[rng.random(len(boxes)) < kept]


def overlap(boxes, i, j):
    return np.minimum(boxes.high[:, i], boxes.high[:, j]) - np.maximum(boxes.low[:, i], boxes.low[:, j])


def faces_by_pairs(boxes):
    found = set()
    for i, j in itertools.permutations(range(len(boxes)), 2):
        common = overlap(boxes, i, j)
        flat = np.flatnonzero(common == 0)
        if np.all(common >= 0) and len(flat) == 1 and boxes.high[flat[0], i] == boxes.low[flat[0], j]:
            found.add((i, j, int(flat[0])))
    return found


def touching_by_pairs(boxes):
    pairs = itertools.combinations(range(len(boxes)), 2)
    return {(i, j) for i, j in pairs if np.all(overlap(boxes, i, j) >= 0)}


@pytest.mark.parametrize("size", [1, 2, 3])
@pytest.mark.parametrize("seed", range(2))
def test_faces_and_contacts_are_those_of_every_pair(size, seed):
    boxes = halved(size, 120, np.random.default_rng(seed))
    pairs, axes = shared_faces(boxes)
    assert {(*pair, axis) for pair, axis in zip(pairs.tolist(), axes.tolist(), strict=True)} == faces_by_pairs(boxes)
    assert len(pairs) == len(faces_by_pairs(boxes))
    assert set(map(tuple, contacts(boxes).tolist())) == touching_by_pairs(boxes)
    assert len(contacts(boxes)) == len(touching_by_pairs(boxes))


@pytest.mark.parametrize(
    ("size", "closed"), [(1, (0,)), (2, (1,)), (2, (0, 1)), (3, (2,)), (3, (0, 2)), (3, (0, 1, 2))]
)
def test_where_coordinates_turn_boxes_meet_beyond_the_ends(size, closed):
    """Against every pair of boxes after every turn; the box is one on which no shift is rounded."""
    boxes = halved(size, 60, np.random.default_rng(0), np.zeros(3), np.array([1.0, 2.0, 4.0]), 1.0)
    spans = [(0.0, [1.0, 2.0, 4.0][axis]) if axis in closed else None for axis in range(size)]
    faces, touching = set(), set()
    for shift in itertools.product(*([-1, 0, 1] if axis in closed else [0] for axis in range(size))):
        offset = np.array([by * (span[1] if span else 0.0) for by, span in zip(shift, spans, strict=True)])[:, None]
        there = together([boxes, Boxes(boxes.low + offset, boxes.high + offset)])
        count = len(boxes)
        for i, j in itertools.product(range(count), range(count, 2 * count)):
            common = overlap(there, i, j)
            if i == j - count or np.any(common < 0):
                continue
            touching.add((min(i, j - count), max(i, j - count)))
            flat = np.flatnonzero(common == 0)
            if len(flat) == 1:
                first, second = (i, j - count) if there.high[flat[0], i] == there.low[flat[0], j] else (j - count, i)
                faces.add((first, second, int(flat[0])))
    pairs, axes = shared_faces(boxes, spans)
    assert {(*pair, axis) for pair, axis in zip(pairs.tolist(), axes.tolist(), strict=True)} == faces
    assert set(map(tuple, contacts(boxes, spans).tolist())) == touching
    assert touching > touching_by_pairs(boxes)


@pytest.mark.parametrize("size", [2, 3])
def test_a_common_corner_or_edge_is_no_face(size):
    corner = Boxes(np.array([[0.0, 1.0]] * size), np.array([[1.0, 2.0]] * size))
    assert len(shared_faces(corner)[0]) == 0
    assert contacts(corner).tolist() == [[0, 1]]


def test_taking_contacts_for_faces_would_be_seen():
    """The mutation that the component of boxes must not survive: corners counted as faces."""
    boxes = halved(2, 120, np.random.default_rng(1))
    mutated, _ = adjacency._meeting(boxes, 1)
    assert set(map(tuple, np.sort(mutated, axis=1).tolist())) != {(min(i, j), max(i, j)) for i, j, _ in
                                                                 faces_by_pairs(boxes)}  # fmt: skip


def test_boxes_a_float_apart_do_not_meet():
    gap = np.nextafter(1.0, 2.0)
    boxes = Boxes(np.array([[0.0, gap], [0.0, 0.0]]), np.array([[1.0, 2.0], [1.0, 1.0]]))
    assert len(shared_faces(boxes)[0]) == 0
    assert len(contacts(boxes)) == 0


def test_no_boxes_and_one_box():
    none = Boxes(np.zeros((3, 0)), np.zeros((3, 0)))
    one = Boxes(np.zeros((3, 1)), np.ones((3, 1)))
    for boxes in (none, one):
        assert shared_faces(boxes)[0].shape == (0, 2)
        assert contacts(boxes).shape == (0, 2)


@pytest.mark.parametrize("sides", [4, 48])
def test_a_hundred_thousand_boxes_take_no_more_calls_than_a_few(sides):
    whole = Boxes(np.zeros((3, 1)), np.ones((3, 1)))
    boxes = whole.divided([sides] * 3)
    assert calls(lambda: shared_faces(boxes)) < 2000
    assert len(shared_faces(boxes)[0]) == 3 * (sides - 1) * sides * sides
