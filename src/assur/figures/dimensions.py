"""Dimensions: angles as arcs in space, frames as arrows, inputs as measures along their rails, lengths as letters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, guide
from assur.figures.labels import label
from assur.figures.measures import Measures
from assur.figures.placing import Letters
from assur.figures.style import BLUE, INK, RED, TEXT
from assur.figures.symbols import direction
from assur.joint_graph.frames import Frame
from assur.numerics import rotations
from assur.scene.skeleton import JointMark, Skeleton

FloatArray = NDArray[np.float64]
SAMPLES = 48


@dataclass(frozen=True, eq=False)
class Arc:
    """An angle of a joint as it is drawn.

    Attributes:
        value: in rad, counted about the joint's axis.
        corner: (3,) where the joint is.
        sides: (2, 3) unit vectors, the first at angle zero, the second along the part that turns.
        points: (k, 3) from the first side to the second.
    """

    name: str
    latex: str
    value: float
    corner: FloatArray
    sides: FloatArray
    points: FloatArray


def arcs(skeleton: Skeleton, radius: float) -> list[Arc]:
    r"""An arc for each of the source's angles, and for each driven joint that turns.

    >>> from assur.scene.companion import companion
    >>> from assur.scene.skeleton import skeleton
    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> found = arcs(skeleton(record, companion(record), home_values(record)), 50.0)
    >>> [(arc.name, arc.latex) for arc in found]
    [('gamma', '\\gamma'), ('alpha', '\\alpha'), ('beta', '\\beta')]
    """
    record = skeleton.record
    form = record.closed_form
    latex = {item.name: item.latex for item in form.quantity_list} if form else {}
    named = {name: (item, label(latex.get(name, ""), name)) for name, item in record.angles.items()}
    for item in record.drives:
        if item.coordinate.kind == "angle" and item.coordinate not in record.angles.values():
            named[item.name] = (item.coordinate, label(item.latex, item.name))
    marks = {mark.joint.name: mark for mark in skeleton.marks}
    found = []
    for name, (coordinate, text) in named.items():
        value = float(skeleton.values[coordinate.index])
        arc = _arc(skeleton, marks[coordinate.joint], name, text, value, radius)
        if arc is not None:
            found.append(arc)
    return found


def _arc(skeleton: Skeleton, mark: JointMark, name: str, latex: str, value: float, radius: float) -> Arc | None:
    joint = mark.joint
    if joint.type.freedoms != 1:
        return None
    towards = _partner(skeleton, mark)
    if towards is None:
        return None
    axis = mark.axes[0]
    arm = towards - mark.at
    arm = arm - (arm @ axis) * axis
    size = float(np.linalg.norm(arm))
    if size < 1e-9:
        return None
    radius = min(radius, 0.6 * size)
    zero = rotations.about_axis(axis, np.array(-value)) @ (arm / size)
    turns = rotations.about_axis(axis, np.linspace(0.0, value, SAMPLES))
    points = mark.at + radius * (turns @ zero)
    return Arc(name, latex, value, mark.at, np.stack([zero, arm / size]), points)


def _partner(skeleton: Skeleton, mark: JointMark) -> FloatArray | None:
    """The other end of the part of the child that starts at a joint; of a plate its middle."""
    for rod in skeleton.rods:
        if rod.link == mark.joint.child and mark.joint.name in rod.ends:
            return np.asarray(rod.points[1 - rod.ends.index(mark.joint.name)])
    plates = [plate.points for plate in skeleton.plates if plate.link == mark.joint.child]
    return np.asarray(plates[0].mean(axis=0)) if plates else None


def draw_arcs(page: Canvas, view: View, arcs: list[Arc], letters: Letters) -> None:
    """Arcs with their letters, and the directions that they are counted from."""
    for arc in arcs:
        radius = float(np.linalg.norm(arc.points[0] - arc.corner))
        zero = view(np.array([arc.corner, arc.corner + 1.9 * radius * arc.sides[0]]))
        guide(page, zero, 8.0)
        letters.avoid(zero)
        flat = view(arc.points)
        page.line(flat, 0.9, RED, 12)
        page.arrow(flat[-4], flat[-1], RED, 0.9, 12, head=5)
        letters.avoid(flat[::6])
        letters.add(flat[SAMPLES // 2], f"${arc.latex}$", clear=1.5, color=RED)


def draw_placements(page: Canvas, view: View, skeleton: Skeleton, measures: Measures, letters: Letters) -> None:
    """Steps between arrows and angles, with their letters; a step that is a whole rod is not drawn again."""
    for part in measures.steps:
        flat = view(part.points)
        if not any(_same(part.points, rod.points) for rod in skeleton.rods):
            page.arrow(flat[0], flat[1], INK, 0.5, 8.5, style="<|-|>", head=4)
            letters.avoid(flat)
        if part in measures.lettered:
            letters.add_along(flat, f"${part.latex}$", clear=1.5, fontsize=TEXT)
    for part in measures.arcs:
        flat = view(part.points)
        page.line(flat[:-1], 0.5, INK, 8.5)
        page.arrow(flat[-2], flat[-1], INK, 0.5, 8.5, head=4)
        letters.avoid(flat[::4])
        letters.add(flat[len(flat) // 2], f"${part.latex}$", clear=1.5, fontsize=TEXT)


def _same(ends: FloatArray, others: FloatArray) -> bool:
    """Whether a step (2, 3) goes from one end of a rod (2, 3) to the other."""
    size = 1e-9 * float(np.linalg.norm(others[1] - others[0]))
    return bool(np.allclose(ends, others, 0.0, size) or np.allclose(ends[::-1], others, 0.0, size))


def draw_frame(
    page: Canvas, view: View, frame: Frame, at: FloatArray, size: float, primes: str, letters: Letters
) -> None:
    """A frame: arrows X, Y, Z from a point (3,), named with primes."""
    start = view(at)
    for name, axis in zip("XYZ", frame[0].T, strict=True):
        end = view(at + size * axis)
        if np.linalg.norm(end - start) < 3.0:
            _end_on(page, start, towards=float(axis @ view.camera.toward) > 0)
            letters.avoid_disc(start, 3.2)
        else:
            page.arrow(start, end, BLUE, 0.9, 11, head=6)
            letters.avoid(np.array([start, end]))
        letters.add(end, f"${name}${primes}", clear=2.0, fontsize=TEXT, color=BLUE)


def _end_on(page: Canvas, at: FloatArray, *, towards: bool) -> None:
    """An arrow seen from its end: a dot where it points at the reader, a cross where away."""
    page.disc(at, 3.2, edge=BLUE, order=11)
    if towards:
        page.disc(at, 0.8, BLUE, BLUE, order=11)
    else:
        for way in (np.array([2.2, 2.2]), np.array([2.2, -2.2])):
            page.line(np.array([at - way, at + way]), 0.8, BLUE, 11)


def draw_measures(page: Canvas, view: View, skeleton: Skeleton, letters: Letters) -> None:
    """The value of every driven slider, measured along its rail from where it is zero."""
    latex = {item.coordinate.joint: label(item.latex, item.name) for item in skeleton.record.drives}
    for mark in skeleton.marks:
        if not (mark.driven and mark.slides):
            continue
        across = direction(view, mark.axes[0]) @ np.array([[0.0, -1.0], [1.0, 0.0]])
        across = -across if across[1] > 0 else across
        ends = view(np.array([mark.rail, mark.at]))
        low = ends + 17.0 * across
        page.arrow(low[0], low[1], INK, 0.6, 9, style="-|>", head=5)
        for end, foot in zip(ends, low, strict=True):
            page.line(np.array([end + 5 * across, foot + 2 * across]), 0.4, INK, 1.5)
            letters.avoid(np.array([end + 5 * across, foot]))
        letters.avoid(low)
        letters.add_along(low, f"${latex[mark.joint.name]}$", clear=1.5, fontsize=TEXT)
