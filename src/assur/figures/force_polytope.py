"""The polytope of forces on the platform that the actuators hold at rest within their limits, gravity included."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from assur.figures.axes3d import draw_axes, draw_box
from assur.figures.canvas import Canvas, View, fitted
from assur.figures.context import Context
from assur.figures.joint_forces import no_masses
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import BLUE, GREY, INK, SKY
from assur.kinematics.pose import pose_of
from assur.machine.forces.capacity import ForceCapacity, capacity
from assur.machine.forces.utilisation import stated
from assur.scene.camera import orthographic, plane

FloatArray = NDArray[np.float64]
SHOWN = 1e-6
"""Cosine by which faces must differ for the edge between them to be drawn."""


def no_capacity(context: Context) -> str:
    """Why a mechanism has no figures of what its actuators hold; empty where it has."""
    if no_masses(context):
        return no_masses(context)
    unknown = np.isnan(stated(context.record, "force"))
    names = [item.name for item, none in zip(context.record.drives, unknown, strict=True) if none]
    return f"the mechanism's file says no largest force of {', '.join(names)}" if names else ""


def _missing(context: Context) -> str:
    if no_capacity(context):
        return no_capacity(context)
    if len(held(context).axes) < 2:
        return "forces along one direction span no polytope; the figure forces maps what is held along it"
    return "" if len(held(context).vertices) else "the actuators do not bound the forces that are held"


def held(context: Context) -> ForceCapacity:
    """What is held in the configuration that is drawn, worked out once."""
    pose = pose_of(context.record, context.drawn_joints)
    return context.kept("force capacity", lambda: capacity(context.record, pose))


def _caption(context: Context) -> str:
    capable = held(context)
    return (
        f"Forces on the platform that the actuators hold at rest within their limits, gravity included, along"
        f" {', '.join(capable.axes)}. The circle is the largest sphere about no force, {capable.sphere:.4g} N; beyond"
        f" it {capable.limiting} is at its limit first."
    )


def _draw(context: Context) -> Drawing:
    capable = held(context)
    corners = np.zeros((len(capable.vertices), 3))
    corners[:, : len(capable.axes)] = capable.vertices
    flat = len(capable.axes) < 3
    ball = capable.sphere * np.concatenate([np.eye(3), -np.eye(3)])
    if flat:
        ball[:, 2] = 0.0
    cloud = np.concatenate([corners, ball])
    camera = plane("x", "y") if flat else orthographic(35, 22)
    view, page = fitted(camera, cloud, min(100, context.page), 85, margin=17)
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    if not flat:
        draw_box(page, view, low, high)
        draw_axes(page, view, low, high, [f"${name}$ (N)" for name in capable.axes], [1.0] * 3)
    _draw_polytope(page, view, corners, capable, flat=flat)
    return Drawing(page.figure, {"axes": capable.axes, "vertices": capable.vertices, "sphere": capable.sphere,
                                 "limiting": capable.limiting, "per_axis": capable.per_axis})  # fmt: skip


def _draw_polytope(page: Canvas, view: View, corners: FloatArray, capable: ForceCapacity, *, flat: bool) -> None:
    """Edges between faces that differ, those behind thin; the sphere's outline, and the directions of no force."""
    middle, zero = view(np.zeros(3)), np.zeros(3)
    if flat:
        order = ConvexHull(corners[:, :2]).vertices
        page.polygon(view(corners[order]), SKY, INK, 1.0, 3, alpha=0.6)
    else:
        shell = ConvexHull(corners)
        normals = shell.equations[:, :3]
        for face, normal in zip(shell.simplices, normals, strict=True):
            if normal @ view.camera.toward > 0:
                page.polygon(view(corners[face]), SKY, "none", 0.0, 3, alpha=0.35)
        for k, others in enumerate(shell.neighbors):
            for own, other in enumerate(others):
                if k < other and normals[k] @ normals[other] < 1.0 - SHOWN:
                    edge = np.delete(shell.simplices[k], own)
                    front = max(float(normals[face] @ view.camera.toward) for face in (k, other)) > 0
                    page.line(view(corners[edge]), 1.0 if front else 0.5, INK if front else GREY, 5 if front else 2)
    radius = capable.sphere * view.scale
    ball = Circle((middle[0], middle[1]), radius, facecolor="none", edgecolor=BLUE, linewidth=1.0, zorder=6)
    ball.set_linestyle("--")
    page.axes.add_patch(ball)
    for k, name in enumerate(capable.axes):
        tip = zero.copy()
        tip[k] = capable.per_axis[k, 1]
        if np.isfinite(tip).all():
            page.arrow(middle, view(tip), BLUE, 0.8, 7.0)
            side = {"ha": "left", "va": "bottom"} if flat else {}
            page.text(view(1.06 * tip), f"${name}$" + f" {tip[k]:.3g} N" * flat, **side)


FORCE_POLYTOPE = FigureKind("polytope", "Forces that are held", _missing, _caption, _draw)
