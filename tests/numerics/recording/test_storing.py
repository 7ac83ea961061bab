"""Storing: what is moved, streamed or judged is what stood there, from any place to any other, and nothing else."""

import numba
import numpy as np
import pytest

from assur.numerics.recording.loops import empty_rows
from assur.numerics.recording.storing import GROUP, judged, moved, streamed


@numba.njit
def move(source, at, target, to):
    moved(source, at, target, to)


@numba.njit
def stream(source, at, target, to):
    streamed(source, at, target, to)


@numba.njit
def judge(source, at, target, to):
    judged(source, at, target, to)


@pytest.mark.parametrize("at", [0, 1, 6])
@pytest.mark.parametrize(("store", "to"), [*((move, to) for to in range(9)), (stream, 0), (stream, 8), (stream, 32)])
def test_a_group_and_nothing_beside_it(store, at, to):
    source = np.random.default_rng(at).normal(size=40)
    target = empty_rows(1, 100)[0]
    target.fill(0.0)
    store(source, at, target, to)
    wanted = np.zeros(100)
    wanted[to : to + GROUP] = source[at : at + GROUP]
    np.testing.assert_array_equal(target, wanted)


@pytest.mark.parametrize("to", range(5))
def test_truths(to):
    source = np.random.default_rng(to).integers(2, size=40).astype(float)
    target = np.zeros(100, dtype=bool)
    judge(source, 3, target, to)
    wanted = np.zeros(100, dtype=bool)
    wanted[to : to + GROUP] = source[3 : 3 + GROUP] == 1
    np.testing.assert_array_equal(target, wanted)
