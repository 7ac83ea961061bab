"""The model view: bars, pins, sliders, rails and platform in light, with hidden parts hidden."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, fitted
from assur.figures.context import Context
from assur.figures.raster import picture
from assur.figures.spec import Drawing, Entry, always
from assur.figures.style import BLUE, DOTS_PER_INCH, SMALL
from assur.scene.camera import Camera, orthographic
from assur.scene.mesh import Mesh
from assur.scene.parts import model
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]


def _caption(context: Context) -> str:
    unit = context.record.unit
    values = ", ".join(
        f"{name} = {item.value:g}{'' if item.unit in (unit, '1') else f' {item.unit}'}"
        for name, item in context.record.parameters.items()
        if not item.drawn_only
    )
    dimensions = f" with {values} (lengths in {unit})" if values else ""
    return (
        f"Model view of the mechanism{dimensions}. Lengths and axes are those of the joint"
        " graph; thicknesses, rails and base plate are drawn only."
    )


def model_camera(context: Context) -> Camera:
    """The view of a model; a planar mechanism is seen from above at a slant."""
    return context.companion.camera("solid", orthographic(-62, 52) if context.planar else orthographic(35, 22))


def _draw(context: Context) -> Drawing:
    camera = model_camera(context)
    mesh = model(context.skeleton, context.companion)
    view, page = fitted(camera, mesh.corners.reshape(-1, 3), 120, 120, margin=4)
    paste(page, mesh, view)
    triad(page, camera, np.array([22.0, 20.0]))
    return Drawing(page.figure, _data(context, context.skeleton))


def paste(page: Canvas, mesh: Mesh, view: View, box: tuple[float, float, float, float] | None = None) -> None:
    """The picture of a mesh on a page, or on a part (left, bottom, width, height) of it, in points."""
    left, bottom, width, height = box or (0.0, 0.0, page.axes.get_xlim()[1], page.axes.get_ylim()[1])
    local = View(view.camera, view.scale, view.offset - [left, bottom])
    image = picture(mesh, local, (width, height), DOTS_PER_INCH)
    page.axes.imshow(
        image,
        extent=(left, left + width, bottom, bottom + height),
        interpolation="antialiased",
        zorder=2,
        aspect="auto",
    )


def triad(page: Canvas, camera: Camera, at: FloatArray, size: float = 15.0) -> None:
    """The directions X, Y, Z of the base at a place (2,) of the page, in points."""
    for name, axis in zip("XYZ", np.eye(3), strict=True):
        way = size * camera.project(axis)
        if np.linalg.norm(way) > 3.0:
            page.arrow(at, at + way, BLUE, 0.8, 11, head=5)
            page.text(at + way * (1 + 5.5 / np.linalg.norm(way)), f"${name}$", fontsize=SMALL, color=BLUE)


def _data(context: Context, skeleton: Skeleton) -> dict[str, Any]:
    return {
        "unit": context.record.unit,
        "parameters": vars(context.record.values),
        "points": skeleton.points,
        "frames": {link: {"rotation": frame[0], "origin": frame[1]} for link, frame in skeleton.frames.items()},
    }


SOLID = Entry("solid", "3-D model", always, _caption, _draw)
