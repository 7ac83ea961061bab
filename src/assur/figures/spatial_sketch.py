"""The spatial sketch of a topology: limbs from base to platform, joints by their symbols, axes in their directions.

Directions alone are meant: limbs stand side by side and joints one after the other, as no length is known.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from itertools import combinations

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, fitted
from assur.figures.letters import letter, numeral
from assur.figures.placing import Letters
from assur.figures.sketch import CHAINS, tint
from assur.figures.spec import Drawing
from assur.figures.style import INK, PAGE, PAPER, SMALL, TEXT
from assur.figures.symbols import direction, ground_pivot, ground_rail, joint_symbol
from assur.scene.camera import AXES, orthographic
from assur.scene.hull import hull
from assur.topology.screws.linkage import Linkage, LinkageJoint

FloatArray = NDArray[np.float64]
CAMERA = orthographic(-72.0, 20.0)
ACROSS = np.array([CAMERA.image[0, 0], CAMERA.image[0, 1], 0.0])
"""To the right of the reader."""

FIRST = np.radians(219.0)
"""Where the first limb stands about Z: to the left of the reader, the next ones in front of it, to the right."""

BASE, PLATFORM, BULGE = 1.0, 0.5, 0.32
"""Distances from the middle: of joints on the base, on the platform, and by how much more between them."""

STEP = 0.5
"""Height from a joint to the next one, of the longest limb."""

ASIDE = 0.36
"""Between joints of one limb at the same height, which belong to branches of an inner loop."""

LEVEL = 0.4
"""Share of the height from a joint to the next one within which two are at the same height."""

ARM = 15.0
"""Length of the arrows of X, Y, Z, and half that of a rail, in points."""


@dataclass(frozen=True, eq=False)
class SketchedJoint:
    """A joint of a linkage where the sketch has it: its place (3,) and unit axes (k, 3)."""

    joint: LinkageJoint
    shown: FloatArray
    driven: bool

    @property
    def axes(self) -> FloatArray:
        """What its steps go along, as at home."""
        own: dict[int, FloatArray] = {}
        for step, first in self.joint.type.places:
            turning, sliding = np.split(self.joint.screws[first], 2)
            own[step.direction] = sliding if step.kind == "slide" else turning
        return np.array([own[place] / np.linalg.norm(own[place]) for place in sorted(own)])


def sketch_drawing(linkage: Linkage, width: float = PAGE) -> Drawing:
    """The sketch of a linkage, to be called inside `assur.figures.style.styled`; width in mm."""
    limbs = limbs_of(linkage)
    driven = {name for name, _ in linkage.inputs}
    places = {name: place for k, limb in enumerate(limbs) for name, place in _places(linkage, limb, k, limbs).items()}
    marks = {name: SketchedJoint(linkage.joints[name], place, name in driven) for name, place in places.items()}
    view, page = fitted(CAMERA, np.array(list(places.values())), min(width, 60.0 + 30.0 * len(limbs)), 110, margin=14)
    letters = Letters(page)
    colours = {linkage.base: INK, linkage.platform: INK}
    for k, limb in enumerate(limbs):
        for name in limb:
            for link in (linkage.joints[name].parent, linkage.joints[name].child):
                colours.setdefault(link, CHAINS[k % len(CHAINS)])
    for link in linkage.links:
        own = [mark for mark in marks.values() if link in (mark.joint.parent, mark.joint.child)]
        _link(page, view, np.array([mark.shown for mark in own]), colours[link], letters)
    for name, mark in marks.items():
        if linkage.base in (mark.joint.parent, mark.joint.child):
            _ground(page, view, mark, letters)
        letters.avoid_box(joint_symbol(page, view, mark, 7.0 + float(CAMERA.depth(mark.shown))))
        letters.add(view(mark.shown), letter(name), clear=6.0, fontsize=TEXT)
    for k, limb in enumerate(limbs):
        outer = np.mean([places[name] for name in limb], axis=0)
        letters.add(view(outer * [1.25, 1.25, 1.0]), numeral(k + 1), clear=6.0, fontsize=TEXT, weight="bold")
    _directions(page, letters)
    letters.place()
    joints = {name: {"at": mark.shown, "axes": mark.axes, "driven": mark.driven} for name, mark in marks.items()}
    return Drawing(page.figure, {"limbs": limbs, "joints": joints})


def limbs_of(linkage: Linkage) -> tuple[tuple[str, ...], ...]:
    """Names of the joints of each limb, in their order: what hangs together without base and platform.

    >>> from assur.derived_topology import topology
    >>> limbs_of(topology(("R[z] R[z] R[z]", "R[z] R[z] R[z]")).linkage)
    (('R1', 'R2', 'R3'), ('R4', 'R5', 'R6'))
    """
    order = {name: place for place, name in enumerate(linkage.joints)}
    limbs = [tuple(sorted(limb, key=order.__getitem__)) for limb in nx.connected_components(_inside(linkage, order))]
    return tuple(sorted(limbs, key=lambda limb: order[limb[0]]))


def _places(
    linkage: Linkage, limb: Collection[str], place: int, limbs: Collection[Collection[str]]
) -> dict[str, FloatArray]:
    """Where the joints of one of the limbs stand."""
    heights = _heights(linkage, limb)
    tallest = max(max(_heights(linkage, other).values()) for other in limbs)
    top = max(heights.values()) or 1.0
    azimuth = FIRST + 2.0 * np.pi * place / len(limbs)
    outward = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    along = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    hidden = along @ CAMERA.toward  # is turned to the right, so that branches are seen side by side
    along = along - hidden * CAMERA.toward * [1.0, 1.0, 0.0] + abs(hidden) * ACROSS
    found: dict[str, FloatArray] = {}
    for name, height in heights.items():
        share = height / top
        level = [other for other, its in heights.items() if abs(its - height) < LEVEL]
        away = BASE + share * (PLATFORM - BASE) + BULGE * np.sin(np.pi * share)
        aside = ASIDE * (level.index(name) - 0.5 * (len(level) - 1))
        found[name] = away * outward + aside * along + [0.0, 0.0, STEP * tallest * share]
    return found


def _heights(linkage: Linkage, limb: Collection[str]) -> dict[str, float]:
    """How high each joint stands: of the joints on its shortest way from base to platform, how many are below."""
    graph = _inside(linkage, limb)
    below, above = (_away(linkage, graph, end) for end in (linkage.base, linkage.platform))
    length = max(below[name] + above[name] for name in limb)
    return {name: length * below[name] / ((below[name] + above[name]) or 1) for name in limb}


def _away(linkage: Linkage, graph: nx.Graph[str], end: str) -> dict[str, float]:
    """How many joints there are between each of a limb and one of its ends."""
    first = {name for name in graph if end in (linkage.joints[name].parent, linkage.joints[name].child)}
    return dict(nx.multi_source_dijkstra_path_length(graph, first)) if first else dict.fromkeys(graph, 0.0)


def _inside(linkage: Linkage, names: Collection[str]) -> nx.Graph[str]:
    """Joints, those that share another link than base and platform side by side."""
    graph: nx.Graph[str] = nx.Graph()
    graph.add_nodes_from(names)
    ends = {linkage.base, linkage.platform}
    for first, second in combinations(names, 2):
        one, other = linkage.joints[first], linkage.joints[second]
        if {one.parent, one.child} & {other.parent, other.child} - ends:
            graph.add_edge(first, second)
    return graph


def _link(page: Canvas, view: View, points: FloatArray, colour: str, letters: Letters) -> None:
    """A line between two joints, a plate of more."""
    flat, order = view(points), 4.0 + float(np.mean(CAMERA.depth(points)))
    if len(points) < 3:
        page.line(flat, 4.4, PAPER, order - 0.001)
        page.line(flat, 2.0, colour, order)
        letters.avoid(flat)
        return
    corners = hull(flat)
    page.polygon(corners, tint(colour), colour, 1.6, order, joinstyle="round")
    letters.avoid(np.concatenate([corners, corners[:1]]))


def _ground(page: Canvas, view: View, mark: SketchedJoint, letters: Letters) -> None:
    """A hatched rail under a joint that slides on the base, a support under another one."""
    at = view(mark.shown)
    if mark.joint.type.slides != 1:
        ground_pivot(page, at, 1.5)
        letters.avoid_disc(at - [0.0, 8.0], 10.0)
        return
    half = ARM * direction(view, mark.axes[0])
    below = np.array([0.0, -1.0])
    ground_rail(page, at - half, at + half, 1.0, below if abs(half[0]) > 1e-9 * ARM else np.array([-1.0, 0.0]))
    letters.avoid(np.array([at - half, at + half]))


def _directions(page: Canvas, letters: Letters) -> None:
    """The directions X, Y, Z in the corner."""
    corner = np.array([ARM + 8.0, ARM + 4.0])
    for name, axis in AXES.items():
        tip = corner + ARM * CAMERA.project(axis)
        page.arrow(corner, tip, width=0.7, head=5)
        page.text(tip + 5.0 * (tip - corner) / np.linalg.norm(tip - corner), f"${name}$", fontsize=SMALL)
    letters.avoid_disc(corner, ARM + 8.0)
