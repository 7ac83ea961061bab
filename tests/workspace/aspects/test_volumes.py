"""Volumes of aspects against the share of spread poses."""

import numpy as np

from assur.kinematics.position import inverse
from assur.model.registry import load_record
from assur.workspace.aspects import volumes as module
from assur.workspace.aspects.search import search
from assur.workspace.aspects.volumes import volumes
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.domain import box_of


def test_bounds_hold_the_share_of_random_poses():
    record = load_record("zeng2019")
    asked = criteria(record, factors=("parallel", "serial")).nonsingular
    box = box_of(record, None, asked.slice.free)
    found = search(BoxQuestion(asked, box, asked.used), {"x": 2.0, "y": 1e9, "z": 2.0})
    bounds = volumes(found)
    points = box.spread(40_000, np.random.default_rng(3))
    answer = inverse(record, points, record.modes.default_working)
    there = answer.exists[:, 0]
    signs = np.stack([np.sign(answer.factors[name][:, 0]) for name in asked.names], axis=-1)
    area = (box.high[0] - box.low[0]) * (box.high[2] - box.low[2])
    assert len(bounds) == 4
    for row, (low, high) in zip(found.links.signs, bounds, strict=True):
        share = float(np.mean(there & np.all(signs == row, axis=-1)))
        error = 4 * np.sqrt(share / len(points))
        assert low < (share + error) * area
        assert (share - error) * area < high
        assert 0 < low < high < 1.4 * low


def test_parts_that_may_be_one_share_the_upper_bound(monkeypatch):
    record = load_record("planar_3rpr")
    asked = criteria(record, factors=("parallel", "serial")).nonsingular
    monkeypatch.setattr("assur.workspace.aspects.search.ROUNDS", 0)
    found = search(
        BoxQuestion(asked, box_of(record, {"phi": (0.0, 1.2)}), asked.used), {"x": 2.5, "y": 2.5, "phi": 0.15}
    )
    bounds = volumes(found)
    for k in range(len(bounds)):
        for other in np.flatnonzero(found.links.group == found.links.group[k]):
            assert bounds[k][1] >= bounds[k][0] + (bounds[other][0] if other != k else 0.0)


def test_what_is_undecided_is_looked_at_once_for_all_aspects(monkeypatch):
    record = load_record("zeng2019")
    asked = criteria(record, factors=("parallel", "serial")).nonsingular
    found = search(
        BoxQuestion(asked, box_of(record, None, asked.slice.free), asked.used), {"x": 4.0, "y": 1e9, "z": 4.0}
    )
    looked, own = [], module.judged

    def counted(frame, boxes):
        looked.append(len(boxes))
        return own(frame, boxes)

    monkeypatch.setattr(module, "judged", counted)
    volumes(found)
    by_group = sum(len(rows) for rows in found.links.reached)
    assert sum(looked) == len(np.unique(np.concatenate(found.links.reached))) < by_group
