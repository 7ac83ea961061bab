"""A configuration as a model, with the links and the lines that its factors' meanings name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from assur.figures.canvas import POINTS, Canvas, View, inside
from assur.figures.context import Context
from assur.figures.letters import letter
from assur.figures.meaning import NamedParts, accented, named, together
from assur.figures.placing import Letters
from assur.figures.solid import model_camera, paste
from assur.figures.style import LETTER, PAPER, RED
from assur.scene.camera import Camera
from assur.scene.mesh import Mesh
from assur.scene.parts import model
from assur.scene.skeleton import Skeleton, skeleton
from assur.singularity.examples import SingularExample

ACCENT, MUTED = "#e07b45", "#c3c8cc"
"""Colours of the links that a meaning names, and of all others where it names any."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A configuration as a model: its skeleton, what its factors' meanings name, its mesh from where it is seen."""

    examples: Sequence[SingularExample]
    body: Skeleton
    named: NamedParts
    mesh: Mesh
    camera: Camera

    @property
    def example(self) -> SingularExample:
        """The first of those that are this configuration."""
        return self.examples[0]

    @property
    def aspect(self) -> float:
        """Height over width on the page."""
        flat = self.camera.project(self.mesh.corners.reshape(-1, 3))
        across, upward = np.ptp(flat, axis=0)
        return float(upward / across)


def scene_of(context: Context, examples: Sequence[SingularExample]) -> Scene:
    """The model of a configuration, given as the examples that are one: their factors all vanish in it."""
    body = skeleton(context.record, context.companion, examples[0].joints)
    found = together([named(example.factor.meaning, body) for example in examples])
    colours = dict.fromkeys(accented(found, body), ACCENT)
    if colours:
        colours = dict.fromkeys(context.record.links, MUTED) | colours
    mesh = model(body, colours)
    return Scene(examples, body, found, mesh, model_camera(context))


def draw_model(page: Canvas, scene: Scene, rectangle: tuple[float, float, float, float], size: float) -> View:
    """The model with the links that the meaning names in colour, and lines through its points; and how it is seen."""
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
    return view


def _plate() -> dict[str, Any]:
    return {"boxstyle": "round,pad=0.08", "facecolor": "#ffffffd0", "edgecolor": "none"}


def _lines(page: Canvas, view: View, parts: NamedParts, letters: Letters) -> None:
    """Each line through the points that are named together, a little longer than they reach."""
    for line in parts.lines:
        flat = view(line)
        gaps = np.linalg.norm(flat[:, None] - flat[None], axis=2)
        first, last = np.unravel_index(np.argmax(gaps), gaps.shape)
        way = flat[last] - flat[first]
        length = max(float(np.linalg.norm(way)), 1e-9)
        ends = np.array([flat[first] - 14 * way / length, flat[last] + 14 * way / length])
        page.line(ends, 2.6, PAPER, 12, solid_capstyle="butt", alpha=0.7)
        page.line(ends, 1.1, RED, 12.1, linestyle=(0, (5, 2)), solid_capstyle="butt")
        letters.avoid(ends)
