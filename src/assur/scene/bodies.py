"""Bodies: what a link is as a solid: its parts fused, free of the pins, balls and rods that run in it; pins apart.

All shapes are convex, so that a fused link is a union of convex solids less a union of convex solids. Kernels of two
kinds make it: triangles here (`solid`), exact surfaces in `assur.export.cad.step`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from manifold3d import Manifold, OpType
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.scene.companion import Companion
from assur.scene.companion import companion as companion_of
from assur.scene.part import Part
from assur.scene.parts import machine, unit
from assur.scene.shapes import Ball, Cuboid, Cylinder, Shape
from assur.scene.skeleton import Skeleton, skeleton

FloatArray = NDArray[np.float64]
PLAY = 0.06
"""Play of what runs in something else, in units of `unit`, on every side."""

CHIP = 0.02
"""Pieces that are smaller than this share of a link's largest are chips."""


@dataclass(frozen=True, eq=False)
class LinkBody:
    """One link as it would be made, in its own frame and the mechanism's unit.

    Attributes:
        link: its name.
        fused: the parts that are one piece where they touch.
        bores: shapes that are taken away from it: its own pins, and what of its neighbours runs in it, with play.
        pins: parts that are put in, each a piece of its own.
    """

    link: str
    fused: tuple[Part, ...]
    bores: tuple[Shape, ...]
    pins: tuple[Part, ...]


def home_skeleton(record: MechanismRecord, names: Companion | None = None) -> Skeleton:
    """The skeleton at home."""
    return skeleton(record, names or companion_of(record), home_values(record))


def bodies(record: MechanismRecord) -> tuple[LinkBody, ...]:
    """Every link that has parts, in the file's order.

    >>> from assur.model.registry import load_record
    >>> [(item.link, len(item.fused), len(item.pins)) for item in bodies(load_record("fivebar"))][1]
    ('crank1', 1, 1)
    """
    names = companion_of(record)
    drawn = home_skeleton(record, names)
    made = machine(record)
    collected = []
    for link in record.links:
        of_link = [part for part in made if part.link == link]
        if of_link:
            pins = tuple(part for part in of_link if part.role == "pin")
            inside = [_seen_from(drawn, part, link) for part in made if runs_in(record, part, link)]
            bores = (*(pin.shape for pin in pins), *(grown(shape, PLAY * unit(drawn)) for shape in inside))
            collected.append(LinkBody(link, tuple(part for part in of_link if part.role != "pin"), bores, pins))
    return tuple(collected)


def runs_in(record: MechanismRecord, part: Part, link: str) -> bool:
    """Whether a part of another link turns or slides in a link."""
    if part.role == "rail":  # a slider's joint is not told: it may share its rail with others
        pairs = [{joint.parent, joint.child} for joint in record.joints.values() if joint.type.carries]
        return {part.link, link} in pairs
    joint = record.joints.get(part.joint)
    inside = part.role in ("pin", "ball", "rod")
    return inside and joint is not None and link != part.link and link in (joint.parent, joint.child)


def grown(shape: Shape, play: float) -> Shape:
    """The shape with play on every side.

    >>> grown(Ball(np.zeros(3), 1.0), 0.25).radius
    1.25
    """
    if isinstance(shape, Ball):
        return replace(shape, radius=shape.radius + play)
    if isinstance(shape, Cylinder):
        way = shape.end - shape.start
        way = play * way / max(float(np.linalg.norm(way)), 1e-300)
        return Cylinder(shape.start - way, shape.end + way, shape.radius + play)
    if isinstance(shape, Cuboid):
        size = np.linalg.norm(shape.sides, axis=1, keepdims=True)
        return Cuboid(shape.centre, shape.sides * (1 + play / size))
    raise UsageError(f"grown: no play is known for a {shape.kind}; there is: ball, cylinder, box")


def _seen_from(skeleton: Skeleton, part: Part, link: str) -> Shape:
    """A part's shape in the frame of another link, as both stand at home."""
    placed = part.shape.moved(*skeleton.frames[part.link])
    rotation, origin = skeleton.frames[link]
    return placed.moved(rotation.T, -rotation.T @ origin)


def solid(shape: Shape) -> Manifold:
    """A shape as a closed triangle mesh.

    >>> round(solid(Cuboid(np.zeros(3), np.eye(3))).volume(), 9)
    8.0
    """
    return Manifold.hull_points(corners(shape))


def corners(shape: Shape) -> FloatArray:
    """Corners (k, 3) of which the shape is the convex hull, each as often as triangles meet there."""
    return np.ascontiguousarray(shape.mesh("#000000").corners.reshape(-1, 3))


def fused(body: LinkBody) -> Manifold:
    """The link as one manifold, without chips that its bores cut off; empty where it has nothing but pins."""
    whole = Manifold.batch_boolean([solid(part.shape) for part in body.fused], OpType.Add)
    if not body.bores:
        return whole
    for bore in body.bores:
        whole = whole - solid(bore)
        whole.num_tri()  # worked out before the next: bores that are joined first are not quite as wide as their pins
    pieces = whole.decompose()
    most = max((piece.volume() for piece in pieces), default=0.0)
    return Manifold.compose([piece for piece in pieces if piece.volume() > CHIP * most])
