"""Judged boxes: what is said of a whole box holds at every pose of it that is tried, and bounds hold the share."""

import numpy as np
import pytest

import assur
from assur.numerics.recording.tape import Recorder
from assur.workspace.certified import planes
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.criteria import Criteria, criteria
from assur.workspace.certified.planes import BoxQuestion, joined, judged
from assur.workspace.domain import Box, box_of
from assur.workspace.fields import closed_form_fields
from assur.workspace.slices import Slice

RNG = np.random.default_rng(8)
SAMPLES = 500


def question(name, **options):
    record = assur.load(name)
    asked = criteria(record, **options)
    box = box_of(record, None, asked.slice.free)
    return record, BoxQuestion(asked, box, (True,) * len(box.names))


def lot(frame, count=200, share=0.06):
    low, high = np.array(frame.box.low)[:, None], np.array(frame.box.high)[:, None]
    size = share * (high - low) * RNG.uniform(0.2, 1.0, size=(len(low), count))
    start = low + RNG.uniform(size=size.shape) * (high - low - size)
    return Boxes(start, start + size)


def reached_share(record, frame, boxes):
    """Share (N,) of samples of each box at which every margin allows the mode."""
    points = boxes.low[..., None] + RNG.uniform(size=(*boxes.low.shape, SAMPLES)) * (boxes.high - boxes.low)[..., None]
    fields = closed_form_fields(record, record.modes.default_working, None, frame.criteria.slice)[0]
    reached = np.ones(points.shape[1:], dtype=bool)
    for name in frame.criteria.margins:
        reached &= np.broadcast_to(fields[name](tuple(points)), reached.shape) >= 0
    return np.mean(reached, axis=1)


@pytest.mark.parametrize("name", ["zeng2019", "fivebar", "orthoglide", "delta_4s", "planar_3rrr", "three_upu"])
def test_sampled_shares_lie_within_the_bounds(name):
    record, frame = question(name)
    boxes = lot(frame)
    found, share = judged(frame, boxes), reached_share(record, frame, boxes)
    assert np.all(share[found.inside] == 1.0)
    assert np.all(share[found.outside] == 0.0)
    assert np.sum(found.inside) > 5
    least, most = found.least / boxes.sizes.high, found.most / boxes.sizes.low
    assert np.all((least >= 0) & (least <= most) & (most <= 1 + 1e-9))
    wrong = 5 * np.sqrt(share * (1 - share) / SAMPLES) + 6 / SAMPLES
    assert np.all((least - wrong <= share) & (share <= most + wrong))
    parts = (least > 0) & (most < 1)
    assert np.sum(parts & (most - least < 0.5)) > 3


def test_without_shares_only_whole_boxes_are_told():
    _, frame = question("fivebar")
    boxes = lot(frame)
    one, two = judged(frame, boxes), judged(frame, boxes, shares=False)
    np.testing.assert_array_equal(one.inside, two.inside)
    np.testing.assert_array_equal(one.outside, two.outside)
    np.testing.assert_array_equal(two.least > 0, two.inside)


def test_blocks_change_nothing(monkeypatch):
    _, frame = question("orthoglide")
    boxes = lot(frame)
    whole = judged(frame, boxes)
    monkeypatch.setattr(planes, "BLOCK", 7)
    parts = judged(frame, boxes)
    for name in ("inside", "outside", "least", "most", "axis"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(parts, name))
    np.testing.assert_array_equal(joined([whole, parts]).least, np.concatenate([whole.least, whole.least]))


def test_no_boxes_no_answers():
    _, frame = question("fivebar")
    assert len(judged(frame, lot(frame)[:0]).inside) == 0


def test_where_the_formulas_divide_by_zero_no_box_is_inside_but_its_volume_is_known():
    """The five-bar with its free end at the first motor, which it reaches with two arms of one length."""
    record = assur.load("fivebar")
    asked = criteria(record)
    frame = BoxQuestion(asked, box_of(record, None), (True, True))
    low = np.array(frame.box.low)[:, None]
    grid = Boxes(low, np.array(frame.box.high)[:, None]).divided([60, 60])
    found = asked.over(grid.intervals)
    zero = ~np.all([found[name].nonzero for name in asked.regular], axis=0)
    free = np.all([found[name].positive for name in asked.margins], axis=0)
    assert not np.any(judged(frame, grid).inside[zero])
    chosen = grid[zero & free]
    if len(chosen):
        known = judged(frame, chosen)
        np.testing.assert_allclose(known.least, chosen.sizes.middle, rtol=1e-9)


@pytest.mark.parametrize("mutation", ["sign", "undefined"])
def test_a_wrong_sign_and_what_is_undefined_taken_for_inside_are_noticed(monkeypatch, mutation):
    true = Criteria.over

    def wrong(self, box):
        found = true(self, box)
        if mutation == "sign":
            return {name: -value for name, value in found.items()}
        # a margin forgotten: what lies below a root counts as allowed, and only the root of max(x, 0) is left
        return {name: abs(value) + 1.0 if name == "n_alpha" else value for name, value in found.items()}

    monkeypatch.setattr(Criteria, "over", wrong)
    with pytest.raises(AssertionError):
        test_sampled_shares_lie_within_the_bounds("zeng2019")


def made_up(margin):
    """Criteria over x of one margin, with a frame from -1 to 1."""
    recorder = Recorder()
    x = recorder.varying("x")
    tape = recorder.tape({"m": margin(x)})
    asked = Criteria(Slice(("x",), ("x",), {}), tape, (), ("m",), (), (), (), {})
    return BoxQuestion(asked, Box(("x",), (-1.0,), (1.0,)), (True,))


def test_a_margin_that_is_not_defined_somewhere_is_not_taken_for_inside():
    """1 / x^2 is nowhere negative, but has no value at zero."""
    boxes = Boxes(np.array([[-1.0, -1.0, 0.5]]), np.array([[1.0, 0.0, 1.0]]))
    found = judged(made_up(lambda x: 1 / (x * x)), boxes)
    assert found.inside.tolist() == [False, False, True]
    assert not found.outside.any()
    assert found.least[0] == found.least[1] == 0.0


def test_where_a_margin_has_a_value_it_is_negative_so_that_nothing_is_reached():
    boxes = Boxes(np.array([[-1.0, 0.5]]), np.array([[1.0, 1.0]]))
    assert judged(made_up(lambda x: -1 / (x * x)), boxes).outside.tolist() == [True, True]
