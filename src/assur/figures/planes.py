"""The planes: for each direction of axes about which the source counts an angle, the parts that turn in that plane."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.dimensions import Arc, arcs, draw_arcs, draw_frame
from assur.figures.labels import formula_text, label
from assur.figures.letters import letter
from assur.figures.page import side_by_side
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, chain_colours, draw_bodies
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import GREY, INK, TEXT
from assur.scene.camera import AXES, Camera, plane
from assur.scene.companion import DrawnMeasure
from assur.scene.letters import lettered
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
LEAST = 55.0
"""Share of the page's width that a plane needs at least to stand beside another, in mm."""

PLANES = {"y": ("x", "z"), "x": ("y", "z"), "z": ("x", "y")}
"""Direction of the axes -> the coordinates to the right and upwards."""


@dataclass(frozen=True, eq=False)
class PlanarPart:
    """What moves in one plane: its normal, the angles that are counted in it, and the skeleton of its links."""

    normal: str
    arcs: tuple[Arc, ...]
    skeleton: Skeleton

    @property
    def camera(self) -> Camera:
        """The plane at a right angle."""
        return plane(*PLANES[self.normal])

    @property
    def title(self) -> str:
        """E.g. "XOZ plane"."""
        right, up = PLANES[self.normal]
        return f"{right.upper()}O{up.upper()} plane"


def parts(context: Context) -> list[PlanarPart]:
    """The planes with a named angle, most angles first."""
    skeleton = context.schematic
    found = arcs(skeleton, 0.1 * skeleton.size)
    groups: dict[str, list[Arc]] = {}
    for arc in found:
        joint = skeleton.record.angles.get(arc.name)
        mark = next((mark for mark in skeleton.marks if joint and mark.joint.name == joint.joint), None)
        normal = _normal(mark.axes[0]) if mark else None
        if normal:
            groups.setdefault(normal, []).append(arc)
    ordered = sorted(groups, key=lambda normal: -len(groups[normal]))
    return [PlanarPart(normal, tuple(groups[normal]), _part_of(skeleton, normal)) for normal in ordered]


def _normal(axis: FloatArray) -> str | None:
    return next((name for name, unit in AXES.items() if abs(float(axis @ unit)) > 1 - 1e-9), None)


def _part_of(skeleton: Skeleton, normal: str) -> Skeleton:
    """The joints whose axes are normal to a plane, with their links."""
    turning = [
        mark for mark in skeleton.marks if not mark.slides and len(mark.axes) and _normal(mark.axes[0]) == normal
    ]
    links = {link for mark in turning for link in (mark.joint.parent, mark.joint.child)}
    return replace(
        skeleton,
        rods=tuple(rod for rod in skeleton.rods if rod.link in links and _seen(rod.points, normal)),
        plates=tuple(plate for plate in skeleton.plates if plate.link in links),
        marks=tuple(turning),
        points={name: at for name, at in skeleton.points.items() if _link_of(skeleton, name) & links},
    )


def _seen(points: FloatArray, normal: str) -> bool:
    """Whether a rod is not along the line of sight."""
    return bool(np.linalg.norm(np.delete(points[1] - points[0], "xyz".index(normal))) > 1e-6)


def _link_of(skeleton: Skeleton, name: str) -> set[str]:
    record = skeleton.record
    if name in record.points:
        return {record.points[name].link}
    return {record.joints[name].parent, record.joints[name].child}


def _missing(context: Context) -> str:
    if context.planar:
        return "the mechanism moves in one plane, which the model shows already"
    return "" if parts(context) else "the mechanism's file names no angle about X, Y or Z"


def _caption(context: Context) -> str:
    angles = "; ".join(
        f"({chr(97 + k)}) {part.title}, {', '.join(f'${arc.latex}$' for arc in part.arcs)}"
        for k, part in enumerate(parts(context))
    )
    return f"Geometric relations in the planes in which the source counts its angles: {angles}.{context.schematic_note}"


def _draw(context: Context) -> Drawing:
    found = parts(context)
    height, gap = 84.0, 13.0
    rows = [found] if side_by_side(context.page, len(found), LEAST) == len(found) else [[part] for part in found]
    page = canvas(context.page, height * len(rows))
    letters = Letters(page)
    for k, row in enumerate(rows):
        low, left = height * (len(rows) - 1 - k), gap
        for part, width in zip(row, _widths(row, context.page - gap * (len(row) + 1)), strict=True):
            view = inside(part.camera, _cloud(part), (left, low + 17.0, width, height - 24.0))
            _panel(context, page, view, part, letters)
            label = f"({chr(97 + found.index(part))}) {part.title}"
            page.text(((left + width / 2) * POINTS, (low + 3.5) * POINTS), label, fontsize=TEXT)
            left += width + gap
    letters.place()
    return Drawing(page.figure, {"unit": context.record.unit, "planes": [_data(part) for part in found]})


def _widths(parts: list[PlanarPart], room: float) -> list[float]:
    """Widths in mm in proportion to those of the parts, so that all are drawn to about one scale."""
    spans = [float(np.ptp(part.camera.project(_cloud(part))[:, 0])) for part in parts]
    return [room * span / sum(spans) for span in spans]


def _cloud(part: PlanarPart) -> FloatArray:
    """Points of the links, and where the directions that angles are counted from end."""
    ends = [arc.corner + 2 * (arc.points[0] - arc.corner) for arc in part.arcs]
    return np.concatenate([part.skeleton.cloud, ends])


def _panel(context: Context, page: Canvas, view: View, part: PlanarPart, letters: Letters) -> None:
    skeleton = part.skeleton
    colours = chain_colours(context.schematic)
    draw_bodies(page, view, skeleton, letters, Pen(width=1.5, symbol=0.75, colours=colours))
    draw_arcs(page, view, list(part.arcs), letters)
    names = {name: at for name, at in lettered(context.schematic).items() if name in skeleton.points}
    for name, at in _apart(view, names).items():
        page.disc(view(at), 1.2, "black", "black", 0.3, 9.5)
        letters.add(view(at), name, clear=4.0)
    _lengths(view, skeleton, letters)
    _corner(page, view, skeleton, letters)
    for measure in context.companion.measures:
        if measure.along in PLANES[part.normal] and all(name in skeleton.points for name in measure.ends):
            _measure(page, view, skeleton, measure, letters)


def _apart(view: View, names: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Letters with their places; those that fall on one place are one text."""
    groups: list[tuple[list[str], FloatArray]] = []
    for name, at in names.items():
        group = next((item for item in groups if np.linalg.norm(view(item[1]) - view(at)) < 1.0), None)
        if group:
            group[0].append(name)
        else:
            groups.append(([name], at))
    return {", ".join(letter(name) for name in together): at for together, at in groups}


def _lengths(view: View, skeleton: Skeleton, letters: Letters) -> None:
    done: list[tuple[str, FloatArray]] = []
    for rod in skeleton.rods:
        flat = view(rod.points)
        whole = abs(float(np.linalg.norm(flat[1] - flat[0])) - view.scale * rod.size) < 1e-6
        way = flat[1] - flat[0]
        if not (rod.length and whole) or any(text == rod.length and np.allclose(way, other) for text, other in done):
            continue
        done.append((rod.length, way))
        letters.add_along(flat, formula_text(rod.length), clear=2.0, fontsize=TEXT)


def _corner(page: Canvas, view: View, skeleton: Skeleton, letters: Letters) -> None:
    """The base axes in the lower left corner of a panel, for their directions only."""
    flat = view(skeleton.cloud)
    corner = flat.min(axis=0) - [12.0, 22.0]
    size = 20.0 / view.scale
    base = skeleton.frames[skeleton.record.base]
    shifted = View(view.camera, view.scale, corner - view.scale * view.camera.project(base[1]))
    draw_frame(page, shifted, base, base[1], size, "", letters)


def _measure(page: Canvas, view: View, skeleton: Skeleton, measure: DrawnMeasure, letters: Letters) -> None:
    """A measure outside the drawing, below it or to its right."""
    ends = view(np.array([skeleton.points[name] for name in measure.ends]))
    flat = view(skeleton.cloud)
    across = view.camera.image[0]["xyz".index(measure.along)] == 0
    if across:
        level = float(flat[:, 0].max()) + 14.0
        feet = np.column_stack([[level, level], ends[:, 1]])
    else:
        level = float(flat[:, 1].min()) - 13.0
        feet = np.column_stack([ends[:, 0], [level, level]])
    for end, foot in zip(ends, feet, strict=True):
        way = (foot - end) / max(float(np.linalg.norm(foot - end)), 1e-9)
        page.line(np.array([end + 4 * way, foot + 2 * way]), 0.4, GREY, 1.5)
        letters.avoid(np.array([end + 4 * way, foot]))
    page.arrow(feet[0], feet[1], INK, 0.6, 9, style="<|-|>", head=5)
    letters.avoid(feet)
    letters.add_along(feet, f"${label(measure.latex, measure.length or measure.along)}$", clear=1.5, fontsize=TEXT)


def _data(part: PlanarPart) -> dict[str, Any]:
    right, up = PLANES[part.normal]
    keep = ["xyz".index(right), "xyz".index(up)]
    return {
        "plane": [right, up],
        "angles_rad": {arc.name: arc.value for arc in part.arcs},
        "points": {name: at[keep] for name, at in part.skeleton.points.items()},
    }


PLANES_FIGURE = FigureKind("planes", "Geometric relations in the planes of the loops", _missing, _caption, _draw)
