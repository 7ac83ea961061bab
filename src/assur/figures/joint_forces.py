"""Forces in the joints under gravity, drawn on the mechanism; what rigid links leave open is hatched."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, fitted
from assur.figures.context import Context
from assur.figures.letters import letter
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, cloud_of, draw_bodies, draw_ground
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import GREY, INK, PAPER, RED, SMALL
from assur.machine.forces.forces_at_rest import ForcesAtRest, forces_at_rest
from assur.machine.forces.reactions import JointReaction
from assur.machine.masses.link_masses import masses
from assur.scene.camera import oblique, orthographic
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
LONGEST = 0.3
"""Of the mechanism's size: the longest arrow."""
SMALLEST = 0.02
"""Share of the largest force below which there is no arrow."""
DISC = 8.0
"""Points across the hatching."""


def no_masses(context: Context) -> str:
    """Why a mechanism has no figures of forces; empty where it has."""
    lacking = masses(context.record).lacking
    return f"the mechanism's file says no mass of {', '.join(lacking)}" if lacking else ""


def joint_forces(context: Context) -> ForcesAtRest:
    """Those in the configuration that is drawn, worked out once."""
    return context.kept("joint forces", lambda: forces_at_rest(context.record, context.drawn_joints))


def _caption(context: Context) -> str:
    passed = joint_forces(context)
    if not passed.joints:
        return f"Forces in the joints: none are told, as the configuration is {passed.status}."
    open_joints = [item.joint for item in passed.joints if not item.unique[:3].all()]
    held = f"the longest arrow is {passed.largest:.3g} N"
    if not open_joints:
        return f"What each joint's parent exerts on its child at rest under gravity; {held}. All of it is determined."
    number = f"{passed.stresses} stresses balance themselves" if passed.stresses > 1 else "one stress balances itself"
    return (
        f"What each joint's parent exerts on its child at rest under gravity; {held}. Hatched: joints whose forces"
        f" rigid links leave open, as {number}; dashed arrows are the least solution there."
    )


def _draw(context: Context) -> Drawing:
    skeleton, passed = context.skeleton, joint_forces(context)
    usual = orthographic(-62, 52) if context.planar else oblique("y", "z", 216, 0.6)
    camera = context.companion.camera("reactions", usual)
    per_newton = LONGEST * skeleton.size / (passed.largest or 1.0)
    starts = [_place(skeleton, item.joint) for item in passed.joints]
    ends = [start + per_newton * item.force for start, item in zip(starts, passed.joints, strict=True)]
    cloud = np.concatenate([cloud_of(skeleton, context.companion), np.array(ends).reshape(-1, 3)])
    view, page = fitted(camera, cloud, min(150, context.page), 105, margin=9)
    letters = Letters(page)
    draw_ground(page, view, skeleton, context.companion, letters)
    links = {link for mark in skeleton.marks for link in (mark.joint.parent, mark.joint.child)}
    draw_bodies(page, view, skeleton, letters, Pen(width=1.2, symbol=0.7, colours=dict.fromkeys(links, GREY)))
    for item, start, end in zip(passed.joints, starts, ends, strict=True):
        _draw_force(page, view, item, (start, end), passed.largest)
        way = np.array([view(start), view(end)])
        letters.avoid(way)
        if np.linalg.norm(item.force) >= SMALLEST * passed.largest > 0.0:
            name = letter(context.record.joints[item.joint].alias or item.joint)
            letters.add(view(start), f"{name} {np.linalg.norm(item.force):.3g} N", clear=5.0, fontsize=SMALL)
    letters.place()
    return Drawing(page.figure, _data(context, passed))


def _place(skeleton: Skeleton, name: str) -> FloatArray:
    """A joint's point (3,) on its child, as that of a slider on its rail."""
    joint = skeleton.record.joints[name]
    rotation, origin = skeleton.frames[joint.child]
    return np.asarray(rotation @ joint.child_at + origin)


def _draw_force(
    page: Canvas, view: View, reaction: JointReaction, ends: tuple[FloatArray, FloatArray], largest: float
) -> None:
    sure = bool(reaction.unique[:3].all())
    start, end = (view(place) for place in ends)
    if not sure:
        disc = Circle((start[0], start[1]), DISC / 2, facecolor=PAPER, edgecolor=INK, linewidth=0.5, zorder=11)
        disc.set_hatch("/" * 9)
        page.axes.add_patch(disc)
    if np.linalg.norm(reaction.force) >= SMALLEST * largest > 0.0:
        page.arrow(start, end, RED, 1.1, 12.0, head=7.0, linestyle="-" if sure else (0, (2.5, 1.5)))


def _data(context: Context, passed: ForcesAtRest) -> dict[str, object]:
    return {
        "status": passed.status,
        "stresses": passed.stresses,
        "joints": [
            {
                "joint": item.joint,
                "at": _place(context.skeleton, item.joint),
                "force": item.force,
                "moment": item.moment,
                "unique": item.unique,
            }
            for item in passed.joints
        ],
    }


JOINT_FORCES = FigureKind("reactions", "Forces in the joints", no_masses, _caption, _draw)
