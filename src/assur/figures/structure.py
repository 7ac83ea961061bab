"""The structure: the mechanism as a kinematic diagram with the symbols of ISO 3952, its joints and links named."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, fitted
from assur.figures.context import Context
from assur.figures.letters import letter, mathematics, numeral, words
from assur.figures.page import legend_above
from assur.figures.placing import Letters
from assur.figures.sketch import CHAINS, Pen, chain_colours, cloud_of, draw_bodies, draw_ground
from assur.figures.spec import Drawing, FigureKind, always
from assur.figures.style import GREY, INK, SMALL, TEXT
from assur.figures.symbols import direction
from assur.scene.camera import oblique
from assur.scene.rails import rails
from assur.scene.skeleton import Rod, Skeleton

FloatArray = NDArray[np.float64]
BEND = 0.55
"""How far the arrow of a driven turn bulges, as a share of the distance of its ends."""


def _caption(context: Context) -> str:
    return (
        "Kinematic diagram in a parallel projection: circles are revolute joints seen along their axes, sleeves those"
        " seen sideways, boxes on hatched guides are prismatic joints; actuated joints are filled. Numbers in squares"
        f" are links.{_limbs(context)}{context.schematic_note}"
    )


def _limbs(context: Context) -> str:
    """How limbs and their parts are numbered, e.g. " Limb I is leg1; $A_{1}$ is its A, and so on."."""
    order = context.schematic.chains
    first = next((name for name in context.record.joints if "." in name and mathematics(name)), "")
    limb, _, own = first.partition(".")
    if not first or context.companion.chains or limb not in order:
        return ""
    number = numeral(order.index(limb) + 1)
    return f" Limb {number} is {limb} of the file; ${mathematics(first)}$ is its {own}, and so on."


def _draw(context: Context) -> Drawing:
    skeleton, companion = context.schematic, context.companion
    camera = context.camera("structure", oblique("y", "z", 216, 0.6))
    view, page = fitted(camera, cloud_of(skeleton, companion), min(150, context.page), 100, margin=10)
    letters = Letters(page)
    draw_ground(page, view, skeleton, companion, letters)
    draw_bodies(page, view, skeleton, letters, Pen(colours=chain_colours(skeleton)))
    _drives(page, view, skeleton, letters)
    _name_joints(view, skeleton, letters)
    _name_links(context, view, skeleton, letters)
    _number_loops(context, page, view, skeleton, letters)
    letters.place()
    legend_above(page.figure, _legend(context))
    return Drawing(page.figure, _data(context, skeleton))


def _name_joints(view: View, skeleton: Skeleton, letters: Letters) -> None:
    for mark in skeleton.marks:
        name = mark.joint.alias or mark.joint.name
        letters.add(view(mark.shown), letter(name), clear=8.0 if mark.slides else 5.0, fontsize=TEXT)


def _name_links(context: Context, view: View, skeleton: Skeleton, letters: Letters) -> None:
    square = {"boxstyle": "square,pad=0.18", "facecolor": "white", "edgecolor": GREY, "linewidth": 0.4}
    style: dict[str, Any] = {"fontsize": SMALL, "bbox": square}
    for rod in _one_for_each(skeleton):
        letters.add_along(view(rod.points), rod.label or words(rod.link), **style)
    for plate in skeleton.plates:
        letters.add(view(plate.points.mean(axis=0)), plate.label or words(plate.link), clear=0.0, **style)
    base = context.companion.links.get(skeleton.record.base, words(skeleton.record.base))
    feet = [(view(rail.end), 7.0) for rail in rails(skeleton, context.companion)]
    feet += [(view(mark.at) - [0.0, 11.0], 6.0) for mark in skeleton.marks if mark.grounded and not mark.slides]
    for foot, clear in feet[: None if base.isdigit() else 1]:  # a word would fill the page
        letters.add(foot, base, clear=clear, **style)


def _one_for_each(skeleton: Skeleton) -> list[Rod]:
    """The longest rod of each link and label, which bears its name."""
    found: dict[tuple[str, str], Rod] = {}
    for rod in sorted(skeleton.rods, key=lambda rod: -rod.size):
        if rod.size > 0:
            found.setdefault((rod.link, rod.label), rod)
    return list(found.values())


def _drives(page: Canvas, view: View, skeleton: Skeleton, letters: Letters) -> None:
    """A double arrow along every driven slide, an arc about every driven turn."""
    marks = {mark.joint.name: mark for mark in skeleton.marks}
    for item in skeleton.record.drives:
        mark, component = marks[item.coordinate.joint], item.coordinate.component
        steps = {mark.joint.type.components[first]: step for step, first in mark.joint.type.places}
        at = view(mark.shown)
        if item.coordinate.kind == "length":
            along = direction(view, mark.axes[steps[component].direction])
            low = at - np.array([0.0, 10.5])
            page.arrow(low - 12 * along, low + 12 * along, style="<|-|>", head=5, width=0.7, order=9)
            letters.avoid(np.array([low - 12 * along, low + 12 * along]))
        else:
            start, end = at + 9.5 * np.array([0.94, -0.34]), at + 9.5 * np.array([-0.5, 0.87])
            page.arrow(start, end, head=5, width=0.7, order=9, connectionstyle=f"arc3,rad={BEND}")
            letters.avoid(_bent(start, end))


def _bent(start: FloatArray, end: FloatArray) -> FloatArray:
    """The curve (k, 2) of an arrow about a joint, a parabola."""
    way = end - start
    control = (start + end) / 2 + BEND * np.array([way[1], -way[0]])
    share = np.linspace(0.0, 1.0, 8)[:, None]
    return np.asarray((1 - share) ** 2 * start + 2 * share * (1 - share) * control + share**2 * end)


def _number_loops(context: Context, page: Canvas, view: View, skeleton: Skeleton, letters: Letters) -> None:
    for name, label in context.companion.generalised.items():
        joints = skeleton.record.generalised[name].joints
        centre = np.mean([view(skeleton.points[joint]) for joint in joints], axis=0)
        page.disc(centre, 6.0, "white", INK, 0.6, order=12)
        page.text(centre, label, fontsize=TEXT)
        letters.avoid_disc(centre, 6.0)


def _legend(context: Context) -> list[Line2D]:
    order = list(context.schematic.chains)
    names = context.companion.chains or {name: f"limb {numeral(order.index(name) + 1)}" for name in order}
    colours = [CHAINS[order.index(name) % len(CHAINS)] for name in names]
    return [
        Line2D([], [], color=colour, linewidth=2, label=text)
        for colour, text in zip(colours, names.values(), strict=True)
    ]


def _data(context: Context, skeleton: Skeleton) -> dict[str, Any]:
    return {
        "unit": skeleton.record.unit,
        "parameters": vars(skeleton.record.values),
        "joints": {
            mark.joint.name: {
                "type": mark.joint.type.name,
                "links": [mark.joint.parent, mark.joint.child],
                "at": mark.at,
                "axes": mark.axes,
                "driven": mark.driven,
            }
            for mark in skeleton.marks
        },
        "bars": [
            {"link": rod.link, "label": rod.label, "ends": rod.ends, "points": rod.points} for rod in skeleton.rods
        ],
        "plates": [{"link": plate.link, "points": plate.points} for plate in skeleton.plates],
        "rails": [rail.ends for rail in rails(skeleton, context.companion)],
    }


STRUCTURE = FigureKind("structure", "Kinematic structure", always, _caption, _draw)
