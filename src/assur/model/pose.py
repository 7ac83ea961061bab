"""Coordinates of a pose: what their names mean, and how fast they can change.

Lengths x, y, z are those of the platform's point. Angles turn the platform by Rz(phi) Ry(theta) Rx(psi) from
the base's frame, with theta from -90 to 90 deg; a pose that leaves one out says nothing about it. A unit
quaternion qw, qx, qy, qz says the whole orientation, q and -q the same one.
"""

from __future__ import annotations

LENGTHS = ("x", "y", "z")
ANGLES = ("phi", "theta", "psi")
QUATERNION = ("qw", "qx", "qy", "qz")

Pose = tuple[str, ...]


def is_angle(name: str) -> bool:
    """Whether a coordinate is an angle, in rad inside."""
    return name in ANGLES


def kind_of(name: str) -> str:
    """What a coordinate is: "length", "angle", or "" of a number.

    >>> kind_of("x"), kind_of("phi"), kind_of("qw")
    ('length', 'angle', '')
    """
    return "length" if name in LENGTHS else "angle" if is_angle(name) else ""


def has_quaternion(pose: Pose) -> bool:
    """Whether a pose says its orientation by a unit quaternion."""
    return QUATERNION[0] in pose


def rate_names(pose: Pose) -> Pose:
    """Names of the velocity's components: the coordinates themselves, but wx, wy, wz for a quaternion.

    >>> rate_names(("x", "y", "phi"))
    ('x', 'y', 'phi')
    >>> rate_names(("x", "y", "z", "qw", "qx", "qy", "qz"))
    ('x', 'y', 'z', 'wx', 'wy', 'wz')
    """
    kept = tuple(name for name in pose if name not in QUATERNION)
    return (*kept, "wx", "wy", "wz") if has_quaternion(pose) else kept
