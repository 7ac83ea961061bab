"""Drawing: every link as one mesh for each of its colours, in its own frame, and where the frames stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations
from assur.scene.companion import companion
from assur.scene.letters import PlacedLetter, letters
from assur.scene.mesh import Mesh, joined, rgb
from assur.scene.parts import machine
from assur.scene.skeleton import skeleton

FloatArray = NDArray[np.float64]
FULL = 2.0
"""Longest side of a mechanism in the view's own unit."""


@dataclass(frozen=True, eq=False)
class Solid:
    """Part of a link in one colour: vertices (n, 3) in the link's frame, faces (k, 3), colour (3,) from 0 to 255."""

    link: str
    name: str
    vertices: FloatArray
    faces: NDArray[np.int64]
    colour: tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class SolidDrawing:
    """What is drawn of one mechanism; every length times `scale`.

    Attributes:
        solids, letters: in the frames of their links.
        scale: the view's unit per unit of the mechanism.
    """

    solids: tuple[Solid, ...]
    letters: tuple[PlacedLetter, ...]
    scale: float


def drawing(record: MechanismRecord, values: FloatArray) -> SolidDrawing:
    """What is drawn of a mechanism, made for joint values (n,).

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = drawing(record, home_values(record))
    >>> sorted({item.link for item in found.solids})
    ['base', 'crank1', 'crank2', 'rod1', 'rod2']
    """
    look = companion(record)
    shape = skeleton(record, look, values)
    scale = FULL / max(shape.size, 1e-300)
    grouped: dict[tuple[str, str], list[Mesh]] = {}
    for part in machine(record):
        grouped.setdefault((part.link, part.colour), []).append(part.shape.mesh(part.colour))
    solids = [
        Solid(link, f"{link} {colour[1:]}", *_indexed(joined(meshes), scale), _bytes(colour))
        for (link, colour), meshes in grouped.items()
    ]
    named = tuple(replace(letter, at=letter.at * scale) for letter in letters(shape))
    return SolidDrawing(tuple(solids), named, scale)


def places(record: MechanismRecord, values: FloatArray, scale: float) -> Mapping[str, tuple[FloatArray, FloatArray]]:
    """Link -> unit quaternion (..., 4) and origin (..., 3) in the view's unit, at joint values (..., n).

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> places(record, home_values(record), 1.0)["base"][0].round(9).tolist()
    [1.0, 0.0, 0.0, 0.0]
    """
    batch = values.shape[:-1]
    return {
        link: (
            np.broadcast_to(rotations.to_quaternion(turn), (*batch, 4)),
            np.broadcast_to(scale * origin, (*batch, 3)),
        )
        for link, (turn, origin) in frames(record, values).items()
    }


def cloud(drawn: SolidDrawing, record: MechanismRecord, values: FloatArray) -> FloatArray:
    """The vertices (m, 3) of all that is drawn, where it stands at joint values (n,), in the view's unit."""
    stand = places(record, values, drawn.scale)
    return np.concatenate(
        [
            solid.vertices @ rotations.from_quaternion(stand[solid.link][0]).T + stand[solid.link][1]
            for solid in drawn.solids
        ]
    )


def _indexed(mesh: Mesh, scale: float) -> tuple[FloatArray, NDArray[np.int64]]:
    """Vertices that triangles of one smooth face share, so that a viewer shades it smoothly, and faces."""
    corners = mesh.corners.reshape(-1, 3) * scale
    patch = np.repeat(mesh.patch, 3)
    key = np.column_stack([np.round(corners / (1e-7 * FULL)), patch]).astype(np.int64)
    _, first, places = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return corners[first], places.reshape(-1, 3)


def _bytes(colour: str) -> tuple[int, int, int]:
    red, green, blue = (round(255 * float(part)) for part in rgb(colour))
    return red, green, blue
