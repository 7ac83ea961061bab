import numpy as np
import pytest

from assur.errors import UnknownNameError
from assur.synthesis.required import MOTIONS, motion_named


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_a_motion_is_what_its_name_says(motion):
    count = {letter: int(number) for number, letter in zip(motion.name[::2], motion.name[1::2], strict=True)}
    assert (len(motion.translations), len(motion.rotations)) == (count.get("T", 0), count.get("R", 0))
    assert np.linalg.matrix_rank(motion.twists) == motion.dim
    assert np.linalg.matrix_rank(motion.twists[:3]) == len(motion.rotations)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_its_twists_are_the_same_at_every_point(motion):
    """v at a point p is v + omega x p: the space must not change, as nothing says where the platform's O' is."""
    twists = motion.twists
    moved = np.concatenate([twists[:3], twists[3:] + np.cross(twists[:3], [[0.3], [-2.0], [0.7]], axis=0)])
    assert np.linalg.matrix_rank(np.concatenate([twists, moved], axis=1)) == motion.dim


def test_a_platform_that_turns_in_every_way_takes_general_orientations():
    found = MOTIONS["3T3R"].orientations(np.array([0.3, -1.0, 0.5]))
    assert np.linalg.det(found) == pytest.approx(1)
    assert not np.any(np.isclose(found[:, [0, 1, 2], [0, 1, 2]], 1))


@pytest.mark.parametrize("name", [name for name, motion in MOTIONS.items() if len(motion.rotations) < 2])
def test_orientations_turn_about_its_rotation_only(name):
    motion = MOTIONS[name]
    found = motion.orientations(np.array([0.3, -1.0]))
    angles = np.arccos((np.trace(found, axis1=1, axis2=2) - 1) / 2)
    assert angles == pytest.approx([0.3, 1.0] if motion.rotations else [0.0, 0.0])
    for axis in motion.rotations:
        assert found @ axis == pytest.approx(np.array([axis, axis]))


def test_names_are_found_in_any_case_and_others_refused():
    assert motion_named(" 3t ") is MOTIONS["3T"]
    with pytest.raises(UnknownNameError, match="unknown motion '4T'; there is: 2T1R, 3T, 3T1R, 3T3R"):
        motion_named("4T")
