"""All joint types."""

from __future__ import annotations

from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.helical import HELICAL
from assur.joints.joint_type import JointType
from assur.joints.planar import PLANAR
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL

JOINT_TYPES: dict[str, JointType] = {
    joint_type.name: joint_type
    for joint_type in (REVOLUTE, PRISMATIC, HELICAL, CYLINDRICAL, UNIVERSAL, SPHERICAL, PLANAR)
}
"""By the names that files write."""

BY_LETTER: dict[str, JointType] = {joint_type.letter: joint_type for joint_type in JOINT_TYPES.values()}
"""By the letters of notations."""
