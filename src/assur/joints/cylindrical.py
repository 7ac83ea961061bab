"""The cylindrical joint: a slide along an axis and a turn about it."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import SLIDE, TURN

CYLINDRICAL = JointType("cylindrical", "C", ("translation", "rotation"), (SLIDE, TURN), 1, "СϹ", (2.6, 1.9))
