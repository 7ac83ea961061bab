"""The revolute joint: a turn about an axis."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import TURN

REVOLUTE = JointType("revolute", "R", ("rotation",), (TURN,), 1)
