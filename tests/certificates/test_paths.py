import json
from dataclasses import replace

import numpy as np
import pytest

from assur.certificates import leaves
from assur.certificates.paths import covering, path_certificate
from assur.errors import UsageError
from assur.kinematics.position import inverse
from assur.verifier.check import verify
from assur.verifier.reading import RefusedError
from assur.workspace.certified.boxes import Boxes

PATHS = ("path", "path in one box", "path, angle held")


def numbers(value):
    return float.fromhex(value) if isinstance(value, str) else [numbers(item) for item in value]


@pytest.mark.parametrize("case", PATHS)
def test_it_states_the_path_as_it_was_found(case, made_of, path_of):
    _, found, path = path_of(case)
    statement = made_of(case).statement
    assert numbers(statement["points"]) == path.points.tolist()
    assert numbers([statement["from"], statement["to"]]) == path.points[[0, -1]].tolist()
    keep = [path.coordinates.index(name) for name in path.names]
    boxes = np.array(numbers(statement["boxes"]))
    assert boxes[:, keep, 0].T.tolist() == path.boxes.low.tolist()
    assert boxes[:, keep, 1].T.tolist() == path.boxes.high.tolist()
    assert statement["held"].keys() == found.slice.held.keys()
    assert statement["mode"] == found.mode


@pytest.mark.parametrize("case", PATHS)
def test_every_pose_of_its_boxes_is_reached_and_no_factor_changes_its_sign(case, made_of, path_of):
    """The closed form, without intervals, at random poses of the boxes."""
    record, found, _ = path_of(case)
    statement = made_of(case).statement
    boxes = np.array(numbers(statement["boxes"]))
    rng = np.random.default_rng(4)
    points = np.concatenate([rng.uniform(box[:, 0], box[:, 1], (40, len(box))) for box in boxes])
    answer = inverse(record, found.slice.poses(points), found.mode)
    assert answer.exists.any(axis=-1).all()
    for name, _ in made_of(case).program["factors"]:
        values = answer.factors[name][answer.exists]
        assert np.all(values > 0) or np.all(values < 0)


def test_a_wide_box_is_halved_until_it_is_proved(made_of):
    found = made_of("path in one box")
    assert len(found.statement["boxes"]) == 1
    assert found.claims["leaves"]["regular"] > 10
    assert found.claims["regular"] == "yes"


def one_box(path):
    low, high = path.boxes.low.min(axis=1), path.boxes.high.max(axis=1)
    return replace(path, points=path.points[[0, -1]], boxes=Boxes(low[:, None], high[:, None]))


def test_a_box_with_a_singularity_is_not_proved_and_the_verifier_refuses_it(path_of):
    """The one box about all of the way holds singular poses; so the search for boxes was needed."""
    record, found, path = path_of("path")
    made = path_certificate(record, found, one_box(path), most=300)
    assert made.claims["regular"] != "yes"
    with pytest.raises(RefusedError, match="not every box of the path"):
        verify(made.text.encode())


def test_too_few_leaves_leave_it_open(path_of):
    record, found, path = path_of("path in one box")
    made = path_certificate(record, found, path, most=3)
    assert sum(made.claims["leaves"].values()) == 3
    assert made.claims["regular"] == "open"


def test_leaves_are_counted_over_all_boxes(path_of):
    """Twice there and back: both boxes together have so many leaves, and one more for the second box."""
    record, found, path = path_of("path in one box")
    twice = replace(path, points=path.points[[0, 1, 0]], boxes=path.boxes[np.array([0, 0])])
    made = path_certificate(record, found, twice, most=40)
    assert sum(made.claims["leaves"].values()) <= 41
    whole = path_certificate(record, found, twice)
    assert whole.claims["leaves"]["regular"] == 2 * path_certificate(record, found, path).claims["leaves"]["regular"]


def test_ctrl_c_ends_it_at_once(path_of, monkeypatch):
    """The one box of the path is halved many times; the interrupt is not of that box alone."""
    record, found, path = path_of("path in one box")
    twice = replace(path, points=path.points[[0, 1, 0]], boxes=path.boxes[np.array([0, 0])])
    calls = []

    def interrupted(*_):
        calls.append(1)
        raise KeyboardInterrupt

    monkeypatch.setattr(leaves.Leaves, "axes", interrupted)
    with pytest.raises(KeyboardInterrupt):
        path_certificate(record, found, twice)
    assert len(calls) == 1


def test_no_box_is_flat_and_every_piece_lies_in_its_own(path_of):
    _, found, path = path_of("path")
    flat = replace(path, boxes=Boxes(path.boxes.low, path.boxes.low.copy()))
    boxes = covering(found, flat)
    assert np.all(boxes.low < boxes.high)
    for ends in (path.points[:-1].T, path.points[1:].T):
        assert np.all((boxes.low <= ends) & (ends <= boxes.high))


def test_progress_and_the_same_file_twice(path_of, made_of):
    seen = []
    made = path_certificate(*path_of("path"), progress=lambda *step: seen.append(step))
    assert seen == [(k, 12) for k in range(1, 13)]
    again = made_of("path").to_json()
    document = json.loads(made.text)
    for each in (document, again):  # the exact check draws anew, with other numbers
        del each["exact"], each["sha256"]
    assert document == again
    assert document["kind"] == "path"


def test_without_a_path_there_is_nothing_to_certify(path_of):
    record, found, _ = path_of("path in one box")
    none = found.path([-60.0, 150.0], [1000.0, 0.0])
    with pytest.raises(UsageError, match="no path to certify: to: x = 1000 is beyond the box"):
        path_certificate(record, found, none)
