"""The spherical joint: a turn about any axis; its coordinates are a rotation vector."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import BALL

SPHERICAL = JointType("spherical", "S", ("rx", "ry", "rz"), (BALL,), 0, "Ѕ", (1.4, 1.4))
