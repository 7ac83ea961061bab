"""The flow of the direct solution: from the inputs through every named quantity to the pose, with its equations."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, canvas
from assur.figures.context import Context
from assur.figures.labels import is_settable, label
from assur.figures.layers import Layout, layout, rows
from assur.figures.letters import letter
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import GREY, INK, LETTER, SMALL, new_figure
from assur.model.closed_form import Eliminant, PolynomialSystem

FloatArray = NDArray[np.float64]
Kind = Literal["input", "quantity", "condition", "pose"]
FILL = {"input": "#fbe6bf", "quantity": "#ffffff", "condition": "#f2f2f2", "pose": "#d6ebf7"}
HALF = 11.0
ROW = 44.0
GAPS = (13.0, 9.0, 6.0, 4.0)
"""Half height of a box, distance of rows, and gaps between boxes, of which the first is taken
for which the page has room; in points."""


@dataclass(frozen=True)
class FlowBox:
    """A step of the solution: what it is, what it is made from, its equation, and the mode sign chosen in it."""

    name: str
    kind: Kind
    latex: str
    needs: tuple[str, ...]
    equation: str = ""
    sign: str = ""

    @property
    def note(self) -> str:
        """Second line of the box."""
        sign = f"sign {letter(self.sign)}" if self.sign else ""
        equation = f"Eq. {self.equation}" if self.equation.startswith("(") else self.equation
        return ", ".join(part for part in (equation, sign) if part)


def boxes(context: Context) -> dict[str, FlowBox]:
    """Every step of the direct solution by name, inputs first.

    >>> from assur.model.registry import load_record
    >>> found = boxes(Context(load_record("zeng2019")))
    >>> found["alpha"].needs, found["alpha"].equation
    (('J1', 'J2', 'J3', 'closed'), '(17)')
    """
    record, plan = context.record, context.companion.flow
    found = {item.name: FlowBox(item.name, "input", label(item.latex, item.name), ()) for item in record.inputs}
    quantities = record.closed_form.quantity_list if record.closed_form else ()
    for item in quantities:
        if item.problem != "inverse" and item.name not in plan.leave_out:
            equation = item.equation.split(", ")[0]
            latex = label(item.latex, item.name)
            found[item.name] = FlowBox(item.name, "quantity", latex, item.needs, equation)
    for name, step in plan.steps.items():
        known = found.get(name)
        needs = tuple(step.needs if step.needs is not None else known.needs if known else ())
        kind: Kind = "condition" if step.condition else "pose" if name in record.platform.pose else "quantity"
        latex = step.latex if is_settable(step.latex) else known.latex if known else label("", name)
        equation = step.equation or (known.equation if known else "")
        found[name] = FlowBox(name, kind, latex, (*needs, *step.adds), equation, step.sign)
    return found


def _missing(context: Context) -> str:
    if context.record.closed_form is None:
        return "the mechanism has no closed form"
    if context.record.closed_form.direct is None:
        return "the direct problem has no closed form"
    found = boxes(context)
    unknown = [want for box in found.values() for want in box.needs if want not in found]
    if unknown:
        return f"steps need what no step gives: {', '.join(sorted(set(unknown)))}"
    if not all(name in found for name in context.record.platform.pose):
        return "nothing says which quantities the pose is computed from ([flow.steps] in figures.toml)"
    return ""


def _caption(context: Context) -> str:
    found = boxes(context).values()
    conditions = [box.equation for box in found if box.kind == "condition"]
    numbers = ", ".join(f"Eq. {equation}" for equation in conditions if equation)
    of_source = f" ({numbers})" if numbers else ""
    rest = f" Dashed boxes are geometric constraints{of_source}." if conditions else ""
    return f"Flow of the direct solution: from the inputs (top) to the pose (bottom).{_count(context)}{rest}"


def _count(context: Context) -> str:
    """How many poses come out: by choices of sign, roots of a polynomial, or solutions of a system."""
    form = context.record.closed_form
    if form is None:
        return ""
    if isinstance(form.direct, PolynomialSystem):
        return f" The system of polynomials has {form.direct.degree} complex solutions."
    number = sum(bool(box.sign) for box in boxes(context).values())
    choices = "One choice of sign gives" if number == 1 else f"{number} choices of sign give"
    if isinstance(form.direct, Eliminant):
        chosen = f" after {'one choice' if number == 1 else f'{number} choices'} of sign" if number else ""
        most, roots = form.direct.degree, form.direct.roots
        return f" A polynomial of degree {roots} is left{chosen}: at most {most} poses."
    return f" {choices} {2**number} branches." if number else ""


def _draw(context: Context) -> Drawing:
    found = boxes(context)
    sizes = _sizes(list(found.values()))
    needs = {name: box.needs for name, box in found.items()}
    first = [box.name for box in found.values() if box.kind == "input"]
    row = rows(needs, first, list(context.record.platform.pose))
    for gap in GAPS:
        plan = layout(needs, row, sizes, gap)
        low = min(plan.centre[name] - sizes.get(name, 0.0) / 2 for name in plan.centre) - 8
        high = max(plan.centre[name] + sizes.get(name, 0.0) / 2 for name in plan.centre) + 8
        if high - low <= context.page * POINTS:
            break
    depth = ROW * max(row.values()) + 2 * HALF + 16
    page = canvas((high - low) / POINTS, depth / POINTS)
    place = _places(plan, row, low, depth)
    for (start, _), points in _paths(sizes, place, plan).items():
        _arrow(page, points, dashed=found[start].kind == "condition")
    for name, box in found.items():
        _box(page, box, place[name], sizes[name])
    return Drawing(page.figure, _data(context, found, row))


def _places(plan: Layout, row: dict[str, int], low: float, depth: float) -> dict[str, FloatArray]:
    """Middle (2,) of every box and waypoint on the page."""
    level = dict(row)
    for (start, _), steps in plan.routes.items():
        level |= {step: row[start] + 1 + k for k, step in enumerate(steps)}
    return {name: np.array([x - low, depth - 8 - HALF - ROW * level[name]]) for name, x in plan.centre.items()}


def _sizes(boxes: list[FlowBox]) -> dict[str, float]:
    """Widths of the boxes in points."""
    figure = new_figure(10, 10)
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]  # matplotlib does not say
    sizes = {}
    for box in boxes:
        lines = [
            figure.text(0, 0, f"${box.latex}$", fontsize=LETTER),
            figure.text(0, 0, box.note, fontsize=SMALL),
        ]
        sizes[box.name] = max(26.0, *(line.get_window_extent(renderer).width + 9 for line in lines))
    return sizes


def _box(page: Canvas, box: FlowBox, at: FloatArray, width: float) -> None:
    style = (0, (3, 2)) if box.kind == "condition" else "-"
    patch = FancyBboxPatch(
        (at[0] - width / 2, at[1] - HALF),
        width,
        2 * HALF,
        boxstyle="round,pad=0,rounding_size=2.5",
        facecolor=FILL[box.kind],
        edgecolor=INK,
        linewidth=0.7,
        linestyle=style,
        zorder=5,
    )
    page.axes.add_patch(patch)
    page.text((at[0], at[1] + (4.2 if box.note else 0.0)), f"${box.latex}$", fontsize=LETTER)
    if box.note:
        page.text((at[0], at[1] - 6.2), box.note, fontsize=SMALL)


def _arrow(page: Canvas, points: list[FloatArray], *, dashed: bool) -> None:
    """A curve through points from above, downwards at each of them."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for a, b in pairwise(points):
        pull = np.array([0.0, 0.5 * (a[1] - b[1])])
        vertices += [a - pull, b + pull, b]
        codes += [Path.CURVE4] * 3
    patch = FancyArrowPatch(
        path=Path(np.array(vertices), codes),
        arrowstyle="-|>",
        mutation_scale=6,
        linewidth=0.6,
        color=GREY if dashed else INK,
        linestyle=(0, (3, 2)) if dashed else "-",
        zorder=3,
        shrinkA=0,
        shrinkB=0,
    )
    page.axes.add_patch(patch)


def _paths(
    sizes: dict[str, float], place: dict[str, FloatArray], plan: Layout
) -> dict[tuple[str, str], list[FloatArray]]:
    """The points of every arrow: each leaves and arrives at a place of its own on the edge of a box."""
    between = {pair: [place[step] for step in steps] for pair, steps in plan.routes.items()}
    aims = {
        pair: ((points or [place[pair[1]]])[0][0], (points or [place[pair[0]]])[-1][0])
        for pair, points in between.items()
    }
    paths = {}
    for start, end in between:
        outgoing = sorted((aims[pair][0], pair) for pair in between if pair[0] == start)
        arriving = sorted((aims[pair][1], pair) for pair in between if pair[1] == end)
        leave = place[start] + [_port([pair for _, pair in outgoing], (start, end), sizes[start]), -HALF]
        reach = place[end] + [_port([pair for _, pair in arriving], (start, end), sizes[end]), HALF]
        paths[start, end] = [leave, *between[start, end], reach]
    return paths


def _port(pairs: list[tuple[str, str]], pair: tuple[str, str], width: float) -> float:
    """Places of several arrows on the edge of a box, evenly about its middle."""
    step = min(9.0, 0.7 * width / max(len(pairs), 1))
    return step * (pairs.index(pair) - (len(pairs) - 1) / 2)


def _data(context: Context, boxes: dict[str, FlowBox], row: dict[str, int]) -> dict[str, Any]:
    nodes = [
        {
            "name": box.name,
            "kind": box.kind,
            "latex": box.latex,
            "equation": box.equation,
            "sign": box.sign,
            "row": row[box.name],
        }
        for box in boxes.values()
    ]
    arrows = [[want, box.name] for box in boxes.values() for want in box.needs]
    return {"inputs": [item.name for item in context.record.inputs], "nodes": nodes, "arrows": arrows}


FLOW = FigureKind("flow", "Flow of the direct solution", _missing, _caption, _draw)
