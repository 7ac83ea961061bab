"""Singular configurations: a model at a zero of each factor, with what vanishes and what that means."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.letters import letter, mathematics
from assur.figures.meaning import Named, accented, named, typeset
from assur.figures.placing import Letters
from assur.figures.solid import model_camera, paste, triad
from assur.figures.spec import Drawing, Entry
from assur.figures.style import LETTER, PAGE, PAPER, RED, SMALL, TEXT
from assur.kinematics.position import inverse
from assur.kinematics.status import FACTOR_TOLERANCE, Status, relative_factors
from assur.model.closed_form import Factor
from assur.model.pose import LENGTHS, is_angle
from assur.scene.camera import Camera
from assur.scene.mesh import Mesh
from assur.scene.parts import model
from assur.scene.skeleton import Skeleton, skeleton
from assur.singularity.examples import SingularExample

FloatArray = NDArray[np.float64]
ACCENT, MUTED = "#e07b45", "#c3c8cc"
"""Colours of the links that a meaning names, and of all others where it names any."""

COLUMNS = 3
TEXT_HEIGHT = 17.0


def example_of(context: Context, kind: str) -> SingularExample | None:
    """The example that the source draws of a kind, else the first of that kind."""
    wanted = getattr(context.companion.examples, kind)
    found = [item for item in context.examples if item.factor.kind == kind]
    return next((item for item in found if item.factor.name == wanted), found[0] if found else None)


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
        return f"no path from home met a {kind} singularity in or near the file's workspace box"
    return f"no {kind} factor vanishes in or near the file's workspace box"


def _missing_further(context: Context) -> str:
    if _nowhere_to_look(context) or further(context):
        return _nowhere_to_look(context)
    if context.record.closed_form is None:
        return "no path from home met a further kind of singularity in or near the file's box"
    return "no further factor vanishes in or near the file's box"


def condition(factor: Factor) -> str:
    """E.g. "$u_3 = 0$"."""
    return f"{symbol_of(factor)[:-1]} = 0$"


def symbol_of(factor: Factor) -> str:
    """A factor as mathematics, e.g. "$u_3$"."""
    words = rf"\mathrm{{{factor.name}}}".replace("_", r"\ ")
    return f"${factor.latex or mathematics(factor.name) or words}$"


def _caption(kind: str, context: Context) -> str:
    example = example_of(context, kind)
    if example is None:
        return ""
    of_path = "" if context.record.closed_form else ", at which a path from home stops"
    return (
        f"Example of a {kind} singularity{of_path}: {condition(example.factor)}, {_geometry(context, example.factor)}."
        f" {_where(context, shown(context, example))}"
    )


def _caption_further(context: Context) -> str:
    if context.record.closed_form is None:
        return "One configuration of each further kind of singularity at which a path from home stops."
    return (
        "One configuration for each further factor that vanishes in the file's workspace box or near it, with the"
        " factor, its kind and its geometric meaning. Where several vanish together the most severe status is given."
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
    status = example.status.name.replace("_", "-")
    mode = f"Working mode {signs(example.mode)}, pose" if example.mode else "Pose"
    return f"{mode} ({pose}){unit}; status {status}."


def _value(context: Context, name: str, value: float) -> str:
    degrees = is_angle(name) and context.record.angle == "deg"
    shown = np.degrees(value) if degrees else value
    mixed = name in LENGTHS and not all(other in LENGTHS for other in context.record.platform.pose)
    unit = "°" if degrees else f" {context.record.unit}" if mixed else ""
    digits = 2 if degrees or context.skeleton.size > 20 else 4
    return f"{round(shown, digits) + 0.0:.{digits}f}".replace("-", "−") + unit


def signs(mode: str) -> str:
    """A mode with minus signs as wide as plus signs."""
    return mode.replace("-", "−")


def _draw_one(kind: str, context: Context) -> Drawing:
    example = example_of(context, kind)
    if example is None:
        raise ValueError(_missing(kind, context))
    scene = _scene(context, example)
    width = 120.0
    height = min(130.0, (width - 8.0) * scene.aspect)
    page = canvas(width, height + 23.0)
    _panel(page, scene, (4.0, 19.0, width - 8.0, height), LETTER)
    lines = textwrap.wrap(example.factor.meaning, 56)
    for k, line in enumerate(lines):
        start = f"{condition(example.factor)}: " if k == 0 else ""
        at = (width / 2 * POINTS, (8.5 + 4.5 * (len(lines) - 1 - k)) * POINTS)
        page.text(at, start + typeset(line, scene.body), fontsize=LETTER)
    page.text((width / 2 * POINTS, 3.3 * POINTS), _where(context, scene.example), fontsize=SMALL)
    triad(page, model_camera(context), np.array([18.0, 70.0]))
    return Drawing(page.figure, {"unit": context.record.unit, "examples": [_data(scene)]})


def _draw_further(context: Context) -> Drawing:
    scenes = [_scene(context, example) for example in further(context)]
    columns = min(COLUMNS, len(scenes))
    rows = [scenes[k : k + columns] for k in range(0, len(scenes), columns)]
    width = PAGE / COLUMNS
    heights = [TEXT_HEIGHT + 2 + (width - 4) * max(scene.aspect for scene in row) for row in rows]
    page = canvas(width * columns, sum(heights))
    for k, scene in enumerate(scenes):
        place = (k % columns) * width, sum(heights[k // columns + 1 :])
        _small(page, scene, f"({chr(97 + k)})", (*place, width, heights[k // columns]))
    data = {"unit": context.record.unit, "examples": [_data(scene) for scene in scenes]}
    return Drawing(page.figure, data)


def _small(page: Canvas, scene: _Scene, label: str, cell: tuple[float, float, float, float]) -> None:
    """One of several: the model above, its words below, in a cell (left, bottom, width, height) in mm."""
    left, bottom, width, height = cell
    _panel(page, scene, (left + 2, bottom + TEXT_HEIGHT, width - 4, height - TEXT_HEIGHT - 2), TEXT)
    factor = scene.example.factor
    meaning = [typeset(line, scene.body) for line in textwrap.wrap(factor.meaning, 46)[:2]]
    mode = f"mode {signs(scene.example.mode)}, " if scene.example.mode else ""
    note = f"{mode}status {scene.example.status.name.replace('_', '-')}"
    note += "" if scene.example.in_box else ", outside the box"
    at = np.array([left + width / 2, bottom + TEXT_HEIGHT - 3.5])
    page.text(at * POINTS, f"{label} {condition(factor)} ({factor.kind})", fontsize=TEXT)
    for k, line in enumerate([*meaning, note]):
        page.text((at - [0, 3.9 + 3.2 * k]) * POINTS, line, fontsize=SMALL)


@dataclass(frozen=True, eq=False)
class _Scene:
    """An example as a model: its skeleton, what its factor's meaning names, and its mesh from where it is seen."""

    example: SingularExample
    body: Skeleton
    named: Named
    mesh: Mesh
    camera: Camera

    @property
    def aspect(self) -> float:
        """Height over width on the page."""
        flat = self.camera.project(self.mesh.corners.reshape(-1, 3))
        across, upward = np.ptp(flat, axis=0)
        return float(upward / across)


def shown(context: Context, example: SingularExample) -> SingularExample:
    """The example moved to the drawn configuration in as many pose coordinates as leave it what it is."""
    if context.record.closed_form is None:
        return example  # it lies where a path stopped
    home = context.pose
    size = len(example.pose)
    for count in range(size, 0, -1):
        for chosen in combinations(range(size), count):
            pose = example.pose.copy()
            pose[list(chosen)] = home[list(chosen)]
            here = inverse(context.record, pose, example.mode)
            value = relative_factors(context.record, here.factors)[example.factor.name][0]
            same = bool(here.exists[0]) and Status(int(here.status[0])) == example.status
            if same and abs(float(value)) <= FACTOR_TOLERANCE:
                return replace(example, pose=pose, inputs=here.inputs[0], joints=here.joints[0])
    return example


def _scene(context: Context, example: SingularExample) -> _Scene:
    example = shown(context, example)
    body = skeleton(context.record, context.companion, example.joints)
    found = named(example.factor.meaning, body)
    colours = dict.fromkeys(accented(found, body), ACCENT)
    if colours:
        colours = dict.fromkeys(context.record.links, MUTED) | colours
    mesh = model(body, context.companion, colours)
    return _Scene(example, body, found, mesh, model_camera(context))


def _panel(page: Canvas, scene: _Scene, rectangle: tuple[float, float, float, float], size: float) -> None:
    """The model with the links that the meaning names in colour, and lines through its points."""
    left, bottom, width, height = rectangle
    view = inside(scene.camera, scene.mesh.corners.reshape(-1, 3), (left + 1, bottom + 1, width - 2, height - 2))
    weight = 1.0 if size == LETTER else 0.7
    paste(page, scene.mesh, view, (left * POINTS, bottom * POINTS, width * POINTS, height * POINTS), weight)
    letters = Letters(page)
    _lines(page, view, scene.named, letters)
    for name in scene.named.letters:
        at = view(scene.body.points[name])
        page.disc(at, 1.8, RED, PAPER, 0.5, order=13)
        letters.add(at, letter(name), clear=4.0, fontsize=size, color=RED, weight="bold", bbox=_plate())
    letters.place()


def _plate() -> dict[str, Any]:
    return {"boxstyle": "round,pad=0.08", "facecolor": "#ffffffd0", "edgecolor": "none"}


def _lines(page: Canvas, view: View, found: Named, letters: Letters) -> None:
    """Each line through the points that are named together, a little longer than they reach."""
    for line in found.lines:
        flat = view(line)
        gaps = np.linalg.norm(flat[:, None] - flat[None], axis=2)
        first, last = np.unravel_index(np.argmax(gaps), gaps.shape)
        way = flat[last] - flat[first]
        length = max(float(np.linalg.norm(way)), 1e-9)
        ends = np.array([flat[first] - 14 * way / length, flat[last] + 14 * way / length])
        page.line(ends, 2.6, PAPER, 12, solid_capstyle="butt", alpha=0.7)
        page.line(ends, 1.1, RED, 12.1, linestyle=(0, (5, 2)), solid_capstyle="butt")
        letters.avoid(ends)


def _data(scene: _Scene) -> dict[str, Any]:
    example = scene.example
    return {
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


SERIAL = Entry(
    "serial",
    "Serial singularity",
    partial(_missing, "serial"),
    partial(_caption, "serial"),
    partial(_draw_one, "serial"),
)
PARALLEL = Entry(
    "parallel",
    "Parallel singularity",
    partial(_missing, "parallel"),
    partial(_caption, "parallel"),
    partial(_draw_one, "parallel"),
)
SINGULAR = Entry(
    "singular",
    "Singular configurations of the further factors",
    _missing_further,
    _caption_further,
    _draw_further,
)
