"""Chains written as the literature writes them: the relation of every axis to the one before it."""

from __future__ import annotations

import re
from dataclasses import dataclass

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector, parallel, perpendicular
from assur.topology.notation.planar import PlanarLoop, planar_loop
from assur.topology.notation.signs import WRITTEN
from assur.topology.poc import Style


@dataclass(frozen=True)
class _End:
    """One side of an element as a sign sees it: an axis, or the normal of a plane; what shares a point."""

    axis: Vector | None = None
    plane: bool = False
    joint: ChainJoint | None = None


def symbolic_text(chain: Chain, style: Style = "unicode", *, number: int | None = None) -> str:
    r"""A chain in the literature's form, read off its axes.

    The signs are ∥, ⊥, / (one line), ⌢ (one point), ⌢⊥ (there at a right angle), and - where nothing is said, as
    beside a parallelogram or a loop in braces. A planar inner loop with three freedoms is written by its tag. Names
    are written where they are a letter and a number.

    Args:
        chain: from the base to the platform.
        style: "unicode", "ascii" or "latex"; `parse_chain` reads all three.
        number: of the limb, an index of HSOC.

    Source: the notation of Zeng, Yang, Shen, Chablat 2019.

    Example:
        >>> from assur.topology.notation import parse_chain
        >>> symbolic_text(parse_chain("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"))
        'HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R5 ∥ R6-}'
        >>> symbolic_text(parse_chain("R[x] R[x] C[y]"), "latex", number=2)
        'SOC_2\\{-R_1 \\parallel R_2 \\perp C_1 -\\}'
    """
    hybrid = any(isinstance(element, InnerLoop | Parallelogram) for element in chain.elements)
    name, body = "HSOC" if hybrid else "SOC", _series(chain.elements, style)
    if style == "latex":
        index = "" if number is None else f"_{number}" if number < 10 else f"_{{{number}}}"
        return rf"{name}{index}\{{-{body} -\}}"
    return f"{name}{'' if number is None else number}{{-{body}-}}"


def _series(elements: tuple[Element, ...], style: Style) -> str:
    text, left = "", _End()
    for element in elements:
        written, first, last = _element(element, style)
        text += (_sign(left, first, style) if text else "") + written
        left = last
    return text


def _element(element: Element, style: Style) -> tuple[str, _End, _End]:
    if isinstance(element, Parallelogram):
        return "P" + _raised(element.kind, style), _End(), _End()
    if isinstance(element, ChainJoint):
        axes = (None,) if element.general or not element.axes else element.axes
        text = _named(element.type.letter, element.name, style)
        return text, _End(axes[0], joint=element), _End(axes[-1], joint=element)
    planar = planar_loop(element)
    if planar:
        return _tagged(planar, style), _End(planar.normal, plane=True), _End(planar.normal)
    branches = f" {WRITTEN[style]['branch']} ".join(_series(branch, style) for branch in element.branches)
    return rf"\{{{branches}\}}" if style == "latex" else f"{{{branches}}}", _End(), _End()


def _tagged(loop: PlanarLoop, style: Style) -> str:
    """The three freedoms of a planar loop's link, with its tag."""
    signs, tag = WRITTEN[style], _raised(loop.tag, style)
    names = [joint.name for joint in loop.sliders[:2]]
    names += [""] * (2 - len(names))
    sliders = ", ".join(_named("P", name, style) + tag for name in names)
    return f"{signs['diamond']}({sliders}) {signs['perpendicular']} R{tag}"


def _sign(left: _End, right: _End, style: Style) -> str:
    relation = "".join(WRITTEN[style][relation] for relation in _relations(left, right))
    if relation:
        return f" {relation} "
    return " - " if style == "latex" else "-"


def _relations(left: _End, right: _End) -> tuple[str, ...]:
    near, far = left.joint, right.joint
    shared = near is not None and far is not None and not {*near.points_on(-1)}.isdisjoint(far.points_on(0))
    if left.axis is None or right.axis is None:
        return ("meeting",) if shared else ()
    mixed = left.plane != right.plane
    if parallel(left.axis, right.axis):
        return ("coaxial",) if shared else ("perpendicular",) if mixed else ("parallel",)
    if perpendicular(left.axis, right.axis):
        return ("meeting", "perpendicular") if shared else ("parallel",) if mixed else ("perpendicular",)
    return ("meeting",) if shared else ()


def _named(letter: str, name: str, style: Style) -> str:
    """R3, or R_3 in LaTeX; only the letter where the name is another's."""
    match = re.fullmatch(rf"{letter}(?![xyz]$|{'a[0-9]*$' if letter == 'P' else '$'})([A-Za-z0-9']+)", name, re.ASCII)
    if not match:
        return letter
    index = match.group(1)
    if style == "latex" and len(index) == 1:
        return f"{letter}_{index}"
    return f"{letter}_{{{index}}}" if style == "latex" or not re.fullmatch(r"\d+[a-w]?'*", index) else letter + index


def _raised(text: str, style: Style) -> str:
    return f"^{{({text})}}" if style == "latex" else f"({text})"
