"""Layers: the workspace, its sections and the surfaces on which a parallel factor vanishes, where the platform is.

A layer stands where the platform's point is; coordinates that the workspace does not have are as they are at home.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, is_angle
from assur.scene.thinning import thinned
from assur.workspace.region import Workspace, workspace
from assur.workspace.slices import MOST, slice_at

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
RESOLUTION, FOLLOWED = 32, 12
"""Cells along each coordinate: what a page can show, and fewer in space where a mode has to be followed."""

FACES = 8000
"""Triangles of a layer, at most."""

SOLID = "#4477aa"
SECTION = "#225588"
SINGULAR = ("#cc3311", "#ee7733", "#aa3377", "#bb9900", "#882255", "#999933")


@dataclass(frozen=True, eq=False)
class Layer:
    """A surface or lines where the platform's point can be.

    Attributes:
        label: what it is, with its numbers. factor: the parallel factor that vanishes on a singular one, else empty.
        colour, opacity: "#rrggbb", and between 0 and 1.
        vertices: (n, 3) in the base frame. faces: (k, 3) triangles or (k, 2) segments.
    """

    kind: Literal["workspace", "singular", "section"]
    label: str
    colour: str
    opacity: float
    vertices: FloatArray
    faces: Faces
    factor: str = ""

    @property
    def lines(self) -> bool:
        """Whether it is made of segments."""
        return bool(self.faces.shape[1] == 2)


def layers(
    record: MechanismRecord,
    mode: str | None = None,
    resolution: int | None = None,
    tick: Callable[[int, int], None] | None = None,
) -> tuple[Layer, ...]:
    """Every layer of a working mode (the default one if None) in the file's box, with `FACES` faces each at most.

    Empty where the pose has fewer than two lengths, or the file gives no box for them. Angles are held as at home.

    >>> from assur.model.registry import load_record
    >>> [(item.label, item.lines) for item in layers(load_record("fivebar"))][:1]
    [('workspace of mode -+', False)]
    """
    held = _held(record)
    if held is None:
        return ()
    cells = resolution or _resolution(record, held)
    return tuple(_layers(record, workspace(record, mode, resolution=cells, held=held, progress=tick)))


def _held(record: MechanismRecord) -> dict[str, float] | None:
    """Pose coordinates that are held; None where there is no workspace that can be seen."""
    pose = record.platform.pose
    lengths = [name for name in pose if name in LENGTHS]
    if len(lengths) < 2 or not all(name in record.box for name in lengths):
        return None
    home = dict(zip(pose, pose_of(record, home_values(record)).tolist(), strict=True))
    angles = {name: value for name, value in home.items() if is_angle(name)}
    return angles or dict(slice_at(record).held)


def _resolution(record: MechanismRecord, held: dict[str, float]) -> int:
    followed = record.closed_form is None and len(slice_at(record, held).free) == MOST
    return FOLLOWED if followed else RESOLUTION


def _layers(record: MechanismRecord, found: Workspace) -> Iterator[Layer]:
    mode = f" of mode {found.mode}" if found.mode else ""
    names = found.box.names
    if len(found.faces):
        mesh = thinned(_placed(record, names, found.vertices), found.faces, FACES)
        yield Layer("workspace", f"workspace{mode}", SOLID, 0.18, *mesh)
    for k, locus in enumerate(item for item in found.loci if len(item.faces)):
        mesh = thinned(_placed(record, names, locus.vertices), locus.faces, FACES)
        label = f"{locus.factor} = 0: {locus.meaning}"
        yield Layer("singular", label, SINGULAR[k % len(SINGULAR)], 0.45, *mesh, locus.factor)
    for cut in found.sections:
        if cut.polygons and len(cut.plane) == 2:
            area = f"area about {float(f'{cut.area:.3g}'):.10g} {record.unit}^2"  # on a grid; proved ones: certify
            label = f"section {cut.coordinate} = {cut.value:g} {record.unit}, {area}"
            points, edges = _outlines(cut.polygons)
            plane = np.column_stack([points, np.full(len(points), cut.value)])
            mesh = thinned(_placed(record, (*cut.plane, cut.coordinate), plane), edges, FACES)
            yield Layer("section", label, SECTION, 1.0, *mesh)


def _placed(record: MechanismRecord, names: tuple[str, ...], points: FloatArray) -> FloatArray:
    """Points (n, k) of some pose coordinates as positions (n, 3) of the platform's point in the base frame."""
    rotation, origin = frames(record, home_values(record))[record.platform.link]
    placed = np.tile(rotation @ record.platform.point + origin, (len(points), 1))
    for column, name in enumerate(names):
        placed[:, LENGTHS.index(name)] = points[:, column]
    return placed


def _outlines(polygons: tuple[FloatArray, ...]) -> tuple[FloatArray, Faces]:
    """Closed polygons as points (n, 2) and segments (n, 2)."""
    edges, start = [], 0
    for polygon in polygons:
        here = start + np.arange(len(polygon))
        edges.append(np.column_stack([here, np.roll(here, -1)]))
        start += len(polygon)
    return np.concatenate(polygons), np.concatenate(edges)
