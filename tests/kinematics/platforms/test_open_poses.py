"""What a pose leaves open, with one limb as a single loop: all poses, also those in which no point is elsewhere."""

import numpy as np

from assur.kinematics.limbs.networks import limbs_of
from assur.kinematics.limbs.serial import composed, displacement
from assur.kinematics.platforms.open_poses import open_limb, poses_by_limb
from assur.model.registry import load_record

LEG = """
format = 1
name = "leg"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "plate", point = [20, 10, 30], pose = ["x", "y", "z", "theta", "psi"] }
[links]
base = {}
tube = {}
rod = {}
plate = {}
[joints]
A = { type = "universal", parent = "base", child = "tube", axes = ["x", "y"] }
B = { type = "prismatic", parent = "tube", child = "rod", axis = "z" }
C = { type = "universal", parent = "rod", child = "plate", at = [0, 0, 200], axes = ["x", "y"] }
[inputs]
"A.first" = { name = "a" }
"A.second" = { name = "b" }
B = { name = "q" }
"C.first" = { name = "c" }
"C.second" = { name = "d" }
[home]
A = [5, 7]
B = 50
C = [3, 9]
"""


def test_a_leg_of_two_universal_joints_leaves_two_turns(tmp_path):
    """The condition that it says, (d . d)(x . y') = (d . x)(d . y'), is solved along the turn that is open."""
    path = tmp_path / "leg.toml"
    path.write_text(LEG)
    record = load_record(path)
    pose = np.array([40.0, -30.0, 260.0, 0.2, -0.1])
    own = open_limb(record, pose)

    def said(phi):
        rotation, place = composed(displacement(own.motions[0], np.asarray(phi)), own.zero)
        return (place @ place) * rotation[0, 1] - place[0] * (place @ rotation[:, 1])

    found = poses_by_limb(record, pose, limbs_of(record))
    angles = sorted(float(np.arctan2(rotation[1, 0], rotation[0, 0])) for rotation, _ in found.frames)
    grid = np.linspace(-np.pi, np.pi, 721) + 1e-4
    values = np.array([said(phi) for phi in grid])
    crossings = grid[:-1][np.sign(values[:-1]) != np.sign(values[1:])]
    assert found.sure
    assert len(angles) == len(crossings) == 2
    assert all(0.0 <= angle - start < grid[1] - grid[0] for angle, start in zip(angles, crossings, strict=True))
    for rotation, place in found.frames:
        assert np.allclose(place + rotation @ record.platform.point, pose[:3])
