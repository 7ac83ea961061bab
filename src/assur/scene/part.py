"""A part: one named solid of a link, in its colour."""

from __future__ import annotations

from dataclasses import dataclass

from assur.scene.shapes import Shape

STEEL = "#9aa3ab"
DARK = "#5d656c"
PLATE = "#d5d8da"
DRIVE = "#ecad1d"
STAGE = "#ecd777"
LINKS = ("#2381d4", "#41c793", "#cb6635", "#94cdf3", "#b473b4", "#8a7965")
PLAIN = "#b4bac0"


@dataclass(frozen=True, eq=False)
class Part:
    """One solid of a link.

    Attributes:
        name: what it is: the joint's name and its role, as "A1 pin", or "bar B1 C1".
        link: the link that carries it.
        shape: in the frame of that link, in the mechanism's unit.
        colour: "#rrggbb".
        role: what it does: bar, web, plate, post, stand, pin, ball, arm, bridge, tube, rod, collar, carriage, rail,
            pillar, motor, column.
        joint: the joint that it belongs to, "" where none.
    """

    name: str
    link: str
    shape: Shape
    colour: str
    role: str = "bar"
    joint: str = ""
