"""Blocks: in their order, with as much at a time as is allowed, and stopped by the first error."""

import threading

import numpy as np
import pytest

from assur.errors import UsageError
from assur.kinematics.closed_form.blocks import columns_of, each_block, in_order, parts_of


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_results_come_in_order_and_no_more_is_begun_than_allowed(threads):
    begun, lock, ahead = [], threading.Lock(), []

    def one(part):
        with lock:
            begun.append(part.start)
        return part.start

    for number, start in enumerate(in_order(one, parts_of(100, 3), threads)):
        assert start == 3 * number
        ahead.append(len(begun) - number - 1)
    assert len(begun) == 34
    assert max(ahead) < 2 * threads


@pytest.mark.parametrize("threads", [1, 2])
def test_an_error_stops_what_is_not_begun(threads):
    begun = []

    def one(part):
        begun.append(part.start)
        if part.start == 5:
            raise ValueError("here")
        return part.start

    with pytest.raises(ValueError, match="here"):
        list(in_order(one, parts_of(1000, 1), threads))
    assert len(begun) < 20


@pytest.mark.parametrize(("block", "threads"), [(1, 1), (4, 2), (100, 3)])
def test_every_problem_is_given_once(block, threads):
    columns, count = columns_of([np.arange(11.0), np.arange(11.0) + 100], ("a", "b"), "numbers")
    found, told = np.zeros((2, count)), []

    def work(part, given):
        found[:, part] = given.T

    each_block(work, columns, count, block, lambda done, total: told.append((done, total)), threads)
    np.testing.assert_array_equal(found, columns)
    assert told == [(min(stop, 11), 11) for stop in range(block, 11 + block, block)]


def test_refuses_no_block_and_no_threads():
    for block, threads in ((0, 1), (1, -1)):
        with pytest.raises(UsageError, match="at least 1"):
            each_block(lambda *_: None, (np.zeros(3),), 3, block, None, threads)
