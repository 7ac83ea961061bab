"""Layers of forces: arrows of what joints pass and actuators exert at rest, and of the weight of the platform.

An arrow in a joint is what its parent exerts on its child; one that rigid links leave open is dashed. One of an
actuator that turns points along its axis, by the right hand.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.machine.forces.actuator_forces import force_units
from assur.machine.forces.forces_at_rest import ForcesAtRest, forces_at_rest
from assur.machine.masses.link_masses import masses
from assur.model.mechanism import MechanismRecord
from assur.page.turned_meshes import Mesh, joined, turned
from assur.scene.companion import companion
from assur.scene.layers import Layer
from assur.scene.skeleton import JointMark, skeleton

FloatArray = NDArray[np.float64]
REACTION, OPEN, ACTUATOR, WEIGHT = "#d55e00", "#e69f00", "#0072b2", "#555555"
LONGEST, THIN = 0.3, 0.007
"""Of the mechanism's size: the longest arrow of a layer, and the radius of its shaft."""
SMALLEST = 0.02
"""Share of the largest below which there is no arrow."""
ROUNDED = 1e-9
"""In N or N m: what is less is rounding."""
DASHES = 4
HEAD, WIDE = 6.0, 2.4
"""Length and radius of an arrow's head, in radii of its shaft."""


@dataclass(frozen=True, eq=False)
class _Arrow:
    """From a point (3,) along a vector (3,), as long as it is."""

    start: FloatArray
    way: FloatArray


def force_layers(record: MechanismRecord, values: FloatArray, where: str = "at home") -> tuple[Layer, ...]:
    """At joint values (n,), as long as the file says what all links weigh, and something holds the platform.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("tripteron")
    >>> [item.label for item in force_layers(record, home_values(record))][1:]
    ['forces of actuators at home: q1 -0.251 N, q2 -1.18 N, q3 55.5 N', 'weight of the platform: 14.7 N']
    """
    try:
        held = forces_at_rest(record, values)
    except UsageError:  # the file lacks a mass: pictures have no forces then
        return ()
    return tuple(_layers(record, values, held, where)) if held.joints else ()


def _layers(record: MechanismRecord, values: FloatArray, held: ForcesAtRest, where: str) -> Iterator[Layer]:
    drawn = skeleton(record, companion(record), values)
    placed = frames(record, values)
    joints: dict[bool, list[_Arrow]] = {True: [], False: []}
    for item in held.joints:
        rotation, origin = placed[record.joints[item.joint].child]
        start = rotation @ record.joints[item.joint].child_at + origin
        joints[bool(item.unique[:3].all())].append(_Arrow(start, item.force))
    for sure, words, colour in (
        (True, f"forces in joints {where}", REACTION),
        (False, f"forces in joints {where} that rigid links leave open, the least, dashed", OPEN),
    ):
        label = (
            f"{words}: up to {_digits(max((float(np.linalg.norm(item.way)) for item in joints[sure]), default=0.0))} N"
        )
        yield from _layer(label, colour, joints[sure], held.largest, drawn.size, sure)
    marks = {mark.joint.name: mark for mark in drawn.marks}
    units = force_units(record)
    pairs = list(zip(record.drives, held.actuators.tolist(), units, strict=True))
    told = ", ".join(f"{item.name} {_digits(value)} {unit}" for item, value, unit in pairs)
    arrows = []
    for kind in dict.fromkeys(units):
        own = [(item, value) for item, value, unit in pairs if unit == kind]
        most = max(abs(value) for _, value in own) or 1.0
        arrows += [_driving(marks[item.coordinate.joint], item.sign * value / most) for item, value in own]
    yield from _layer(f"forces of actuators {where}: {told}", ACTUATOR, arrows, 1.0, drawn.size)
    body = masses(record).carried(record.platform.link)[record.platform.link]
    weight = body.mass * masses(record).gravity
    rotation, origin = placed[record.platform.link]
    arrow = _Arrow(rotation @ body.centre / METRES[record.unit] + origin, weight)
    size = float(np.linalg.norm(weight))
    words = "weight of the platform" + " and its payload" * (masses(record).payload is not None)
    yield from _layer(f"{words}: {_digits(size)} N", WEIGHT, [arrow], max(held.largest, size), drawn.size)


def _digits(value: float) -> str:
    """Three of them; what is rounding is 0."""
    return f"{value if abs(value) > ROUNDED else 0.0:.3g}"


def _driving(mark: JointMark, share: float) -> _Arrow:
    """Of an actuator, along its joint's axis."""
    return _Arrow(mark.at, share * mark.axes[0])


def _layer(
    label: str, colour: str, arrows: Iterable[_Arrow], largest: float, size: float, solid: bool = True
) -> Iterator[Layer]:
    """Arrows as one layer; none where all are too small to be seen."""
    seen = [arrow for arrow in arrows if np.linalg.norm(arrow.way) > SMALLEST * largest > 0.0]
    if not seen:
        return
    scale, radius = LONGEST * size / largest, THIN * size
    arrow_meshes = [_arrow(arrow.start, scale * arrow.way, radius, solid) for arrow in seen]
    yield Layer("force", label, colour, 1.0, *joined(arrow_meshes))


def _arrow(start: FloatArray, way: FloatArray, radius: float, solid: bool) -> Mesh:
    """Vertices (n, 3) and triangles (k, 3); the shaft in dashes unless `solid`."""
    length = float(np.linalg.norm(way))
    neck = max(length - HEAD * radius, 0.4 * length)
    head = [(neck, 0.0), (neck, WIDE * radius), (length, 0.0)]
    count = 1 if solid else DASHES
    step = neck / (2 * count - 1)  # dashes and gaps are of one length
    shaft = [
        [(2 * k * step, 0.0), (2 * k * step, radius), ((2 * k + 1) * step, radius), ((2 * k + 1) * step, 0.0)]
        for k in range(count)
    ]
    return joined([turned(profile, start, way / length) for profile in (*shaft, head)])
