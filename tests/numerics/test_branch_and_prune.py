import itertools

import numpy as np
import pytest

from assur.numerics import branch_and_prune
from assur.numerics.branch_and_prune import zeros
from assur.numerics.intervals.interval import Interval


def found_by(conditions, low, high, **options):
    size = len(low)
    return zeros(conditions, Interval.of([low], [high]), np.zeros(1, dtype=int), np.ones(size), **options)


def cubics(_, x, labels):
    """(x - 1) (x + 2) x = 0 and the same of y: nine zeros, at the corners of boxes too."""
    return [(x[0] - 1) * (x[0] + 2) * x[0], (x[1] - 1) * (x[1] + 2) * x[1]], []


def test_every_zero_is_found_once_though_it_lies_on_the_borders_of_boxes():
    answer = found_by(cubics, [-4.0, -4.0], [4.0, 4.0])
    expected = sorted(itertools.product([-2.0, 0.0, 1.0], repeat=2))
    assert len(answer.undecided.low) == 0
    assert sorted(map(tuple, answer.isolated.middle.round(9) + 0.0)) == expected
    assert all(answer.isolated.contains(point).all(axis=1).sum() == 1 for point in expected)


def test_inequalities_take_zeros_away():
    answer = found_by(lambda ns, x, labels: (cubics(ns, x, labels)[0], [x[0] - 0.5]), [-4.0, -4.0], [4.0, 4.0])
    assert sorted(answer.isolated.middle[:, 0].round(9)) == [1.0] * 3


def test_labels_tell_the_conditions_apart():
    signs = np.array([1.0, -1.0])
    boxes = Interval.of([[0.0], [0.0]], [[3.0], [3.0]])
    answer = zeros(lambda _, x, label: ([x[0] * signs[label] - 2], []), boxes, np.arange(2), [1.0])
    assert (answer.labels.tolist(), answer.isolated.middle.round(9).tolist()) == ([0], [[2.0]])


def test_a_double_zero_and_a_curve_of_zeros_are_undecided_and_inside():
    double = found_by(lambda _, x, __: ([x[0] * x[0]], []), [-1.0], [2.0], smallest=1e-4)
    assert len(double.isolated.low) == 0
    assert double.undecided.contains(0.0).any()
    curve = found_by(
        lambda _, x, __: ([x[0] * x[0] + x[1] * x[1] - 1] * 2, []), [-2.0, -2.0], [2.0, 2.0], smallest=0.05
    )
    assert len(curve.isolated.low) == 0
    turn = np.linspace(0, 2 * np.pi, 50)
    for point in np.stack([np.cos(turn), np.sin(turn)], axis=-1):
        assert curve.undecided.contains(point).all(axis=1).any()


def test_a_zero_at_which_a_root_vanishes_is_undecided_not_lost():
    answer = found_by(lambda ns, x, __: ([ns.sqrt(x[0])], [x[0]]), [-1.0], [1.0], smallest=1e-3)
    assert len(answer.isolated.low) == 0
    assert answer.undecided.contains(0.0).any()


def test_what_is_not_defined_at_a_point_is_not_thrown_away():
    """1/x is never zero, but at x = 0 it says nothing."""
    answer = found_by(lambda _, x, __: ([1 / x[0]], []), [-1.0], [1.0], smallest=1e-3)
    assert answer.undecided.contains(0.0).any()
    assert np.all(answer.undecided.width < 0.1)


def test_too_many_boxes_are_handed_back():
    for limit in ("most", "total"):
        handed_back(found_by(cubics, [-4.0, -4.0], [4.0, 4.0], **{limit: 3}))


def handed_back(answer):
    assert len(answer.isolated.low) == 0
    assert answer.undecided.contains([1.0, 1.0]).all(axis=1).any()


def all_nine() -> bool:
    """Whether the nine zeros are found, with boxes tested while they still hold several."""
    boxes = Interval.of([[-4.0, -4.0]], [[4.0, 4.0]])
    answer = zeros(cubics, boxes, np.zeros(1, dtype=int), [40.0, 40.0], most=5000, smallest=1e-6)
    points = itertools.product([-2.0, 0.0, 1.0], repeat=2)
    held = all(answer.isolated.contains(point).all(axis=1).sum() == 1 for point in points)
    return held and len(answer.isolated.low) == 9 and len(answer.undecided.low) == 0


def test_boxes_with_several_zeros_are_halved():
    assert all_nine()


@pytest.mark.parametrize("name", ["proves", "refutes"])
def test_a_test_that_is_reversed_is_noticed(monkeypatch, name):
    own = getattr(branch_and_prune, name)
    monkeypatch.setattr(branch_and_prune, name, lambda found, box: ~own(found, box))
    assert not all_nine()


def test_parts_of_few_boxes_cover_them_once_and_are_no_finer_than_asked():
    low, high, size = np.array([[0.0, -1.0]]), np.array([[3.0, 1.0]]), np.ones(2)
    for smallest in (1e-7, 0.5):
        boxes = Interval.of(low, high)
        parts, labels = branch_and_prune._halved(boxes, np.array([7]), size, smallest)
        assert np.prod(parts.high - parts.low, axis=1).sum() == 6.0
        assert np.array_equal(np.unique(labels), [7])
        # no two have more than a border in common
        inside = (parts.low[:, None] < parts.high) & (parts.low < parts.high[:, None])
        assert np.all(inside.all(axis=-1).sum(axis=1) == 1)
        assert np.max(parts.width, axis=1).min() >= smallest / 2
    # the coarsest cuts that leave both 3 and 2 below 0.5, each in eight
    assert len(parts.low) == 8 * 8
