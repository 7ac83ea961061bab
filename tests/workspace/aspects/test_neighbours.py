"""Neighbours after cuts are those of all boxes, and only what lies beside a cut is compared."""

import numpy as np
import pytest

from assur.workspace.aspects import neighbours as module
from assur.workspace.aspects.neighbours import neighbours
from assur.workspace.certified.boxes import Boxes


def pairs(rows):
    return {tuple(row) for row in rows.tolist()}


def cut(found, chosen, rng):
    """Halves of chosen boxes, of which some are certain from now on and some are dropped."""
    parts = found.undecided[chosen].halved(rng.integers(0, len(found.undecided.low), int(chosen.sum())))
    kind = rng.integers(0, 3, len(parts))
    return found.cut(chosen, parts[kind == 0], parts[kind == 1])


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("size", [1, 2, 3])
def test_after_cuts_they_are_those_of_all_boxes(size, turning):
    rng = np.random.default_rng(size)
    whole = Boxes(np.zeros((size, 1)), np.ones((size, 1)))
    ends = [(0.0, 1.0), *([None] * (size - 1))] if turning else ()
    found = neighbours(whole[:0], whole.divided([4] * size), ends)
    for _ in range(6):
        found = cut(found, rng.random(len(found.undecided)) < 0.4, rng)
        fresh = neighbours(found.certain, found.undecided, ends)
        assert pairs(found.faces) == pairs(fresh.faces)
        assert pairs(found.touching) == pairs(fresh.touching)
        assert len(found.touching) == len(fresh.touching)
    assert len(found.faces) > 2


def test_what_is_far_from_a_cut_is_not_compared_again(monkeypatch):
    whole = Boxes(np.zeros((2, 1)), np.ones((2, 1)))
    found, compared, own = neighbours(whole[:0], whole.divided([64, 64])), [], module.contacts

    def counted(boxes, ends):
        compared.append(len(boxes))
        return own(boxes, ends)

    monkeypatch.setattr(module, "contacts", counted)
    cut(found, np.arange(len(found.undecided)) == 100, np.random.default_rng(0))
    assert compared[0] < 12
