"""Chains written in the plain form, every axis in the base frame: what `parse_chain` reads back as the same chain."""

from __future__ import annotations

from assur.topology.chains import Chain, ChainJoint, Element, Parallelogram
from assur.topology.directions import Vector
from assur.topology.notation.brackets import direction_text


def plain_text(chain: Chain) -> str:
    """A chain in the plain form; axes that were left general have no brackets, and names are not written.

    Example:
        >>> from assur.topology.notation import parse_chain
        >>> plain_text(parse_chain("{P[y]R[x]R[x]|P[y]R[x]R[x]}U[y,-z]@A S@A P(4R)[1,1,0]"))
        '{P[y] R[x] R[x] | P[y] R[x] R[x]} U[y,-z]@A S@A P(4R)[1,1,0]'
        >>> plain_text(parse_chain("R[x]@A@B U[1,2,0@A,y]"))
        'R[x]@A@B U[1,2,0@A; y]'
        >>> plain_text(parse_chain("<rod>R[z]R[z]"))
        '<rod> R[z] R[z] <platform>'
    """
    start, end = (f"<{link}>" for link in (chain.start, chain.end))
    text = _series(chain.elements)
    return text if chain.is_limb else f"{start} {text} {end}"


def _series(elements: tuple[Element, ...]) -> str:
    return " ".join(map(_element, elements))


def _element(element: Element) -> str:
    if isinstance(element, Parallelogram):
        kind = f"{element.kind}, {element.bar}" if element.bar else element.kind
        return f"P({kind}){_brackets((element.axis,), element.general)}"
    if isinstance(element, ChainJoint):
        one = element.type.axes == 1
        label = _labels(element.points_on(0) if one else (element.point,) if element.point else ())
        return element.type.letter + _brackets(element.axes, element.general, () if one else element.through) + label
    return "{" + " | ".join(map(_series, element.branches)) + "}"


def _brackets(axes: tuple[Vector, ...], general: bool, through: tuple[tuple[str, ...], ...] = ()) -> str:
    if general or not axes:
        return ""
    points = through or ((),) * len(axes)
    texts = [direction_text(axis) + _labels(labels) for axis, labels in zip(axes, points, strict=True)]
    return f"[{('; ' if any(',' in text for text in texts) else ',').join(texts)}]"


def _labels(labels: tuple[str, ...]) -> str:
    return "".join(f"@{label}" for label in labels)
