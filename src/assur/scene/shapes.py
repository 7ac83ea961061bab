"""Shapes of which parts are made: cylinders, balls, boxes, flat bars and slabs. Plain data in one frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from assur.scene import mesh
from assur.scene.mesh import Mesh

FloatArray = NDArray[np.float64]


class _Solid:
    """What every shape can do. Its fields are the arguments of the function of its kind in `assur.scene.mesh`.

    Attributes:
        kind: its name in plain data, and that of the function.
        points, ways: fields that are moved as points, and that are turned only.
        units: fields of `ways` that have no length.
    """

    kind: ClassVar[str]
    points: ClassVar[tuple[str, ...]] = ()
    ways: ClassVar[tuple[str, ...]] = ()
    units: ClassVar[tuple[str, ...]] = ()

    def moved(self, rotation: FloatArray, origin: FloatArray) -> Self:
        """The same shape where the frame that it is given in has an orientation (3, 3) and an origin (3,)."""
        placed = {name: getattr(self, name) @ rotation.T + origin for name in self.points}
        turned = {name: getattr(self, name) @ rotation.T for name in self.ways}
        return type(self)(**{**vars(self), **placed, **turned})

    def scaled(self, factor: float) -> Self:
        """The same shape in another unit: all its lengths times a factor."""
        return type(self)(
            **{name: value if name in self.units else value * factor for name, value in vars(self).items()}
        )

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        made: Mesh = getattr(mesh, self.kind)(**vars(self), colour=colour)
        return made

    def to_json(self) -> dict[str, Any]:
        """Plain data: its kind and its numbers."""
        numbers = {
            name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in vars(self).items()
        }
        return {"kind": self.kind, **numbers}


@dataclass(frozen=True, eq=False)
class Cylinder(_Solid):
    """A solid cylinder between the middles (3,) of its ends; a ball where they are one.

    >>> Cylinder(np.zeros(3), np.array([0.0, 0, 2]), 0.5).moved(np.eye(3), np.ones(3)).end.tolist()
    [1.0, 1.0, 3.0]
    """

    start: FloatArray
    end: FloatArray
    radius: float
    kind = "cylinder"
    points = ("start", "end")


@dataclass(frozen=True, eq=False)
class Ball(_Solid):
    """A ball about a centre (3,)."""

    centre: FloatArray
    radius: float
    kind = "ball"
    points = ("centre",)


@dataclass(frozen=True, eq=False)
class Cuboid(_Solid):
    """A box by its centre (3,) and its three half sides (3, 3) as rows, at right angles to one another."""

    centre: FloatArray
    sides: FloatArray
    kind = "box"
    points = ("centre",)
    ways = ("sides",)


@dataclass(frozen=True, eq=False)
class Bar(_Solid):
    """A flat bar with round ends about two points (3,), its flat sides normal to a unit vector (3,)."""

    start: FloatArray
    end: FloatArray
    normal: FloatArray
    radius: float
    thickness: float
    kind = "bar"
    points = ("start", "end")
    ways = ("normal",)
    units = ("normal",)


@dataclass(frozen=True, eq=False)
class Slab(_Solid):
    """A convex plane outline (k, 3), counter-clockwise seen against `along` (3,), extruded along that vector."""

    outline: FloatArray
    along: FloatArray
    kind = "slab"
    points = ("outline",)
    ways = ("along",)


Shape: TypeAlias = Cylinder | Ball | Cuboid | Bar | Slab
