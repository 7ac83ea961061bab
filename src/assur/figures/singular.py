"""Singular configurations: a model at a zero of each factor, with what vanishes and what that means."""

from __future__ import annotations

import textwrap
from functools import partial
from typing import Any

import numpy as np

from assur.figures.canvas import POINTS, Canvas, canvas
from assur.figures.configuration import Scene, draw_model, scene_of
from assur.figures.context import Context
from assur.figures.coordinates import shown
from assur.figures.labels import label
from assur.figures.meaning import typeset
from assur.figures.page import side_by_side
from assur.figures.solid import triad
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import LETTER, SMALL, TEXT
from assur.joint_graph.points import quantity
from assur.model.closed_form import Factor
from assur.model.formula import parse
from assur.model.pose import LENGTHS, is_angle, kind_of
from assur.results.typeset_text import minus
from assur.scene.skeleton import skeleton
from assur.singularity.examples import AGAIN_SAMPLES, SAMPLES, SingularExample

COLUMNS, LEAST, WIDTH = 3, 44.0, 120.0
"""Of several, the least width of one and that of one alone, in mm."""

PAIR = 55.0
"""Mm in which two factors stand on one line."""

LETTERS, NOTES = 2.1, 1.26
"""Mm of a line for each of its letters, of text and of notes."""
HEAD, LINE = 3.9, 3.2
"""Heights of a line of a heading, and of one below it, in mm."""

SAME = 1e-5
"""Configurations whose points are apart by less than this share of the mechanism's size are one to the eye."""


def example_of(context: Context, kind: str) -> SingularExample | None:
    """The example that the source draws of a kind, else the first of that kind."""
    met = [item for item in context.examples if item.factor.kind == kind]
    wanted = getattr(context.companion.examples, kind)
    if not wanted or not met:
        return met[0] if met else None
    values = np.abs(quantity(context.record, parse(wanted), np.array([item.joints for item in context.examples])))
    drawn = {id(item) for item, value in zip(context.examples, values, strict=True) if value <= SAME * np.max(values)}
    return next((item for item in met if id(item) in drawn), met[0])


def further(context: Context) -> list[SingularExample]:
    """The examples that have no figure of their own."""
    own = [example_of(context, "serial"), example_of(context, "parallel")]
    return [item for item in context.examples if all(item is not other for other in own)]


def _nowhere_to_look(context: Context) -> str:
    """Why no singular configuration is looked for; empty where one is."""
    missing = [name for name in context.record.platform.pose if name not in context.record.box]
    return f"the mechanism's file gives no interval for {', '.join(missing)}" if missing else ""


def _missing(kind: str, context: Context) -> str:
    if _nowhere_to_look(context) or example_of(context, kind):
        return _nowhere_to_look(context)
    if context.record.closed_form is None:
        return f"no {kind} singularity was met: {_looked(context)}"
    return f"no {kind} factor was seen to vanish: {_looked(context)}"


def _missing_further(context: Context) -> str:
    if _nowhere_to_look(context) or further(context):
        return _nowhere_to_look(context)
    if context.record.closed_form is None:
        return f"no further kind of singularity was met: {_looked(context)}"
    return f"no further factor was seen to vanish: {_looked(context)}"


def _looked(context: Context) -> str:
    """Where singular configurations were looked for: a sample, which proves nothing."""
    if context.record.closed_form is None:
        return (
            "some paths from home to poses by chance, in the file's box and in one three times as wide, were followed,"
            " and ways across what the map of the workspace shows"
        )
    return (
        f"{SAMPLES} poses by chance in the file's box and {SAMPLES} in one three times as wide, in every working mode,"
        f" and {AGAIN_SAMPLES} in the box in the default mode were looked at"
    )


def condition(factor: Factor) -> str:
    """E.g. "$u_3 = 0$"."""
    return f"{symbol_of(factor)[:-1]} = 0$"


def symbol_of(factor: Factor) -> str:
    """A factor as mathematics, e.g. "$u_3$"."""
    return f"${label(factor.latex, factor.name)}$"


def _caption(kind: str, context: Context) -> str:
    example = example_of(context, kind)
    if example is None:
        return ""
    of_path = "" if context.record.closed_form else ", at which a path that began at home stops"
    return (
        f"Example of a {kind} singularity{of_path}: {condition(example.factor)}, {_geometry(context, example.factor)}."
        f" {_where(context, example)}"
    )


def _caption_further(context: Context) -> str:
    if context.record.closed_form is None:
        return "One configuration of each further kind of singularity at which a path that began at home stops."
    return (
        "Configurations in which the further factors vanish, in the file's workspace box or near it, with what each"
        " factor means and, in brackets, the status there, of several the most severe. Factors that vanish in the"
        " same configuration share a panel."
    )


def _geometry(context: Context, factor: Factor) -> str:
    """The meaning of a factor with its letters as they are drawn, and where the source says so."""
    source = f" [Eq. {factor.equation}]" if factor.equation.startswith("(") else ""
    return typeset(factor.meaning, context.skeleton) + source


def _where(context: Context, example: SingularExample) -> str:
    pose = ", ".join(
        _value(context, name, value) for name, value in zip(context.record.platform.pose, example.pose, strict=True)
    )
    unit = f" {context.record.unit}" if all(name in LENGTHS for name in context.record.platform.pose) else ""
    mode = f"Working mode {minus(example.mode)}, pose" if example.mode else "Pose"
    return f"{mode} ({pose}){unit}; status {_status(example)}."


def _value(context: Context, name: str, value: float) -> str:
    degrees = is_angle(name) and context.record.angle == "deg"
    number = shown(context, name, value)
    mixed = name in LENGTHS and not all(other in LENGTHS for other in context.record.platform.pose)
    unit = "°" if degrees else f" {context.record.unit}" if mixed else ""
    digits = 2 if degrees or (kind_of(name) and context.skeleton.size > 20) else 4
    return minus(f"{round(number, digits) + 0.0:.{digits}f}") + unit


def _draw_one(kind: str, context: Context) -> Drawing:
    example = example_of(context, kind)
    if example is None:
        raise ValueError(_missing(kind, context))
    scene = scene_of(context, [example])
    width = min(WIDTH, context.page)
    height = min(130.0, (width - 8.0) * scene.aspect)
    lines = textwrap.wrap(example.factor.meaning, min(56, int(width / LETTERS)))
    foot = max(19.0, 10.0 + 4.5 * len(lines))
    page = canvas(width, height + foot + 4.0)
    view = draw_model(page, scene, (4.0, foot, width - 8.0, height), LETTER)
    for k, line in enumerate(lines):
        start = f"{condition(example.factor)}: " if k == 0 else ""
        at = (width / 2 * POINTS, (8.5 + 4.5 * (len(lines) - 1 - k)) * POINTS)
        page.text(at, start + typeset(line, scene.body), fontsize=LETTER)
    page.text((width / 2 * POINTS, 3.3 * POINTS), _where(context, scene.example), fontsize=SMALL)
    triad(page, scene.mesh, view, np.array([[0.0, foot], [width, foot + height]]) * POINTS)
    return Drawing(page.figure, {"unit": context.record.unit, "examples": _data(scene)})


def _draw_further(context: Context) -> Drawing:
    scenes = [scene_of(context, examples) for examples in _configurations(context)]
    room = side_by_side(context.page, COLUMNS, LEAST)
    columns = min(room, len(scenes))
    rows = [scenes[k : k + columns] for k in range(0, len(scenes), columns)]
    width = min(context.page / room, WIDTH)
    feet = [
        3.5 + max(HEAD * len(_heading(scene, width)) + LINE * len(_words(scene, width)) for scene in row)
        for row in rows
    ]
    heights = [
        foot + 2 + (width - 4) * max(scene.aspect for scene in row) for foot, row in zip(feet, rows, strict=True)
    ]
    page = canvas(width * columns, sum(heights))
    data = []
    for k, scene in enumerate(scenes):
        label, row = f"({chr(97 + k)})", k // columns
        cell = (k % columns) * width, sum(heights[row + 1 :]), width, heights[row]
        _small(page, scene, label, cell, feet[row])
        data += [{"panel": label, **item} for item in _data(scene)]
    return Drawing(page.figure, {"unit": context.record.unit, "examples": data})


def _configurations(context: Context) -> list[list[SingularExample]]:
    """The further examples as they are drawn, those that are one and the same configuration together."""
    found: list[list[SingularExample]] = []
    for example in further(context):
        same = [group for group in found if _apart(context, group[0], example) <= SAME * context.skeleton.size]
        if same:
            same[0].append(example)
        else:
            found.append([example])
    return found


def _apart(context: Context, one: SingularExample, other: SingularExample) -> float:
    """The largest distance between the same point of two configurations."""
    first, second = (skeleton(context.record, context.companion, item.joints).points for item in (one, other))
    return max(float(np.linalg.norm(at - second[name])) for name, at in first.items())


def _heading(scene: Scene, width: float) -> list[str]:
    """What vanishes, two factors on a line where `width` mm are enough, and the status there."""
    conditions = [condition(item.factor) for item in scene.examples]
    several = 2 if width >= PAIR else 1
    lines = [", ".join(conditions[k : k + several]) for k in range(0, len(conditions), several)]
    return [*lines[:-1], f"{lines[-1]} ({_status(scene.example)})"]


def _words(scene: Scene, width: float) -> list[str]:
    """Every meaning, on as many lines of `width` mm as it needs, and the mode."""
    lines = [line for item in scene.examples for line in textwrap.wrap(item.factor.meaning, int(width / NOTES))]
    notes = [f"mode {minus(scene.example.mode)}"] if scene.example.mode else []
    notes += [] if scene.example.in_box else ["outside the box"]
    return [*(typeset(line, scene.body) for line in lines), *([", ".join(notes)] if notes else [])]


def _status(example: SingularExample) -> str:
    return example.status.name.replace("_", "-")


def _small(page: Canvas, scene: Scene, label: str, cell: tuple[float, float, float, float], foot: float) -> None:
    """One of several: the model above, its words at the foot, in a cell (left, bottom, width, height) in mm."""
    left, bottom, width, height = cell
    draw_model(page, scene, (left + 2, bottom + foot, width - 4, height - foot - 2), TEXT)
    at = np.array([left + width / 2, bottom + foot - 3.5])
    first, *rest = _heading(scene, width)
    for line in (f"{label} {first}", *rest):
        page.text(at * POINTS, line, fontsize=TEXT)
        at = at - [0, HEAD]
    for line in _words(scene, width):
        page.text(at * POINTS, line, fontsize=SMALL)
        at = at - [0, LINE]


def _data(scene: Scene) -> list[dict[str, Any]]:
    return [
        {
            "factor": example.factor.name,
            "kind": example.factor.kind,
            "meaning": example.factor.meaning,
            "mode": example.mode,
            "status": example.status,
            "in_box": example.in_box,
            "pose": example.pose,
            "inputs": example.inputs,
            "points": scene.body.points,
        }
        for example in scene.examples
    ]


SERIAL = FigureKind(
    "serial",
    "Serial singularity",
    partial(_missing, "serial"),
    partial(_caption, "serial"),
    partial(_draw_one, "serial"),
)
PARALLEL = FigureKind(
    "parallel",
    "Parallel singularity",
    partial(_missing, "parallel"),
    partial(_caption, "parallel"),
    partial(_draw_one, "parallel"),
)
SINGULAR = FigureKind(
    "singular",
    "Singular configurations of the further factors",
    _missing_further,
    _caption_further,
    _draw_further,
)
