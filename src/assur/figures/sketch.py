"""The sketch: rods, plates, rails and joint symbols of a skeleton as lines on a page, far ones first."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View
from assur.figures.placing import Letters
from assur.figures.style import BLUE, GREEN, INK, PAPER, PINK, RED, SKY
from assur.figures.symbols import ground_pivot, ground_rail, joint_symbol
from assur.scene.companion import Companion
from assur.scene.hull import hull
from assur.scene.rails import rails
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
BROWN = "#6e4038"
CHAINS = (BLUE, GREEN, RED, SKY, PINK, BROWN)
DOWN = np.array([0.0, 0.0, -1.0])


@dataclass(frozen=True)
class Pen:
    """How thick and in which colours a skeleton is drawn; `colours` per link, `INK` for the others.

    `level` puts all of it before (above) or behind (below zero) others of the same page.
    """

    width: float = 2.0
    halo: float = 2.4
    symbol: float = 1.0
    colours: Mapping[str, str] | None = None
    level: float = 0.0

    def colour(self, link: str) -> str:
        """Colour of a link."""
        return (self.colours or {}).get(link, INK)


def chain_colours(skeleton: Skeleton) -> dict[str, str]:
    """Link -> colour of the chain that it belongs to."""
    order = {name: CHAINS[k % len(CHAINS)] for k, name in enumerate(skeleton.chains)}
    return {link: order[chain] for link, chain in skeleton.chain_of().items()}


def draw_bodies(page: Canvas, view: View, skeleton: Skeleton, letters: Letters, pen: Pen) -> None:
    """Rods, plates and joint symbols; a line in front interrupts those behind it."""
    camera = view.camera
    middle = float(np.mean(camera.depth(skeleton.cloud)))
    size = max(skeleton.size, 1e-300)

    def order(points: FloatArray) -> float:
        return 5.0 + pen.level + (float(np.mean(camera.depth(points))) - middle) / size

    # the parts of one link are at one depth, so that none interrupts another
    bodies = {*(rod.link for rod in skeleton.rods), *(plate.link for plate in skeleton.plates)}
    place = {link: order(np.concatenate(_points_of(skeleton, link))) for link in bodies}
    for plate in skeleton.plates:
        corners = hull(view(plate.points))
        page.polygon(corners, tint(pen.colour(plate.link)), pen.colour(plate.link), 0.8 * pen.width, place[plate.link])
        letters.avoid(np.concatenate([corners, corners[:1]]))
    for rod in skeleton.rods:
        ends = view(rod.points)
        if np.linalg.norm(ends[1] - ends[0]) < 1e-6:
            continue
        inner = ends + np.array([[1.0], [-1.0]]) * _step(ends, 0.3)
        page.line(inner, pen.width + pen.halo, PAPER, place[rod.link] - 0.001, solid_capstyle="butt")
        page.line(ends, pen.width, pen.colour(rod.link), place[rod.link])
        letters.avoid(ends)
    for mark in skeleton.marks:
        if mark.telescopes:  # what the two parts of the leg leave open
            both = view(np.array([mark.rail, mark.at]))
            page.line(both, 0.6 * pen.width, pen.colour(mark.joint.child), order(mark.shown) - 0.002)
        own = [place[link] for link in (mark.joint.parent, mark.joint.child) if link in place]
        reach = joint_symbol(page, view, mark, max([order(mark.at), *own]) + 0.001, pen.symbol)
        letters.avoid_box(reach)


def draw_ground(page: Canvas, view: View, skeleton: Skeleton, companion: Companion, letters: Letters) -> None:
    """Hatched rails of sliding joints and supports of turning ones on the base; coaxial rails are one."""
    for rail in rails(skeleton, companion):
        ends = view(rail.ends)
        below = view.camera.project(DOWN)
        below = below if np.linalg.norm(below) > 1e-9 else np.array([0.0, -1.0])
        ground_rail(page, ends[0], ends[1], 1.0, below)
        letters.avoid(ends)
    for mark in skeleton.marks:
        if mark.grounded and not mark.slides:
            ground_pivot(page, view(mark.at), 1.5)
            letters.avoid_disc(view(mark.at) - [0.0, 8.0], 10.0)


def _points_of(skeleton: Skeleton, link: str) -> list[FloatArray]:
    rods = [rod.points for rod in skeleton.rods if rod.link == link]
    return rods + [plate.points for plate in skeleton.plates if plate.link == link]


def cloud_of(skeleton: Skeleton, companion: Companion) -> FloatArray:
    """Every point (k, 3) that must be on the page, ends of the rails included."""
    ends = [point for rail in rails(skeleton, companion) for point in rail.ends]
    return np.concatenate([skeleton.cloud, np.array(ends).reshape(-1, 3)])


def _step(ends: FloatArray, share: float) -> FloatArray:
    """A step from the first end to the second, at most 7 points long."""
    way = ends[1] - ends[0]
    return np.asarray(way * min(share, 7.0 / float(np.linalg.norm(way))))


def tint(colour: str) -> str:
    """A colour, much lighter."""
    parts = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return "#" + "".join(f"{round(255 - 0.22 * (255 - part)):02x}" for part in parts)
