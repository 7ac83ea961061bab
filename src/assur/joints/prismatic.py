"""The prismatic joint: a slide along an axis."""

from __future__ import annotations

from assur.joints.joint_type import JointType
from assur.joints.steps import SLIDE

PRISMATIC = JointType("prismatic", "P", ("translation",), (SLIDE,), 1, "РΡ", (2.6, 1.9))
