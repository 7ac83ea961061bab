"""The solutions: every assembly at the same inputs, the drawn one in black and the others as ghosts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.canvas import POINTS, Canvas, TextWidths, View, canvas, fitted, inside
from assur.figures.context import Context
from assur.figures.coordinates import unit_after
from assur.figures.labels import label
from assur.figures.letters import letter, mathematics
from assur.figures.mode_letters import add_signs, shown_signs, signs_said
from assur.figures.page import side_by_side
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, cloud_of, draw_bodies, draw_ground
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import BLUE, GREEN, INK, ORANGE, PINK, RED, SKY, SMALL, TEXT, styled
from assur.kinematics.answers.at_border import angle_at_border, pose_at_border
from assur.kinematics.answers.solution import Solution
from assur.kinematics.naming import DescribedSign
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, is_angle
from assur.results.typeset_text import minus
from assur.scene.camera import oblique, plane
from assur.scene.skeleton import Skeleton, skeleton

FloatArray = NDArray[np.float64]
TALLEST = 105.0
GAP, HEAD = 12.0, 15.0
"""Of the drawings, in mm: their height at most, and the white between two and above and below one."""

LEAST_PANEL = 55.0
"""Share of the page's width that a drawing needs at least to stand beside another, in mm."""

LEAST = 0.1
"""Share of the mechanism's size that a drawing spans at least."""

MOST = 8
"""More than these on one another cannot be read."""

DIGITS = ((4, 4), (3, 4), (2, 4), (2, 3), (1, 3), (1, 2))
"""Decimals in the table, of lengths and angles and of quaternions: the first with which it has room, else the last."""

CELL, APART, ROOMY = SMALL + 0.5, 1.2, 14.0
"""Size of its letters in points; white between two columns in mm, at least and at most."""

GHOSTS = (RED, BLUE, GREEN, PINK, SKY, ORANGE, "#7f7f7f")


@dataclass(frozen=True, eq=False)
class Ghost:
    """One assembly: its number, its solution, its skeleton and its colour."""

    number: int
    solution: Solution
    skeleton: Skeleton
    colour: str
    origin: FloatArray


def ghosts(context: Context) -> list[Ghost]:
    """Every listed direct solution at the inputs of the configuration that is drawn; that one comes first."""
    listed = list(context.assemblies)
    values = [np.array(list(item.joints.values())) for item in listed]
    order = np.argsort([context.apart(joints) for joints in values], kind="stable")
    return [_ghost(context, listed[k], number) for number, k in enumerate(order, 1)]


def _ghost(context: Context, solution: Solution, number: int) -> Ghost:
    body = skeleton(context.record, context.companion, np.array(list(solution.joints.values())))
    rotation, origin = body.frames[context.record.platform.link]
    colour = INK if number == 1 else GHOSTS[(number - 2) % len(GHOSTS)]
    return Ghost(number, solution, body, colour, rotation @ context.record.platform.point + origin)


def pictured(record: MechanismRecord, listed: Sequence[Solution], *, numbered: bool) -> Figure:
    """Solutions of one answer on one another, the first in black, `MOST` at most; numbered as they are listed.

    >>> import assur
    >>> record = assur.load("fivebar")
    >>> len(pictured(record, list(record.inverse([0.0, 200.0])), numbered=False).axes)
    1
    """
    with styled():
        context = Context(record)
        found = [_ghost(context, solution, number) for number, solution in enumerate(listed[:MOST], 1)]
        cloud = np.concatenate([cloud_of(item.skeleton, context.companion) for item in found])
        camera = context.camera("solutions", oblique("y", "z", 211, 0.85))
        view, page = fitted(camera, cloud, context.page, TALLEST, margin=GAP)
        _panel(context, page, view, found, numbered=numbered)
    return page.figure


def _missing(context: Context) -> str:
    try:
        return "" if context.record.closed_form or len(context.assemblies) else "no direct solution was found"
    except UsageError as error:
        return error.message


def _caption(context: Context) -> str:
    found = context.assemblies
    names = ", ".join(
        f"${label(item.latex, item.name)}$ = {_printed(context, value, item.coordinate.kind)}"
        for item, value in zip(context.record.inputs, found.given, strict=True)
    )
    what = f"All {len(found)} real direct solutions" if found.complete else f"{len(found)} direct solutions"
    rest = "" if found.complete else f" They are {found.right}."
    if len(found) > MOST:
        rest = f" Drawn are the {MOST} that are nearest to the first.{rest}"
    signs = signs_said(_signs(context))
    said = f" Signs of the mode: {signs}, with joints as in the kinematic model." if signs else ""
    return f"{what} at {names}, with the coordinates of O' and the assembly mode.{rest}{said}"


def _printed(context: Context, value: float, kind: str) -> str:
    angle = kind == "angle"
    digits = 3 if angle and context.record.angle == "deg" else 4
    number = angle_at_border(context.record, value) if angle else value
    return f"{minus(f'{round(float(number), digits) + 0.0:.{digits}f}')}{unit_after(context, angle=angle)}"


def _draw(context: Context) -> Drawing:
    found = ghosts(context)
    table = 9.0 + 4.2 * len(found)
    cameras = [context.camera("solutions", oblique("y", "z", 211, 0.85))]
    if not context.planar:
        cameras.append(plane("x", "z"))
    drawn = found[:MOST]
    cloud = np.concatenate([cloud_of(item.skeleton, context.companion) for item in drawn])
    spans = np.array([np.ptp(camera.project(cloud), axis=0) for camera in cameras])  # (panels, 2)
    # a mechanism whose joints are in one point has symbols there all the same
    spans = np.maximum(spans, LEAST * context.skeleton.size)
    columns = side_by_side(context.page, len(cameras), LEAST_PANEL)
    rows = [list(range(k, min(k + columns, len(cameras)))) for k in range(0, len(cameras), columns)]
    room = context.page - GAP * (columns + 1)
    scale = min(TALLEST / spans[:, 1].max(), *(room / spans[row, 0].sum() for row in rows))
    rooms = scale * spans
    width = max(min(110.0, context.page), *(float(rooms[row, 0].sum()) + GAP * (len(row) + 1) for row in rows))
    heights = [float(rooms[row, 1].max()) + HEAD for row in rows]
    page = canvas(width, sum(heights) + table)
    for number, row in enumerate(rows):
        low = table + sum(heights[number + 1 :])
        left = (width - float(rooms[row, 0].sum()) - GAP * (len(row) - 1)) / 2
        for k in row:
            across, upward = float(rooms[k, 0]), heights[number] - HEAD
            view = inside(cameras[k], cloud, (left, low + 9.0, across, upward))
            _panel(context, page, view, drawn, signs=_signs(context))
            if len(cameras) > 1:
                middle = (left + across / 2) * POINTS
                page.text((middle, (low + 2.5) * POINTS), ("(a)", "(b) XOZ plane")[k], fontsize=TEXT)
            left += across + GAP
    _table(context, page, found, width, table)
    return Drawing(page.figure, _data(context, found))


def _panel(
    context: Context,
    page: Canvas,
    view: View,
    ghosts: list[Ghost],
    *,
    numbered: bool = True,
    signs: Sequence[DescribedSign] = (),
) -> None:
    letters = Letters(page)
    draw_ground(page, view, ghosts[0].skeleton, context.companion, letters)
    for ghost in ghosts[::-1]:
        links = dict.fromkeys(context.record.links, ghost.colour)
        width = 1.7 if ghost.number == 1 else 1.1
        draw_bodies(
            page,
            view,
            ghost.skeleton,
            letters,
            Pen(width, 1.6, 0.6, links, 0.0 if ghost.number == 1 else -1.0),
        )
    for ghost in ghosts:
        page.disc(view(ghost.origin), 1.6, ghost.colour, ghost.colour, order=15)
        letters.avoid_disc(view(ghost.origin), 1.6)
        if numbered:
            letters.add(view(ghost.origin), str(ghost.number), clear=4.0, color=ghost.colour, weight="bold")
    if len(signs) > 1:  # one alone is that of the whole
        add_signs(view, ghosts[0].skeleton, letters, signs)
    letters.place()


def _table(context: Context, page: Canvas, ghosts: list[Ghost], width: float, height: float) -> None:
    """Coordinates of every solution, in its colour, with as many digits as there is room for."""
    record = context.record
    heads = ["", *(_head(context, name) for name in record.platform.pose), _mode_head(context)]
    measured = TextWidths()
    for digits in DIGITS:
        rows = [
            [str(item.number), *_cells(context, item, *digits), minus(item.solution.assembly_mode)] for item in ghosts
        ]
        wide = [
            max(measured(head, TEXT), *(measured(cell, CELL) for cell in column)) / POINTS
            for head, column in zip(heads, zip(*rows, strict=True), strict=True)
        ]
        free = (width - 4.0 - sum(wide)) / len(heads)
        if free >= APART:
            break
    free = min(free, ROOMY)
    left = (width - sum(wide) - free * (len(heads) - 1)) / 2
    middles = [left + sum(wide[:k]) + k * free + wide[k] / 2 for k in range(len(heads))]
    top = height - 3.0
    for middle, head in zip(middles, heads, strict=True):
        page.text((middle * POINTS, top * POINTS), head, fontsize=TEXT)
    page.line(np.array([[left - 2.0, top - 2.4], [width - left + 2.0, top - 2.4]]) * POINTS, 0.5)
    for number, (ghost, row) in enumerate(zip(ghosts, rows, strict=True)):
        for middle, cell in zip(middles, row, strict=True):
            place = (middle * POINTS, (top - 5.0 - 4.2 * number) * POINTS)
            page.text(place, cell, fontsize=CELL, color=ghost.colour)


def _cells(context: Context, ghost: Ghost, digits: int, of_quaternions: int) -> list[str]:
    shown = zip(context.record.platform.pose, pose_at_border(context.record, ghost.solution.pose).tolist(), strict=True)
    kept = [(value, of_quaternions if name in QUATERNION else digits) for name, value in shown]
    return [minus(f"{round(value, places) + 0.0:.{places}f}") for value, places in kept]


def _head(context: Context, name: str) -> str:
    """Title of the column of a coordinate, with its unit; the components of a quaternion have none."""
    unit = "" if name in QUATERNION else f" ({context.record.angle if is_angle(name) else context.record.unit})"
    return f"${mathematics(name) or name}$$\\,${unit}" if unit else f"${mathematics(name) or name}$"


def _mode_head(context: Context) -> str:
    """Title of the column of modes, with the letters of its signs."""
    names = [letter(sign.letter) for sign in _signs(context)]
    short = names if len(names) < 4 else [names[0], "...", names[-1]]
    return f"mode ({', '.join(short)})" if names else "mode"


def _signs(context: Context) -> tuple[DescribedSign, ...]:
    return shown_signs(context.record, ["direct"])


def _data(context: Context, ghosts: list[Ghost]) -> dict[str, Any]:
    return {
        "unit": context.record.unit,
        "inputs": context.assemblies.given,
        "signs": {sign.letter: sign.places for sign in _signs(context)},
        "complete_for": context.assemblies.complete_for,
        "solutions": [
            {
                "number": ghost.number,
                "pose": ghost.solution.pose,
                "mode": ghost.solution.mode,
                "residual": ghost.solution.residual,
                "points": ghost.skeleton.points,
            }
            for ghost in ghosts
        ],
    }


SOLUTIONS = FigureKind("solutions", "All direct solutions at the same inputs", _missing, _caption, _draw)
