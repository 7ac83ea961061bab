"""XML as text: numbers with every digit, elements one below the other."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
from numpy.typing import ArrayLike

from assur.numerics import rotations

Element = ElementTree.Element


def number(value: float) -> str:
    """A float that reads back as the same one; whole numbers without a point, zero without a sign.

    >>> number(0.1), number(-0.0), number(3.0)
    ('0.1', '0', '3')
    """
    text = repr(float(value) + 0.0)
    return text.removesuffix(".0")


def numbers(values: ArrayLike) -> str:
    """Numbers with spaces between them."""
    return " ".join(number(float(value)) for value in np.ravel(np.asarray(values, dtype=float)))


def tensor_entries(tensor: ArrayLike) -> dict[str, str]:
    """Entries of a tensor of inertia (3, 3) as SDF and URDF name them.

    >>> tensor_entries([[1, 0, 0.5], [0, 2, 0], [0.5, 0, 3]])
    {'ixx': '1', 'ixy': '0', 'ixz': '0.5', 'iyy': '2', 'iyz': '0', 'izz': '3'}
    """
    rows = np.asarray(tensor, dtype=float)
    places = (("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2))
    return {name: number(rows[row, column]) for name, row, column in places}


def quaternion(orientation: ArrayLike) -> str:
    """Unit quaternion w x y z of a rotation (3, 3)."""
    return numbers(rotations.to_quaternion(np.asarray(orientation, dtype=float)))


def child(parent: Element, tag: str, text: str = "", **attributes: str) -> Element:
    """A new last child of an element; an attribute `class_` is called class."""
    made = ElementTree.SubElement(parent, tag, {name.rstrip("_"): value for name, value in attributes.items()})
    made.text = text or None
    return made


def comment(parent: Element, text: str) -> None:
    """A comment; what XML does not allow in one is left out."""
    allowed = "".join(letter if letter.isprintable() else " " for letter in text)
    parent.append(ElementTree.Comment(f" {re.sub('-(?=-)', '- ', allowed)} "))


def document(root: Element) -> str:
    """The text of a whole document."""
    ElementTree.indent(root)
    return '<?xml version="1.0"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"
