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
    """
    return _series(chain.elements)


def _series(elements: tuple[Element, ...]) -> str:
    return " ".join(map(_element, elements))


def _element(element: Element) -> str:
    if isinstance(element, Parallelogram):
        return f"P({element.kind}){_brackets((element.axis,), element.general)}"
    if isinstance(element, ChainJoint):
        label = f"@{element.point}" if element.point else ""
        return element.type.letter + _brackets(element.axes, element.general) + label
    return "{" + " | ".join(map(_series, element.branches)) + "}"


def _brackets(axes: tuple[Vector, ...], general: bool) -> str:
    if general or not axes:
        return ""
    texts = [direction_text(axis) for axis in axes]
    return f"[{('; ' if any(',' in text for text in texts) else ',').join(texts)}]"
