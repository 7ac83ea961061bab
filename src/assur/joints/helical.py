"""The helical joint: a turn about an axis that advances by its pitch."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import SCREW

HELICAL = JointType("helical", "H", ("rotation",), (SCREW,), 1, "НΗ")
