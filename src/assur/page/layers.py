"""Layers: the workspace, its sections and the surfaces on which a parallel factor vanishes, where the platform is.

A layer stands where the platform's point is; coordinates that the workspace does not have are as they are at home.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, is_angle
from assur.page.quantised import quantised, thinned
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


def layers(
    record: MechanismRecord, resolution: int | None = None, tick: Callable[[int, int], None] | None = None
) -> list[dict[str, Any]]:
    """Every layer of the default working mode in the file's box, quantised.

    Empty where the pose has fewer than two lengths, or the file gives no box for them. Angles are held as at home.

    >>> from assur.model.registry import load_record
    >>> [item["label"] for item in layers(load_record("fivebar"))][:1]
    ['workspace of mode -+']
    """
    held = _held(record)
    if held is None:
        return []
    found = workspace(record, resolution=resolution or _resolution(record, held), held=held, progress=tick)
    return [_layer(*item) for item in _meshes(record, found)]


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


def _meshes(record: MechanismRecord, found: Workspace) -> Iterator[tuple[dict[str, Any], FloatArray, Faces]]:
    """What each layer says, its vertices (n, 3) in the base frame and its faces."""
    mode = f" of mode {found.mode}" if found.mode else ""
    names = found.box.names
    if len(found.faces):
        said = _said("workspace", f"workspace{mode}", SOLID, 0.18)
        yield said, _placed(record, names, found.vertices), found.faces
    for k, locus in enumerate(item for item in found.loci if len(item.faces)):
        said = _said("singular", f"{locus.factor} = 0: {locus.meaning}", SINGULAR[k % len(SINGULAR)], 0.45)
        yield {**said, "factor": locus.factor}, _placed(record, names, locus.vertices), locus.faces
    for cut in found.sections:
        if cut.polygons and len(cut.plane) == 2:
            area = f"area about {float(f'{cut.area:.3g}'):.10g} {record.unit}^2"  # on a grid; proved ones: certify
            label = f"section {cut.coordinate} = {cut.value:g} {record.unit}, {area}"
            points, edges = _outlines(cut.polygons)
            plane = np.column_stack([points, np.full(len(points), cut.value)])
            yield (
                _said("section", label, SECTION, 1.0),
                _placed(record, (*cut.plane, cut.coordinate), plane),
                edges,
            )


def _said(kind: str, label: str, colour: str, opacity: float) -> dict[str, Any]:
    return {"name": label, "label": label, "kind": kind, "colour": colour, "opacity": opacity, "visible": False}


def _layer(said: dict[str, Any], vertices: FloatArray, faces: Faces) -> dict[str, Any]:
    return {**said, **quantised(*thinned(vertices, faces, FACES))}


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
