"""The universal joint: turns about two axes, the first fixed in the parent, the second in the child."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import TURN

UNIVERSAL = JointType("universal", "U", ("first", "second"), (TURN, TURN.along(1)), 2, room=(3.7, 3.7))
