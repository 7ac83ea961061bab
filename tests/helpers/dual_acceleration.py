"""Acceleration through a closed form's kernels over dual numbers: a second route, without the joint graph."""

import numpy as np

from assur.kinematics import border
from assur.kinematics.closed_form.mode_reading import mode_reading
from assur.kinematics.rates.velocity import velocity_map
from assur.model.pose import QUATERNION, has_quaternion, rate_names
from assur.numerics import rotations
from assur.numerics.dual import Dual, Duals


def dual_acceleration(record, poses, input_rates, input_accelerations, mode=None):
    """Velocity v and acceleration a = Jp^-1 (Jq qddot + Jq' qdot - Jp' v) (N, k) at poses (N, m) of square maps.

    The primes are derivatives along the motion. Not known where Jq is singular: kernels have no derivative at the root
    of zero.
    """
    velocities, poses = velocity_map(record, poses, mode), np.asarray(poses)
    velocity = velocities.output(input_rates)
    moving = coordinate_rates(record, poses, velocity)
    values = border.pose_components(record, poses)
    components = tuple(_moving(value, moving[:, k]) for k, value in enumerate(values))
    signs = np.array([driven.sign for driven in record.inputs])
    jp_rate, jq_rate = (
        np.stack([np.stack([_slope(entry, len(poses)) for entry in row], axis=-1) for row in rows], axis=-2)
        for rows in mode_reading(record, mode, components, Duals()).jacobians
    )
    parts = ((velocities.jq, input_accelerations), (jq_rate * signs, input_rates), (-jp_rate, velocity))
    right = sum(matrix @ np.asarray(rates)[..., None] for matrix, rates in parts)
    return velocity, np.linalg.solve(velocities.jp, right)[..., 0]


def coordinate_rates(record, poses, velocity):
    """Rates (N, m) of the coordinates of poses (N, m) at velocities (N, k): q' = (0, w) q / 2 for a quaternion."""
    pose = record.platform.pose
    named = dict(zip(rate_names(pose), velocity.T, strict=True))
    if has_quaternion(pose):
        quaternion = poses[:, [pose.index(name) for name in QUATERNION]]
        named |= zip(QUATERNION, rotations.quaternion_rates(quaternion, velocity[:, -3:]).T, strict=True)
    return np.stack([named[name] for name in pose], axis=-1)


def _moving(value, rate):
    if isinstance(value, tuple):
        cosine, sine = value
        return (Dual(cosine, -sine * rate), Dual(sine, cosine * rate))
    return Dual(value, rate)


def _slope(entry, count):
    return np.broadcast_to(entry.derivative if isinstance(entry, Dual) else 0.0, (count,))
