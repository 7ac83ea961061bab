"""The search: what it finds at one size it does not take back at a smaller one, and it may be interrupted."""

import itertools

import numpy as np
import pytest

from assur.model.registry import load_record
from assur.workspace.aspects import search as module
from assur.workspace.aspects.search import search
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.domain import box_of


def frame_of(name, mode=None, box=None, held=None):
    record = load_record(name)
    asked = criteria(record, mode, held=held, factors=("parallel", "serial")).nonsingular
    return BoxQuestion(asked, box_of(record, box, asked.slice.free), asked.used)


PART = {"phi": (0.0, 1.2)}
COARSE = {"x": 2.5, "y": 2.5, "phi": 0.15}
FIVEBAR = {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}


def test_boxes_fill_the_box_once():
    found = search(frame_of("fivebar", "-+", FIVEBAR), {"x": 10.0, "y": 10.0})
    total = sum(float(np.sum(part.sizes.high)) for part in (found.certain, found.undecided, found.outside))
    assert total == pytest.approx(600.0 * 600.0, rel=1e-12)


def test_every_certain_box_has_a_sign_of_every_factor():
    found = search(frame_of("planar_3rpr", held={"phi": 0.3}), {"x": 1.0, "y": 1.0})
    assert np.all(found.signs != 0)
    assert len(found.signs) == len(found.certain) > 100


def test_components_that_only_looked_apart_are_joined_by_cutting_between_them(monkeypatch):
    """The two aspects of the 3-RPR: at this size four parts are seen first."""
    frame = frame_of("planar_3rpr", box=PART)
    finest = {
        name: (high - low) / 32 for name, low, high in zip(frame.box.names, frame.box.low, frame.box.high, strict=True)
    }
    found = search(frame, finest)
    monkeypatch.setattr(module, "ROUNDS", 0)
    before = search(frame, COARSE)
    assert len(before.links.group) > len(found.links.group) == 2
    assert len(set(before.links.group.tolist())) == len(set(found.links.group.tolist())) == 2


def test_an_interruption_keeps_what_is_done(monkeypatch):
    calls = []

    def interrupted(state, chosen):
        calls.append(1)
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "_cut", interrupted)
    frame = frame_of("planar_3rpr", box=PART)
    found = search(frame, COARSE)
    assert (found.stopped, calls) == ("interrupted", [1])
    assert len(found.links.group) > 2


def test_progress_ends_at_the_whole():
    steps = []
    search(frame_of("fivebar", "-+", FIVEBAR), {"x": 10.0, "y": 10.0}, lambda *step: steps.append(step))
    assert steps[-1][0] == steps[-1][1]
    assert all(a <= b for (a, _), (b, _) in itertools.pairwise(steps))


def test_what_is_cut_is_judged_once_before_and_once_after_each_cut(monkeypatch):
    frame = frame_of("planar_3rpr", box=PART)
    monkeypatch.setattr(module, "ROUNDS", 1)
    before, calls, own = search(frame, COARSE), [], module.judged

    def counted(frame, boxes, shares):
        calls.append(len(boxes))
        return own(frame, boxes, shares)

    monkeypatch.setattr(module, "judged", counted)
    chosen = np.arange(len(before.undecided)) < 50
    module._cut(before, chosen)
    assert calls[:2] == [50, 100]
    assert len(calls) == 4
