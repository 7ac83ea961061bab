"""Layers: the workspace, its sections and the surfaces on which a parallel factor vanishes, where the platform is.

A layer stands where the platform's point is; coordinates that the workspace does not have are as they are at home.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, is_angle
from assur.scene.refining import combed, refined
from assur.scene.thinning import thinned
from assur.singularity.loci import Locus
from assur.workspace.fields import Field
from assur.workspace.followed_field import FollowedField
from assur.workspace.grid import UniformGrid
from assur.workspace.region import Workspace, workspace
from assur.workspace.sections import RegionSection
from assur.workspace.slices import MOST, slice_at

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
RESOLUTION, FOLLOWED = 32, 12
"""Cells along each coordinate: what a page can show, and fewer in space where a mode has to be followed."""

FACES = 8000
"""Triangles of a layer, at most."""

COARSE = 3000
"""Faces of a singular surface that was followed, at most: every vertex is solved for."""

SLIVERS, TEETH = 0.7, 0.5
"""Share of its faces that are left when slivers are merged, and how far a rim may move, in cells."""

CUT = 1e-6
"""Of a side of the box: a workspace that comes so near to its end is cut there."""

SOLID = "#4477aa"
SECTION = "#225588"
SINGULAR = ("#cc3311", "#ee7733", "#aa3377", "#bb9900", "#882255", "#999933")


@dataclass(frozen=True, eq=False)
class Layer:
    """A surface or lines where the platform's point can be, arrows of forces, or what gives way.

    Attributes:
        label: what it is, with its numbers. factor: the parallel factor that vanishes on a singular one, else empty.
        colour, opacity: "#rrggbb", and between 0 and 1.
        vertices: (n, 3) in the base frame. faces: (k, 3) triangles or (k, 2) segments.
    """

    kind: Literal["workspace", "singular", "section", "force", "stiffness"]
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


def region(
    record: MechanismRecord,
    mode: str | None = None,
    resolution: int | None = None,
    tick: Callable[[int, int], None] | None = None,
) -> Workspace | None:
    """The workspace of a mode (the default one if None) in the file's box; None where there is none that can be seen.

    Angles are held as at home.

    >>> from assur.model.registry import load_record
    >>> region(load_record("three_rps")) is None  # its pose has one length
    True
    """
    held = _held(record)
    if held is None:
        return None
    cells = resolution or _resolution(record, held)
    return workspace(record, mode, resolution=cells, held=held, progress=tick)


def layers(record: MechanismRecord, workspace: Workspace | None) -> tuple[Layer, ...]:
    """The layers of what `region` found, its sections among them, with `FACES` faces each at most.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> [(item.label, item.lines) for item in layers(record, region(record))][:1]
    [('workspace of mode -+', False)]
    """
    return () if workspace is None else tuple(_layers(record, workspace))


def layers_note(record: MechanismRecord, workspace: Workspace | None) -> str:
    """A sentence on what the layers are of, or why there are none.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> layers_note(record, region(record, resolution=16))
    'Seen inside the box of the file only, which cuts the workspace in x, y.'
    >>> layers_note(load_record("three_rps"), None)
    'The pose has fewer than two lengths: there is no workspace to be seen.'
    """
    if workspace is None:
        lengths = [name for name in record.platform.pose if name in LENGTHS]
        if len(lengths) < 2:
            return "The pose has fewer than two lengths: there is no workspace to be seen."
        missing = ", ".join(name for name in lengths if name not in record.box)
        return f"The file gives no [workspace] box for {missing}: there is no workspace to be seen."
    if not len(workspace.faces):
        cells = workspace.region.grid.cells[0]
        return f"Nothing was found on {cells} cells along each coordinate: see the [workspace] box of the file."
    low, high = np.asarray(workspace.box.low), np.asarray(workspace.box.high)
    near = np.minimum(np.abs(workspace.vertices - low), np.abs(workspace.vertices - high)).min(axis=0)
    cut = [name for name, away, side in zip(workspace.box.names, near, high - low, strict=True) if away < CUT * side]
    said = [f"Seen inside the box of the file only, which cuts the workspace in {', '.join(cut)}."] if cut else []
    return " ".join([*said, *_held_words(record, workspace)])


def _held_words(record: MechanismRecord, workspace: Workspace) -> list[str]:
    """A sentence on the angles that are held, in the mechanism's unit."""
    words = [f"{name} = {quantity_text(record, value, 'angle')}" for name, value in workspace.slice.held.items()]
    return [f"All of it at {', '.join(words)}."] if words else []


def section_layer(record: MechanismRecord, cut: RegionSection) -> Layer | None:
    """The outline of a section; None where it is empty, or no area."""
    if not cut.polygons or len(cut.plane) != 2:
        return None
    area = f"area about {float(f'{cut.area:.3g}'):.10g} {record.unit}^2"  # on a grid; proved ones: certify
    label = f"section {cut.coordinate} = {cut.value:g} {record.unit}, {area}"
    points, edges = _outlines(cut.polygons)
    plane = np.column_stack([points, np.full(len(points), cut.value)])
    mesh = thinned(_placed(record, (*cut.plane, cut.coordinate), plane), edges, FACES)
    return Layer("section", label, SECTION, 1.0, *mesh)


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


def _layers(record: MechanismRecord, workspace: Workspace) -> Iterator[Layer]:
    mode = f" of mode {workspace.mode}" if workspace.mode else ""
    names = workspace.box.names
    if len(workspace.faces):
        mesh = thinned(_placed(record, names, workspace.vertices), workspace.faces, FACES)
        yield Layer("workspace", f"workspace{mode}", SOLID, 0.18, *mesh)
    for k, locus in enumerate(surface for surface in workspace.loci if len(surface.faces)):
        vertices, faces = _fine(locus, workspace.region.factors[locus.factor], workspace.region.grid)
        mesh = thinned(_placed(record, names, vertices), faces, FACES)
        label = f"{locus.factor} = 0: {locus.meaning}"
        yield Layer("singular", label, SINGULAR[k % len(SINGULAR)], 0.45, *mesh, locus.factor)
    for cut in workspace.sections:
        outline = section_layer(record, cut)
        if outline is not None:
            yield outline


def _fine(locus: Locus, field: Field, grid: UniformGrid) -> tuple[FloatArray, Faces]:
    """The surface of a locus; of a mode that was followed, in few cells, its faces cut in parts that lie on it.

    Where such a surface runs into the border of the mode it ends in teeth of a cell's size: rims are combed, but for
    those on the sides of the box.
    """
    if not isinstance(field, FollowedField) or locus.faces.shape[1] == 2:
        return locus.vertices, locus.faces
    vertices, faces = thinned(locus.vertices, locus.faces, int(SLIVERS * len(locus.faces)))
    far = TEETH * float(np.min(grid.step))

    def rims(points: FloatArray, triangles: Faces) -> FloatArray:
        sides = np.minimum(np.abs(points - grid.low), np.abs(points - grid.high))
        return combed(points, triangles, far, np.any(sides < 0.1 * grid.step, axis=1))

    vertices, faces = refined(rims(vertices, faces), faces, field.known, COARSE)
    return rims(vertices, faces), faces


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
        corners = start + np.arange(len(polygon))
        edges.append(np.column_stack([corners, np.roll(corners, -1)]))
        start += len(polygon)
    return np.concatenate(polygons), np.concatenate(edges)
