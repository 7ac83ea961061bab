"""Shapes of which parts are made: cylinders, balls, boxes, flat bars and slabs. Plain data in one frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from assur.scene import mesh
from assur.scene.mesh import Mesh

FloatArray = NDArray[np.float64]


class _Solid:
    """What every shape can do; `points` are moved as points, `ways` are turned only."""

    kind: ClassVar[str]
    points: ClassVar[tuple[str, ...]] = ()
    ways: ClassVar[tuple[str, ...]] = ()

    def moved(self, rotation: FloatArray, origin: FloatArray) -> Any:
        """The same shape where the frame that it is given in has an orientation (3, 3) and an origin (3,)."""
        turned = {name: getattr(self, name) @ rotation.T for name in self.ways}
        return type(self)(
            **{**vars(self), **{n: getattr(self, n) @ rotation.T + origin for n in self.points}, **turned}
        )

    def scaled(self, factor: float) -> Any:
        """The same shape in another unit: all its lengths times a factor."""
        fixed = [name for name in self.ways if name == "normal"]
        return type(self)(**{name: value if name in fixed else value * factor for name, value in vars(self).items()})

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

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        return mesh.cylinder(self.start, self.end, self.radius, colour)


@dataclass(frozen=True, eq=False)
class Ball(_Solid):
    """A ball about a centre (3,)."""

    centre: FloatArray
    radius: float
    kind = "ball"
    points = ("centre",)

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        return mesh.ball(self.centre, self.radius, colour)


@dataclass(frozen=True, eq=False)
class Box(_Solid):
    """A box by its centre (3,) and its three half sides (3, 3) as rows, at right angles to one another."""

    centre: FloatArray
    sides: FloatArray
    kind = "box"
    points = ("centre",)
    ways = ("sides",)

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        return mesh.box(self.centre, self.sides, colour)


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

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        return mesh.bar(self.start, self.end, self.normal, self.radius, self.thickness, colour)


@dataclass(frozen=True, eq=False)
class Slab(_Solid):
    """A convex plane outline (k, 3), counter-clockwise seen against `along` (3,), extruded along that vector."""

    outline: FloatArray
    along: FloatArray
    kind = "slab"
    points = ("outline",)
    ways = ("along",)

    def mesh(self, colour: str) -> Mesh:
        """Triangles in a colour "#rrggbb"."""
        return mesh.slab(self.outline, self.along, colour)


Shape: TypeAlias = Cylinder | Ball | Box | Bar | Slab
