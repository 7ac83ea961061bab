"""Paths: every piece in its proved box, poses of one aspect joined, those of two refused with what parts them."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects
from assur.workspace.aspects.checking import check_path, covered
from assur.workspace.certified.planes import judged

FIVEBAR = load_record("fivebar")
FOUND = aspects(FIVEBAR, "-+", {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}, finest=9.375)
ZENG = load_record("zeng2019")

CASES = [
    pytest.param("fivebar", "-+", {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}, [0, 285.5], [0, -200], id="about"),
    pytest.param("zeng2019", None, None, [-40, -100, 250], [60, 100, 300], id="zeng2019"),
    pytest.param("zeng2019", None, None, [-40, -100, 250], [-40, 100, 250], id="along y only"),
    pytest.param("linear_delta_4r", None, None, [0, 0, -500], [100, 50, -350], id="delta"),
]


@pytest.mark.parametrize(("name", "mode", "box", "start", "end"), CASES)
def test_a_path_passes_every_check(name, mode, box, start, end):
    record = load_record(name)
    found = aspects(record, mode, box)
    path = found.path(start, end)
    assert (path.status, path.why) == ("connected", "")
    assert path.start.aspect == path.end.aspect == found.aspects[0].label
    assert path.points[0].tolist() == start
    assert path.points[-1].tolist() == end
    assert np.all(judged(found.search.frame, path.boxes, shares=False).inside)
    check = check_path(record, found, path)
    assert check.passed
    assert check.followed
    back = found.path(end, start)
    assert (back.status, len(back.points)) == ("connected", len(path.points))


def test_every_pair_of_poses_of_an_aspect_is_joined():
    rng = np.random.default_rng(4)
    for item in FOUND.aspects:
        chosen = rng.integers(0, len(item.boxes), 6)
        poses = item.boxes.middles[:, chosen].T
        for start, end in itertools.pairwise(poses):
            path = FOUND.path(start, end)
            assert path.status == "connected"
            assert covered(path)
            assert check_path(FIVEBAR, FOUND, path, follow_it=False).passed


def test_one_pose_twice():
    path = FOUND.path([0.0, 200.0], [0.0, 200.0])
    assert (path.status, len(path.points), len(path.boxes)) == ("connected", 2, 1)


def test_other_signs_are_refused_with_the_factor_between():
    inner = FOUND["-"].boxes.middles[:, 0]
    path = FOUND.path([0.0, 200.0], inner)
    assert path.status == "separated"
    told = "sin_rods is positive at one and negative at the other"
    assert path.why == f"{told}: singular or not reached on every way between them"
    assert path.points.shape == (0, 2)


def test_the_same_signs_in_two_aspects_are_refused_too():
    record = load_record("planar_3rpr")
    found = aspects(record, held={"phi": 0.3})
    one, two = (found[label].boxes.middles[:, 0] for label in ("-/1", "-/2"))
    path = found.path(one, two)
    assert path.status == "separated"
    assert path.why == "inside the box only poses that are not reached, or singular, lie between them"


def test_parts_that_are_not_told_apart_are_undecided(monkeypatch):
    monkeypatch.setattr("assur.workspace.aspects.search.ROUNDS", 0)
    found = aspects(load_record("planar_3rpr"), box={"phi": (0.0, 1.2)}, finest={"x": 2.5, "y": 2.5, "phi": 0.15})
    one, two = (found[label].boxes.middles[:, 0] for label in ("+/1", "+/2"))
    path = found.path(one, two)
    assert (path.status, path.why) == ("undecided", "undecided boxes may join the two parts; look with a smaller size")


def test_a_pose_that_is_not_reached_is_named():
    path = FOUND.path([0.0, 200.0], [0.0, 0.0])
    assert path.status == "outside"
    assert path.why.startswith("to: reach")
    assert FOUND.path([0.0, 500.0], [0.0, 200.0]).why.startswith("from: y = 500 is beyond the box")


def test_a_path_moved_out_of_its_boxes_is_noticed():
    path = FOUND.path([0.0, 200.0], [0.0, -200.0])
    points = path.points.copy()
    points[5] += 1e-9 * np.array([1.0, -1.0]) + np.where(path.boxes.high[:, 5] == points[5], 1e-9, 0.0)
    points[5] += path.boxes.high[:, 5] - path.boxes.low[:, 5]
    assert covered(path)
    assert not covered(replace(path, points=points))
