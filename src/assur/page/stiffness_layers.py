"""Layers of stiffness: the ellipsoid of the platform's displacements, and the slowest vibrations at their largest.

Tubes run along what bends, the thicker the more of the strain energy is in it, and along the edges of what does not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.stiffness import Stiffness, stiffness_at
from assur.model.mechanism import MechanismRecord
from assur.page.turned_meshes import Mesh, joined, tube
from assur.scene.companion import companion
from assur.scene.layers import Layer
from assur.scene.skeleton import skeleton

FloatArray = NDArray[np.float64]
COLOUR, WAYS = "#009e73", ("#cc3311", "#ee7733", "#aa4499")
"""Of the ellipsoid, and of vibrations, of which there are so many: more would make pages of a megabyte."""
LONGEST, FURTHEST = 0.2, 0.12
"""Of the mechanism's size: the longest semi-axis, and how far the point goes that moves most."""
THIN, THICK = 0.005, 0.015
"""Of the mechanism's size: radii of a tube in which there is no energy, and in which there is all."""
AWAY = 0.1
"""Share of its radius by which a tube may leave its curve: what hardly bends needs no rings on the way."""
THINNEST = 1e-3
"""Share of the longest semi-axis that the others have at least, so that a flat ellipsoid is seen."""
MICRO = 1e6
"""N/m in a N/µm."""


def stiffness_layers(record: MechanismRecord, values: FloatArray, where: str = "at home") -> tuple[Layer, ...]:
    """At joint values (n,), where the file says what the actuators yield and these hold the platform.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> [item.label for item in stiffness_layers(record, home_values(record))][:2]
    ['stiffness at home: 0.219, 1.11, 8.26 N/µm', 'vibration at home: 28.5 Hz, link12 52 %']
    """
    try:
        solved = stiffness_at(record, values[None])
    except UsageError:  # the file says too little of springs: pictures have no stiffness then
        return ()
    if solved.status[0] != int(Status.regular):
        return ()
    drawn = skeleton(record, companion(record), values)
    rotation, origin = drawn.frames[record.platform.link]
    point = rotation @ record.platform.point + origin
    return tuple(_layers(solved, np.asarray(point), drawn.size, where))


def _layers(solved: Stiffness, point: FloatArray, size: float, where: str) -> Iterator[Layer]:
    stiff, ways = (part[0] for part in solved.translational)
    told = ", ".join("rigid" if np.isinf(value) else f"{value / MICRO:.3g}" for value in stiff)
    axes = LONGEST * size * np.maximum(stiff[0] / stiff, THINNEST)
    vertices, faces = _ball()
    yield Layer("stiffness", f"stiffness {where}: {told} N/µm", COLOUR, 0.45, point + (vertices * axes) @ ways, faces)
    metre = METRES[solved.record.unit]
    for colour, shape in zip(WAYS, solved.mode_shapes(), strict=False):
        curves = shape.deflected(FURTHEST * size * metre)
        curves.pop(solved.record.base, None)
        most = max(shape.shares.links, key=lambda name: shape.shares.links[name])
        label = f"vibration {where}: {shape.frequency:.3g} Hz, {most} {100 * shape.shares.links[most]:.0f} %"
        placed = {link: own / metre for link, own in curves.items()}
        tubes = list(_tubes(placed, shape.shares.bent, size))
        if tubes:
            yield Layer("stiffness", label, colour, 1.0, *joined(tubes))


def _tubes(curves: Mapping[str, FloatArray], shares: Mapping[str, float], size: float) -> Iterator[Mesh]:
    for link, own in curves.items():
        radius = size * (THIN + (THICK - THIN) * shares.get(link, 0.0))
        for curve in own:
            ends = [*pairwise(curve), *([(curve[-1], curve[0])] if len(curve) > 2 else [])]
            parts = [_thinned(curve, AWAY * radius)] if link in shares else [np.stack(pair) for pair in ends]
            yield from (tube(part, radius) for part in parts if np.ptp(part, axis=0).any())


def _thinned(curve: FloatArray, tolerance: float) -> FloatArray:
    """Of points (2^n + 1, 3) every 2^k-th, as few as leave the others within a tolerance of the chords between them.

    >>> line, bow = np.linspace([0.0, 0, 0], [1.0, 0, 0], 9), np.linspace(0.0, 1.0, 9)[:, None] ** [1, 2, 3]
    >>> len(_thinned(line, 1e-3)), len(_thinned(bow, 1e-1)), len(_thinned(bow, 1e-3))
    (2, 5, 9)
    """
    places = np.arange(len(curve))
    step = len(curve) - 1
    while step > 1:
        kept = places[::step]
        chords = np.stack([np.interp(places, kept, part) for part in curve[kept].T], axis=-1)
        if np.max(np.linalg.norm(chords - curve, axis=1)) <= tolerance:
            return curve[kept]
        step //= 2
    return curve


def _ball(rings: int = 12, sides: int = 24) -> Mesh:
    """The unit sphere, its poles at the first axis."""
    along, about = np.linspace(0.0, np.pi, rings + 1), 2.0 * np.pi * np.arange(sides) / sides
    height, radius = np.cos(along)[:, None], np.sin(along)[:, None]
    vertices = np.stack(np.broadcast_arrays(height, radius * np.cos(about), radius * np.sin(about)), axis=-1)
    low = np.arange(rings)[:, None] * sides + np.arange(sides)
    after = np.arange(rings)[:, None] * sides + np.roll(np.arange(sides), -1)
    faces = [np.stack(parts, axis=-1) for parts in ((low, low + sides, after), (after, low + sides, after + sides))]
    return vertices.reshape(-1, 3), np.concatenate([part.reshape(-1, 3) for part in faces])
