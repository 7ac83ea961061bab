"""The graph of a topology: links as bars, joints as lines between them, in the colours of their Assur chains."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, TextWidths, canvas
from assur.figures.context import Context
from assur.figures.graph_layout import Bond, GraphLayout, plan
from assur.figures.letters import letter
from assur.figures.spec import Drawing, FigureKind, always
from assur.figures.style import GREY, INK, ORANGE, PAGE, PAPER, SERIES, SMALL, TEXT
from assur.figures.symbols import hatching
from assur.topology.screws.linkage import Linkage

if TYPE_CHECKING:
    from assur.results.answers.solution_order import AssurChain, Loop

FloatArray = NDArray[np.float64]
RADIUS = 6.6
HALF = 6.5
MARGIN = 8.0
LINE = 12.0
"""Radius of a joint's disc, half height of a link's bar, white about everything, height of a line of text; points."""

SLANTED = np.array([[-1.6, -0.85], [1.0, -0.85], [1.6, 0.85], [-1.0, 0.85]])
"""Corners of a parallelogram's symbol, in radii of a joint's disc."""

PLATFORM = "#d6ebf7"
LIGHTEST = 0.45
"""How much of its colour the last loop of an Assur chain keeps."""

_GROUP = re.compile(r"Pa(\d+)")


@dataclass(frozen=True)
class DrawnEdge:
    """A joint of the graph, or a parallelogram as one: its name, which freedoms are driven, and of several."""

    name: str
    letter: str
    start: str
    end: str
    joints: tuple[str, ...] = ()
    driven: tuple[str, ...] = ()
    several: bool = False

    @property
    def reach(self) -> float:
        """Half the width of its symbol in points."""
        return float(SLANTED[2, 0]) * RADIUS if self.joints else RADIUS

    @property
    def label(self) -> str:
        """Its name, and under it the joints that it stands for or the freedom that is driven, if that says more."""
        inside = [name for name in self.joints if not name.startswith(self.name)]
        below = " ".join(map(letter, inside)) or ", ".join(self.driven if self.several else ())
        name = _GROUP.sub(r"Pa$_{\1}$", self.name) if _GROUP.fullmatch(self.name) else letter(self.name)
        return f"{name}\n{below}" if below else name


def edges(linkage: Linkage) -> tuple[DrawnEdge, ...]:
    """The edges of the graph in the order of the joints, a group of joints where its first one stands."""
    owner = {name: group for group in linkage.groups.values() for name in group.joints}
    found: dict[str, DrawnEdge] = {}
    for name, joint in linkage.joints.items():
        if name in owner:
            group = owner[name]
            sign = group.kind.removeprefix("P(").removesuffix(")")
            found.setdefault(group.name, DrawnEdge(group.name, sign, group.parent, group.child, group.joints))
        else:
            driven = tuple(joint.type.components[index] for other, index in linkage.inputs if other == name)
            found[name] = DrawnEdge(
                name, joint.type.letter, joint.parent, joint.child, (), driven, joint.type.freedoms > 1
            )
    return tuple(found.values())


def graph_drawing(
    linkage: Linkage, loops: Sequence[Loop], assur_chains: Sequence[AssurChain], width: float = PAGE
) -> Drawing:
    """The graph of a linkage, to be called inside `assur.figures.style.styled`.

    Args:
        linkage: links and joints; parallelograms are drawn as one joint.
        loops: in the order that attains the coupling degree, each with the names of the edges that it adds.
        assur_chains: each with the indices of its loops; it has a colour, and each loop a tone of it.
        width: of the page in mm; where the legend has no room beside the graph, it stands below it.
    """
    found = edges(linkage)
    measure = TextWidths()
    links = tuple(dict.fromkeys(link for item in found for link in (item.start, item.end)))
    widths = {link: measure(letter(link), SMALL) + 10.0 for link in links}
    bonds = [
        Bond(item.name, item.start, item.end, (item.reach + 9.0, item.reach + 4.0 + measure(item.label, TEXT)))
        for item in found
    ]
    places = plan(bonds, linkage.base, linkage.platform, widths)
    tones = _tones(loops, assur_chains)
    legend = _legend(found, loops, assur_chains, tones)
    wide = 30.0 + max((measure(text, SMALL) for text, _ in legend), default=0.0)
    page, corner = _page(places, bonds, wide, LINE * len(legend), width * POINTS)
    for item in found:
        _edge(page, item, places, tones)
    for link in links:
        _link(page, places.links[link], letter(link), ground=link == linkage.base, top=link == linkage.platform)
    _write(page, corner, legend)
    return Drawing(page.figure, _data(linkage, found, places, loops, assur_chains))


@dataclass(frozen=True)
class _Tone:
    """The number of a loop and the colour of its joints."""

    number: int
    colour: str


def _tones(loops: Sequence[Loop], assur_chains: Sequence[AssurChain]) -> dict[str, _Tone]:
    """Name of an edge -> the loop that it belongs to."""
    tones: dict[str, _Tone] = {}
    for place, chain in enumerate(assur_chains):
        hue = SERIES[place % len(SERIES)]
        for step, index in enumerate(chain.loops):
            share = 1.0 - (1.0 - LIGHTEST) * step / max(len(chain.loops) - 1, 1)
            tones |= dict.fromkeys(loops[index].joints, _Tone(index + 1, _mixed(hue, share)))
    return tones


def _mixed(colour: str, share: float) -> str:
    """A colour with white.

    >>> _mixed("#000000", 0.5)
    '#808080'
    """
    parts = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return "#" + "".join(f"{round(255 - share * (255 - part)):02x}" for part in parts)


Legend = list[tuple[str, str]]
"""Lines of text, each with the colour of the sample before it, empty where there is none."""


def _legend(
    edges: Sequence[DrawnEdge], loops: Sequence[Loop], assur_chains: Sequence[AssurChain], tones: Mapping[str, _Tone]
) -> Legend:
    lines: Legend = []
    for number, chain in enumerate(assur_chains, 1):
        lines.append((f"Assur chain {number}: $\\kappa$ = {chain.coupling_degree}", ""))
        for index in chain.loops:
            loop = loops[index]
            delta = f"{loop.delta:+d}".replace("-", "\N{MINUS SIGN}") if loop.delta else "0"
            text = f"{index + 1}: $\\xi$ = {loop.xi}, $\\Delta$ = {delta}"
            lines.append((text, tones[loop.joints[0]].colour))
    if any(item.driven for item in edges):
        lines.append(("actuated", ORANGE))
    return lines


def _page(
    places: GraphLayout, bonds: Sequence[Bond], wide: float, tall: float, most: float
) -> tuple[Canvas, tuple[float, float]]:
    """A page about the graph and a legend of wide x tall points, and where that begins; the axes count as the plan.

    It stands on the right of the graph where both together are at most `most` wide, else below it.
    """
    rooms = {bond.name: bond.room for bond in bonds}
    left = min(*(bar[0] for bar in places.links.values()), *(at[0] - rooms[n][0] for n, at in places.joints.items()))
    letters = [float(places.joints[bond.name][0]) + bond.room[1] for bond in bonds]
    right = max(*letters, *(bar[1] for bar in places.links.values()))
    top, low = max(bar[2] for bar in places.links.values()) + HALF, -HALF - 6.0
    if right - left + wide + 2 * MARGIN <= most:
        corner = right + 12.0, top
        right, low = right + wide, min(low, top - tall)
    else:
        corner = left, low - LINE / 2
        right, low = max(right, left + wide), low - LINE / 2 - tall
    page = canvas((right - left + 2 * MARGIN) / POINTS, (top - low + 2 * MARGIN) / POINTS)
    page.axes.set_xlim(left - MARGIN, right + MARGIN)
    page.axes.set_ylim(low - MARGIN, top + MARGIN)
    return page, corner


def _write(page: Canvas, corner: tuple[float, float], legend: Legend) -> None:
    x, y = corner[0], corner[1] - LINE / 2
    for text, colour in legend:
        if colour == ORANGE:
            page.disc(np.array([x + 6.0, y]), 3.6, ORANGE)
        elif colour:
            page.line(np.array([[x, y], [x + 12.0, y]]), 2.0, colour)
        page.text((x + 18.0 if colour else x, y - 0.3), text, ha="left", fontsize=SMALL)
        y -= LINE


def _edge(page: Canvas, edge: DrawnEdge, places: GraphLayout, tones: Mapping[str, _Tone]) -> None:
    at, tone = places.joints[edge.name], tones.get(edge.name)
    bold = bool(edge.joints)
    _line(page, places.lines[edge.name], tone.colour if tone else INK, 3.4 if bold else 1.6)
    fill = ORANGE if edge.driven else PAPER
    if bold:
        page.polygon(at + RADIUS * SLANTED, fill, order=6)
    else:
        page.disc(at, RADIUS, fill, order=6)
    page.text(at - [0.0, 0.3], edge.letter, fontsize=SMALL)
    page.text(at + np.array([edge.reach + 3.0, 0.0]), edge.label, ha="left", fontsize=TEXT, linespacing=1.0)
    if tone:
        page.text(at - [edge.reach + 3.0, 0.0], str(tone.number), ha="right", fontsize=SMALL, color=GREY)


def _line(page: Canvas, points: FloatArray, colour: str, width: float) -> None:
    """A line through points from below, upright at each of them."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for low, high in pairwise(points):
        pull = np.array([0.0, 0.5 * (high[1] - low[1])])
        vertices += [low + pull, high - pull, high]
        codes += [Path.CURVE4] * 3
    path = Path(np.array(vertices), codes)
    page.axes.add_patch(PathPatch(path, facecolor="none", edgecolor=colour, linewidth=width, zorder=2))


def _link(page: Canvas, bar: tuple[float, float, float], name: str, *, ground: bool, top: bool) -> None:
    left, right, height = bar
    low, high = height - HALF, height + HALF
    corners = np.array([[left, low], [right, low], [right, high], [left, high]])
    page.polygon(corners, PLATFORM if top else PAPER, width=1.0 if top or ground else 0.7, order=5)
    if ground:
        hatching(page, corners[0], corners[1], 5, np.array([0.0, -1.0]))
    page.text(((left + right) / 2, height - 0.3), name, fontsize=SMALL)


def _data(
    linkage: Linkage,
    edges: Sequence[DrawnEdge],
    places: GraphLayout,
    loops: Sequence[Loop],
    assur_chains: Sequence[AssurChain],
) -> dict[str, Any]:
    return {
        "base": linkage.base,
        "platform": linkage.platform,
        "links": list(places.links),
        "joints": [
            {
                "name": item.name,
                "letter": item.letter,
                "links": [item.start, item.end],
                "stands_for": list(item.joints),
                "driven": list(item.driven),
                "at": places.joints[item.name],
            }
            for item in edges
        ],
        "loops": [{"joints": list(loop.joints), "xi": loop.xi, "delta": loop.delta} for loop in loops],
        "assur_chains": [
            {"loops": list(chain.loops), "coupling_degree": chain.coupling_degree} for chain in assur_chains
        ],
    }


def _caption(context: Context) -> str:
    bold = " A bold line is a parallelogram that counts as one joint." if context.record.generalised else ""
    return (
        "Graph of the topology: bars are links, the base at the bottom, the platform at the top; lines with a letter"
        " are joints, actuated ones filled. An Assur chain has one colour, each of its loops a tone and the number that"
        f" stands left of its joints, in the order that attains the coupling degree.{bold}"
    )


def _draw(context: Context) -> Drawing:
    found = context.topology
    return graph_drawing(found.linkage, found.loops, found.assur_chains, context.page)


GRAPH = FigureKind("graph", "Links and joints", always, _caption, _draw)
