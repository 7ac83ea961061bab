"""Redundant inputs: a four-bar whose crank and rocker are both driven, the rocker following the crank."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.answers.answer import answer
from assur.kinematics.status import Status
from assur.model.file.reader import read_text
from assur.singularity.verdict import verdict_at

CRANK, COUPLER, ROCKER, GROUND = 60.0, 80.0, 40.0, 100.0
FOUR_BAR = f"""format = 1
name = "four"
unit = "mm"
angle = "rad"
base = "ground"
platform = {{ link = "rod", point = [0, 0, 0], pose = ["phi"] }}
[links]
ground = {{}}
arm = {{}}
coupler = {{}}
rod = {{}}
[joints]
A = {{ type = "revolute", parent = "ground", child = "arm", axis = "z" }}
B = {{ type = "revolute", parent = "arm", child = "coupler", at = [{CRANK}, 0, 0], axis = "z" }}
C = {{ type = "revolute", parent = "coupler", child = "rod", at = [80, 0, 0], child_at = [40,0,0], axis = "z" }}
D = {{ type = "revolute", parent = "ground", child = "rod", at = [{GROUND}, 0, 0], axis = "z" }}
[inputs]
A = {{ name = "q" }}
D = {{ name = "p" }}
[home]
A = 1.57
B = -1.94
C = 2.64
D = 2.26
"""  # fmt: skip


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    path = tmp_path_factory.mktemp("four") / "four.toml"
    path.write_text(FOUR_BAR)
    return assur.load(path)


def rocker_angles(crank: float) -> list[float]:
    """By the triangle of coupler and rocker over the line from B to D."""
    tip = CRANK * np.array([np.cos(crank), np.sin(crank)])
    line = tip - [GROUND, 0.0]
    size = np.hypot(*line)
    half = np.arccos((size**2 + ROCKER**2 - COUPLER**2) / (2 * size * ROCKER))
    return [np.arctan2(line[1], line[0]) + sense * half for sense in (-1, 1)]


def apart(angle: float, other: float) -> float:
    """How far two angles are apart, but for whole turns."""
    return abs(np.angle(np.exp(1j * (angle - other))))


def test_the_first_input_determines_it_and_the_other_follows(four_bar):
    assert [item.name for item in four_bar.inputs] == ["q"]
    assert [item.name for item in four_bar.redundant_inputs] == ["p"]
    answers = list(four_bar.direct([1.2]))
    for angle in rocker_angles(1.2):
        assert min(apart(item.inputs[1], angle) for item in answers) < 1e-9


def test_with_both_given_only_the_poses_that_agree_are_answers(four_bar):
    for angle in rocker_angles(1.2):
        answers = four_bar.direct([1.2, angle])
        assert [apart(item.pose[0], angle) < 1e-9 for item in answers] == [True]
        assert answers.complete
        assert "1 of 2 poses at the other inputs agree with p" in answers.right
        assert answer(answers).home_by
    none = four_bar.direct({"q": 1.2, "p": 0.3})
    assert (len(none), int(none.overall_status)) == (0, Status.unreachable)
    assert "0 of 2 poses at the other inputs agree with p, the nearest by" in none.right


def test_a_batch_with_both_given(four_bar):
    cranks = np.array([0.5, 1.0, 1.2])
    inputs = np.array([[crank, rocker_angles(crank)[0]] for crank in cranks])
    answers = four_bar.direct(inputs)
    assert np.sum(answers.exists, axis=-1).tolist() == [1, 1, 1]
    assert answers.inputs.shape[-1] == 1
    with pytest.raises(UsageError, match="3 values, 2 wanted"):
        four_bar.direct([0.1, 0.2, 0.3])


def test_the_inverse_has_both(four_bar):
    for item in four_bar.inverse([1.2]):
        assert item.inputs[1] == pytest.approx(1.2)
        assert min(apart(item.inputs[1], angle) for angle in rocker_angles(item.inputs[0])) < 1e-9


def test_where_the_crank_alone_does_not_hold_it_the_rocker_does(four_bar):
    """Coupler and rocker in line: the crank at rest leaves the rocker free to first order, which is a drive itself."""
    reach = COUPLER + ROCKER
    crank = np.arccos((CRANK**2 + GROUND**2 - reach**2) / (2 * CRANK * GROUND))
    (rocker, same), tip = rocker_angles(crank), CRANK * np.array([np.cos(crank), np.sin(crank)])
    assert rocker == pytest.approx(same, abs=1e-6)
    coupler = np.arctan2(-tip[1], GROUND - tip[0])
    joints = np.array([crank, coupler - crank, rocker - coupler, rocker])
    assert verdict_at(four_bar.determined, joints).kind == "parallel"
    assert verdict_at(four_bar, joints).kind == "regular"


def test_a_form_beside_it_is_refused(four_bar):
    (four_bar.file.parent / "closed_form.py").write_text("")
    try:
        with pytest.raises(UsageError, match="and p would be redundant"):
            assur.load(four_bar.file)
    finally:
        (four_bar.file.parent / "closed_form.py").unlink()


def test_as_many_first_inputs_as_the_pose_has_rates(tmp_path):
    record = read_text(FOUR_BAR, tmp_path / "four.toml")
    assert [item.name for item in record.drives] == ["q", "p"]
    assert record.determined.drives == record.inputs
