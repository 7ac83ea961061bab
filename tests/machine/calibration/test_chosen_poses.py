"""Poses to measure at: those that are chosen show more than those that are drawn, by each index."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError
from assur.machine.calibration.chosen_poses import chosen, random_poses
from assur.machine.calibration.identification import INDICES, identification


@pytest.fixture(scope="module")
def drawn():
    record = assur.load("fivebar")
    poses = random_poses(record, 9)
    return record, poses, identification(record, poses)


@pytest.mark.parametrize("index", INDICES)
def test_no_single_exchange_shows_more(drawn, index):
    """By singular values of the matrices themselves."""
    record, poses, every = drawn
    rows = chosen(every, 4, index)
    best = identification(record, poses[rows]).observability[index]
    assert len(set(rows)) == 4
    for place in range(4):
        for other in set(range(9)) - set(rows):
            swapped = rows.copy()
            swapped[place] = other
            assert _of_rows(every, swapped, index) <= best * (1.0 + 1e-5)


def _of_rows(every, rows, index):
    part = every.matrix.reshape(len(every.poses), -1, len(every.parameters))[rows]
    sizes = np.linalg.svd(part.reshape(-1, len(every.parameters)) * every.scales, compute_uv=False)
    of_index = {
        "O1": np.prod(sizes) ** (1 / len(sizes)) / np.sqrt(len(rows)),
        "O2": sizes[-1] / sizes[0],
        "O3": sizes[-1],
        "O4": sizes[-1] ** 2 / sizes[0],
        "O5": 1.0 / np.sum(1.0 / sizes),
    }
    return of_index[index]


def test_too_few_poses_to_tell_all_are_taken_as_they_come(drawn):
    assert chosen(drawn[2], 2).tolist() == [0, 1]


def test_another_index_is_refused(drawn):
    with pytest.raises(UnknownNameError, match="index of observability 'O6'"):
        chosen(drawn[2], 4, "O6")
