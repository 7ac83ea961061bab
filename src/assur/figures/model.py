"""The kinematic model: the mechanism with the letters of its points, its frames, angles, inputs and lengths."""

from __future__ import annotations

from typing import Any

import numpy as np

from assur.figures.canvas import View, fitted
from assur.figures.context import Context
from assur.figures.dimensions import arcs, draw_arcs, draw_frame, draw_measures, draw_placements
from assur.figures.labels import formula_text
from assur.figures.letters import PRIME, letter
from assur.figures.measures import Measures, measures
from assur.figures.mode_letters import add_signs, shown_signs, signs_said
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, chain_colours, cloud_of, draw_bodies, draw_ground
from assur.figures.spec import Drawing, FigureKind, always
from assur.figures.style import GREY, TEXT
from assur.scene.camera import Camera, oblique
from assur.scene.hull import hull
from assur.scene.letters import lettered
from assur.scene.rails import rails
from assur.scene.skeleton import Skeleton


def _camera(context: Context) -> Camera:
    return context.camera("model", oblique("y", "z", 216, 0.6))


def _measures(context: Context) -> Measures:
    return context.kept("measures", lambda: measures(context.schematic, _camera(context)))


def _undrawn(context: Context) -> str:
    """What the caption says of parameters that the figure does not show; those of one reason in one clause."""
    reasons: dict[str, list[str]] = {}
    for name, reason in _measures(context).undrawn.items():
        reasons.setdefault(reason, []).append(formula_text(name))
    clauses = [f"{', '.join(names)} ({reason})" for reason, names in reasons.items()]
    return f" Not drawn: {'; '.join(clauses)}." if clauses else ""


def _caption(context: Context) -> str:
    record = context.record
    angles = (
        "" if not record.angles else f" Angles {', '.join(letter(name) for name in record.angles)} are joint values."
    )
    signs = signs_said(shown_signs(record))
    return (
        "Kinematic model: points, base frame O-XYZ, moving frame O'-X'Y'Z', inputs and lengths."
        f"{angles}{_undrawn(context)}{f' Letters in frames are signs of modes: {signs}.' if signs else ''}"
        f"{context.schematic_note}"
    )


def _draw(context: Context) -> Drawing:
    skeleton, companion = context.schematic, context.companion
    camera, shown = _camera(context), _measures(context)
    size = 0.13 * skeleton.size
    platform = skeleton.record.platform
    moving = skeleton.frames[platform.link]
    origin = moving[0] @ platform.point + moving[1]
    frames = np.concatenate([np.zeros((1, 3)), origin + size * moving[0].T])
    cloud = [cloud_of(skeleton, companion), frames, *(step.points for step in shown.steps)]
    view, page = fitted(camera, np.concatenate(cloud), min(150, context.page), 105, margin=11)
    letters = Letters(page)
    draw_ground(page, view, skeleton, companion, letters)
    ends = [point for rail in rails(skeleton, companion) for point in rail.ends]
    if len(ends) > 2:
        page.polygon(hull(view(np.array(ends))), "none", GREY, 0.5, 0.5, linestyle=(0, (4, 3)))
    draw_bodies(page, view, skeleton, letters, Pen(width=1.5, symbol=0.75, colours=chain_colours(skeleton)))
    found = arcs(skeleton, 0.1 * skeleton.size)
    draw_arcs(page, view, found, letters)
    base = skeleton.frames[skeleton.record.base]
    draw_frame(page, view, base, base[1], size, "", letters)
    letters.add(view(base[1]), "$O$")
    draw_frame(page, view, moving, origin, size, PRIME, letters)
    draw_measures(page, view, skeleton, letters)
    draw_placements(page, view, skeleton, shown, letters)
    for name, at in lettered(skeleton).items():
        page.disc(view(at), 1.2, "black", "black", 0.3, 9.5)
        moves = np.linalg.norm(origin - at) <= 1e-9
        letters.add(view(at), letter("O'" if moves and name == "O" else name), clear=4.0)
    if all(np.linalg.norm(origin - at) > 1e-9 for at in lettered(skeleton).values()):
        letters.add(view(origin), letter("O'"), clear=4.0)
    _name_lengths(view, skeleton, letters)
    add_signs(view, skeleton, letters, shown_signs(context.record))
    letters.place()
    return Drawing(page.figure, _data(skeleton, context))


def _name_lengths(view: View, skeleton: Skeleton, letters: Letters) -> None:
    done: set[tuple[str, str]] = set()
    chain = skeleton.chain_of()
    for rod in skeleton.rods:
        key = (chain.get(rod.link, ""), rod.length)
        if rod.length and rod.size > 0 and key not in done:
            done.add(key)
            letters.add_along(view(rod.points), formula_text(rod.length), clear=2.0, fontsize=TEXT, style="italic")


def _data(skeleton: Skeleton, context: Context) -> dict[str, Any]:
    record = skeleton.record
    platform = skeleton.frames[record.platform.link]
    return {
        "unit": record.unit,
        "parameters": vars(record.values),
        "points": {name: skeleton.points[name] for name in lettered(skeleton)},
        "platform": platform[0] @ record.platform.point + platform[1],
        "angles_rad": {arc.name: arc.value for arc in arcs(skeleton, 1.0)},
        "joint_values": dict(
            zip(
                [f"{item.joint}.{item.component}" for item in record.coordinates],
                skeleton.values,
                strict=True,
            )
        ),
        "lengths": {f"{rod.ends[0]}-{rod.ends[1]}": rod.length for rod in skeleton.rods if rod.length},
        "signs": {sign.letter: sign.places for sign in shown_signs(context.record)},
        "note": context.schematic_note.strip(),
    }


MODEL = FigureKind("model", "Kinematic model", always, _caption, _draw)
