"""Joint types: what each one is called, how many freedoms it has, and the names of its components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

CoordinateKind = Literal["angle", "length"]


@dataclass(frozen=True)
class JointType:
    """A lower pair. `components` name its coordinates in the order in which they move the child.

    An "angle" is in rad, a "length" in the unit of the mechanism. The three components of a
    spherical joint are the parts of one rotation vector.
    """

    name: str
    letter: str
    components: tuple[str, ...]
    kinds: tuple[CoordinateKind, ...]
    axes: int

    @property
    def freedoms(self) -> int:
        """Number of freedoms f_i of Eq. (3)."""
        return len(self.components)


REVOLUTE = JointType("revolute", "R", ("rotation",), ("angle",), 1)
PRISMATIC = JointType("prismatic", "P", ("translation",), ("length",), 1)
HELICAL = JointType("helical", "H", ("rotation",), ("angle",), 1)
CYLINDRICAL = JointType("cylindrical", "C", ("translation", "rotation"), ("length", "angle"), 1)
UNIVERSAL = JointType("universal", "U", ("first", "second"), ("angle", "angle"), 2)
SPHERICAL = JointType("spherical", "S", ("rx", "ry", "rz"), ("angle", "angle", "angle"), 0)

JOINT_TYPES = {
    joint_type.name: joint_type for joint_type in (REVOLUTE, PRISMATIC, HELICAL, CYLINDRICAL, UNIVERSAL, SPHERICAL)
}
