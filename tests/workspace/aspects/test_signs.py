"""Signs over boxes against the closed form at points inside them."""

import numpy as np
import pytest

from assur.kinematics.position import inverse
from assur.model.registry import load_record
from assur.workspace.aspects.signs import factor_signs
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.criteria import Criteria, criteria
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.domain import box_of


@pytest.mark.parametrize(("name", "size"), [("zeng2019", 12.0), ("fivebar", 8.0), ("planar_3rpr", 0.2)])
def test_no_pose_of_a_box_has_another_sign(name, size):
    record = load_record(name)
    asked = criteria(record, factors=("parallel", "serial"))
    box, rng = box_of(record, None, asked.slice.free), np.random.default_rng(5)
    frame = BoxQuestion(asked, box, (True,) * len(box.names))
    middles = box.spread(300, rng).T
    boxes = Boxes(middles - size / 2, middles + size / 2)
    signs = factor_signs(frame, boxes)
    known = 0
    for _ in range(8):
        points = boxes.low + rng.random(middles.shape) * (boxes.high - boxes.low)
        found = inverse(record, asked.slice.poses(points.T), record.modes.default_working)
        for k, factor in enumerate(asked.names):
            there = found.exists[:, 0]
            value = np.sign(found.factors[factor][there, 0])
            assert np.all((signs[there, k] == 0) | (signs[there, k] == value))
            known += int(np.sum(signs[there, k] != 0))
    assert known > 500


def test_a_box_across_a_singularity_has_no_sign():
    record = load_record("zeng2019")
    frame = BoxQuestion(criteria(record, factors=("parallel",)), box_of(record, None), (True, False, True))
    across = Boxes(np.array([[-90.0], [200.0]]), np.array([[-80.0], [220.0]]))
    above = Boxes(np.array([[-90.0], [250.0]]), np.array([[-80.0], [260.0]]))
    w = frame.criteria.names.index("w")
    assert (factor_signs(frame, across)[0, w], factor_signs(frame, above)[0, w]) == (0, 1)


def test_slopes_are_asked_only_where_bounds_do_not_tell(monkeypatch):
    record = load_record("zeng2019")
    frame = BoxQuestion(criteria(record, factors=("parallel",)), box_of(record, None), (True, False, True))
    boxes = Boxes(np.array([[-90.0, -90.0], [200.0, 250.0]]), np.array([[-80.0, -80.0], [220.0, 260.0]]))
    asked, own = [], Criteria.sloped

    def counted(criteria, box, middles):
        asked.append(len(box[0].low))
        return own(criteria, box, middles)

    monkeypatch.setattr(Criteria, "sloped", counted)
    signs = factor_signs(frame, boxes)
    assert asked == [int(np.sum(np.any(signs == 0, axis=1)))] == [1]
