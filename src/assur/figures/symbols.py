"""Symbols of joints after ISO 3952: circle or sleeve for a revolute, slider on a guide, hatching for the base."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, guide
from assur.figures.style import INK, ORANGE, PAPER
from assur.joints.joint_type import JointType
from assur.scene.hull import hull

FloatArray = NDArray[np.float64]
RADIUS = 3.6
SLEEVE = np.array([5.5, 2.9])
SLIDER = np.array([8.5, 4.6])
HATCH = 3.6
"""Half sizes of the symbols in points."""

ROUND = np.array([[-1.0, -1.0], [1.0, 1.0]])


class Typed(Protocol):
    """What has a type of joint."""

    @property
    def type(self) -> JointType:
        """The type."""


class DrawnJoint(Protocol):
    """What a symbol says of a joint: its type, place (3,) and unit axes (k, 3), whether it is driven."""

    @property
    def joint(self) -> Typed:
        """The joint."""

    @property
    def shown(self) -> FloatArray:
        """Where its symbol stands."""

    @property
    def axes(self) -> FloatArray:
        """What its steps go along."""

    @property
    def driven(self) -> bool:
        """Whether it is actuated."""


def joint_symbol(page: Canvas, view: View, mark: DrawnJoint, order: float, size: float = 1.0) -> FloatArray:
    """The symbol of one joint; a driven one is filled. Returns points (k, 2) about it."""
    at = view(mark.shown)
    fill = ORANGE if mark.driven else PAPER
    if mark.joint.type.ball:
        page.disc(at, 1.2 * size * RADIUS, fill, order=order)
        page.disc(at, 0.5 * size * RADIUS, INK, order=order)
        return at + 1.2 * size * RADIUS * ROUND
    if not mark.joint.type.turning:
        corners = box(at, direction(view, mark.axes[0]), size * SLIDER)
        page.polygon(corners, fill, order=order)
        return corners
    if mark.joint.type.slides == 2:  # on a plane, whose normal is the first axis
        return _plane(page, view, mark, fill, order, size)
    drawn = [_turning(page, view, at, axis, fill, order, size) for axis in mark.axes]
    if mark.joint.type.slides:
        page.polygon(box(at, direction(view, mark.axes[0]), size * SLIDER * [1.2, 0.9]), fill, order=order)
        page.disc(at, 0.6 * size * RADIUS, PAPER, order=order)
    return np.concatenate(drawn)


def _plane(page: Canvas, view: View, mark: DrawnJoint, fill: str, order: float, size: float) -> FloatArray:
    """A plate in its plane as it is seen, and a disc on it where it turns."""
    at = view(mark.shown)
    first, second = (view.camera.project(axis) for axis in mark.axes[1:])
    seen = np.array([first + second, first - second, -first - second, second - first])
    thin = 0.25 * size * SLIDER[1] * np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])
    corners = hull(np.concatenate([size * SLIDER[0] * seen + corner for corner in thin]) + at)
    page.polygon(corners, fill, order=order)
    if mark.joint.type.turning:
        page.disc(at, 0.6 * size * RADIUS, PAPER, order=order)
    return corners


def _turning(
    page: Canvas, view: View, at: FloatArray, axis: FloatArray, fill: str, order: float, size: float
) -> FloatArray:
    """A circle where the axis points out of the plane in true shape, else a sleeve between two flanges."""
    if abs(float(axis @ view.camera.front)) > 0.9:
        page.disc(at, size * RADIUS, fill, width=0.9, order=order)
        return at + size * RADIUS * ROUND
    along = direction(view, axis)
    across = np.array([-along[1], along[0]])
    shown = float(np.clip(np.linalg.norm(view.camera.project(axis)), 0.45, 1.0))
    half = size * SLEEVE * [shown, 1.0]
    guide(page, np.array([at - (half[0] + 5.5) * along, at + (half[0] + 5.5) * along]), order)
    page.polygon(box(at, along, half), fill, order=order)
    for sense in (-1.0, 1.0):
        foot = at + sense * (half[0] + 1.6) * along
        page.line(np.array([foot - 0.9 * half[1] * across, foot + 0.9 * half[1] * across]), 0.9, INK, order)
    return box(at, along, half + np.array([5.5, 0.0]))


def ground_rail(page: Canvas, start: FloatArray, end: FloatArray, order: float, below: FloatArray) -> None:
    """A guide from start to end (2,) on the base, hatched on the side of `below` (2,)."""
    page.line(np.array([start, end]), 1.2, INK, order, solid_capstyle="butt")
    hatching(page, start, end, order, below)


def ground_pivot(page: Canvas, at: FloatArray, order: float) -> None:
    """A support on the base under a revolute joint."""
    feet = at + np.array([[-6.5, -11.0], [6.5, -11.0]])
    page.polygon(np.array([at, *feet]), PAPER, order=order)
    line = feet + np.array([[-4.0, 0.0], [4.0, 0.0]])
    page.line(line, 1.2, INK, order, solid_capstyle="butt")
    hatching(page, line[0], line[1], order, np.array([0.0, -1.0]))


def hatching(page: Canvas, start: FloatArray, end: FloatArray, order: float, below: FloatArray) -> None:
    """Short slanted strokes along a line, on the side of `below`."""
    way = end - start
    length = float(np.linalg.norm(way))
    if length < 1.0:  # seen from its end
        return
    along = way / length
    normal = np.array([-along[1], along[0]])
    normal = normal if normal @ below > 0 else -normal
    count = max(2, round(length / HATCH))
    for foot in start + along * (np.arange(count) + 0.8)[:, None] * length / (count + 0.6):
        page.line(np.array([foot, foot + HATCH * (normal - 0.8 * along)]), 0.5, INK, order)


def direction(view: View, axis: FloatArray) -> FloatArray:
    """Unit direction (2,) of an axis on the page; to the right where the axis points at the reader."""
    flat = view.camera.project(axis)
    size = float(np.linalg.norm(flat))
    return flat / size if size > 1e-9 else np.array([1.0, 0.0])


def box(at: FloatArray, along: FloatArray, half: FloatArray) -> FloatArray:
    """Corners (4, 2) of a rectangle."""
    across = np.array([-along[1], along[0]])
    a, b = half[0] * along, half[1] * across
    return np.array([at - a - b, at + a - b, at + a + b, at - a + b])
