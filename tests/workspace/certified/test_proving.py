"""Boxes that are asked: proofs, poses that fail, and what stays undecided, against the inverse problem."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.workspace.certified.proving import prove_box

RNG = np.random.default_rng(12)
ZENG, DELTA = assur.load("zeng2019"), assur.load("delta_4s")


def sampled(record, found, count=2000):
    low, high = np.array(found.box.low), np.array(found.box.high)
    poses = low + RNG.uniform(size=(count, len(low))) * (high - low)
    return record.inverse(poses, found.mode)


def factors_of(record, kinds):
    return [item.name for item in record.closed_form.factor_list if item.kind in kinds]


@pytest.mark.parametrize(
    ("record", "box"),
    [(ZENG, [(-40, 0), (-50, 50), (380, 400)]), (DELTA, [(-0.1, 0.1), (-0.1, 0.1), (-1.1, -0.9)])],
    ids=["zeng2019", "delta_4s"],
)
def test_in_a_box_that_is_proved_no_factor_changes_its_sign(record, box):
    found = prove_box(record, box)
    assert (found.status, found.share, found.witness, len(found.doubtful)) == ("proved", 1.0, None, 0)
    answer = sampled(record, found)
    assert np.all(answer.exists[:, 0])
    for name in factors_of(record, ("parallel", "serial")):
        signs = np.sign(answer.factors[name][:, 0])
        assert len(np.unique(signs)) == 1


def test_a_box_that_leaves_the_reach_has_a_pose_that_is_not_reached():
    found = prove_box(ZENG, {"x": (-40, 0), "y": (-50, 50), "z": (380, 470)}, what=["reached"])
    assert found.status == "refuted"
    pose = [found.witness.pose[name] for name in ("x", "y", "z")]
    assert not ZENG.inverse(pose, "++-++").exists[0]
    assert 0 < found.share < 1
    for boxes, wanted in ((found.proved, True), (found.failed, False)):
        middles = boxes.middles
        poses = np.stack([middles[0], np.zeros(len(boxes)), middles[1]], axis=-1)
        assert np.all(ZENG.inverse(poses, "++-++").exists[:, 0] == wanted)


def test_a_box_with_a_singularity_is_refuted_though_all_of_it_is_reached():
    box = {"x": (-40, 0), "y": (-50, 50), "z": (180, 400)}
    assert prove_box(ZENG, box, what=["reached"]).status == "proved"
    found = prove_box(ZENG, box)
    assert found.status == "refuted"
    assert len(found.failed) == 0
    name = found.witness.why.split()[0]
    here = ZENG.inverse([found.witness.pose[key] for key in ("x", "y", "z")], "++-++").factors[name][0]
    others = sampled(ZENG, found).factors[name][:, 0]
    assert np.any(others * here < 0)


def test_undefined_is_not_proved_and_what_no_sign_tells_is_undecided():
    """With u1 and u2 of one sign the platform moves by itself at every pose: the factor is zero, and no sign tells."""
    found = prove_box(ZENG, [(-40, 0), (-50, 50), (380, 400)], mode="+++++", what=["parallel"])
    assert found.status == "undecided"
    assert len(found.proved) == 0


def test_strokes_count_as_limits():
    box = {"x": (-40, 0), "y": (-50, 50), "z": (380, 400)}
    assert prove_box(ZENG, box, strokes={"yA1": (-50, 50)}).status == "refuted"
    assert prove_box(ZENG, box, strokes={"yA1": (-900, 900)}).status == "proved"


def test_ctrl_c_leaves_the_rest_undecided():
    def interrupt(done, total):
        raise KeyboardInterrupt

    found = prove_box(ZENG, {"x": (-110, 90)}, what=["reached"], progress=interrupt)
    assert found.stopped == "interrupted"
    assert found.status != "proved"


def test_misuse():
    with pytest.raises(UsageError):
        prove_box(ZENG, {"x": (5, 5)})
    with pytest.raises(UnknownNameError):
        prove_box(ZENG, {"q": (5, 6)})
    with pytest.raises(UnknownNameError):
        prove_box(ZENG, what=["safe"])


def high_by(start, floats):
    """An interval so many floats high."""
    end = start
    for _ in range(floats):
        end = float(np.nextafter(end, np.inf))
    return start, end


@pytest.mark.parametrize("floats", [1, 2, 3, 7, 40])
def test_a_box_a_few_floats_high_that_a_surface_crosses_ends_undecided_or_refuted(floats):
    record = ZENG
    singular = 230.0  # w = 0 there: links 9 and 10 lie level
    for start in (singular, float(np.nextafter(singular, 0.0)), 399.3):
        found = prove_box(record, {"x": (-5, 5), "y": (-5, 5), "z": high_by(start, floats)}, most=20_000)
        assert found.status in ("proved", "refuted", "undecided")
        assert 0.0 <= found.share <= 1.0
        assert (found.status == "proved") == (found.share == 1.0)


def test_what_floats_cannot_halve_is_undecided_and_said_to_be():
    record = assur.load("fivebar")
    reach = float(np.sqrt((100 + 194) ** 2 - 70**2))  # crank and rod in line
    box = {"x": high_by(0.0, 3), "y": high_by(reach, 3)}
    found = prove_box(record, box, "-+")
    assert (found.status, found.stopped) == ("undecided", "rounding")
    assert len(found.doubtful) > 0


def test_a_budget_of_boxes_ends_a_proof():
    found = prove_box(ZENG, {"x": (-40, 0), "z": (180, 400)}, finest={"x": 1e-9, "z": 1e-9}, most=5_000)
    assert found.stopped == "too many boxes"
    assert len(found.proved) + len(found.failed) + len(found.doubtful) <= 5_000
    with pytest.raises(UsageError, match="boxes"):
        prove_box(ZENG, most=0)


@pytest.mark.parametrize(
    "command", [("aspects",), ("workspace", "--certify"), ("workspace",), ("certify", "-o", "c.json")]
)
def test_every_question_about_a_box_without_extent_ends(command, tmp_path, monkeypatch):
    from assur.cli.main import main

    monkeypatch.chdir(tmp_path)
    for box in ("x=0:5e-324,y=200:201", "x=0:5e-324,y=285.5450927:285.54509270000004"):
        assert main([command[0], "fivebar", "--mode=-+", "--box", box, *command[1:]]) in (0, 2, 4, 5)
