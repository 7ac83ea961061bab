"""Numbers with units as a person reads them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assur.model.mechanism import MechanismRecord

QUATERNION = ("qw", "qx", "qy", "qz")


@dataclass(frozen=True)
class Style:
    """How a mechanism's lengths and angles are written: seven digits of its size, angles to 1e-4 degrees."""

    unit: str
    angle: str
    decimals: int

    def length(self, value: float | None) -> str:
        """A length without its unit."""
        return fixed(value, self.decimals)

    def degrees(self, value: float | None) -> str:
        """An angle in the mechanism's angle unit, without it."""
        return fixed(value, 4 if self.angle == "deg" else 6)

    def coordinate(self, name: str, value: float | None) -> str:
        """A pose coordinate without its unit."""
        if name in QUATERNION:
            return fixed(value, 6)
        return self.length(value) if is_length(name) else self.degrees(value)

    def coordinate_unit(self, name: str) -> str:
        """Unit of a pose coordinate; none for a part of a quaternion."""
        return "" if name in QUATERNION else self.unit if is_length(name) else self.angle

    def coordinate_title(self, name: str) -> str:
        """A pose coordinate over a column: x [mm]."""
        unit = self.coordinate_unit(name)
        return f"{name} [{unit}]" if unit else name

    def kind(self, kind: str, value: float | None) -> str:
        """An "angle" or a "length" without its unit."""
        return self.degrees(value) if kind == "angle" else self.length(value)

    def kind_unit(self, kind: str) -> str:
        """Unit of an "angle" or a "length"."""
        return self.angle if kind == "angle" else self.unit


def style_of(record: MechanismRecord) -> Style:
    """The style for a mechanism: seven digits of its characteristic length."""
    from assur.joint_graph.geometry import characteristic_length

    size = characteristic_length(record)
    decimals = min(12, max(0, 6 - math.floor(math.log10(size)))) if size > 0 else 6
    return Style(record.unit, record.angle, decimals)


def pose_text(style: Style, names: Sequence[str], pose: Sequence[float | None]) -> str:
    """A pose with names and units: x = 1.0000 mm, y = .."""
    pairs = zip(names, pose, strict=True)
    parts = (f"{name} = {style.coordinate(name, value)} {style.coordinate_unit(name)}" for name, value in pairs)
    return ", ".join(part.rstrip() for part in parts)


def point_text(style: Style, names: Sequence[str], pose: Sequence[float | None]) -> str:
    """A pose without names: (1.0000, 2.0000)."""
    return f"({', '.join(style.coordinate(name, value) for name, value in zip(names, pose, strict=True))})"


def point_title(style: Style, names: Sequence[str]) -> str:
    """What stands over such poses: (x, y) [mm]."""
    units = [style.coordinate_unit(name) or "1" for name in names]
    return f"({', '.join(names)}) [{units[0] if len(set(units)) == 1 else ', '.join(units)}]"


def is_length(name: str) -> bool:
    """Whether a pose coordinate is a length; every other is an angle."""
    from assur.model.pose import is_angle

    return not is_angle(name)


def fixed(value: float | None, decimals: int) -> str:
    """A number with so many decimals, "-" where it does not exist, and no minus before zero.

    >>> fixed(-0.00001, 4), fixed(None, 4)
    ('0.0000', '-')
    """
    if value is None or not math.isfinite(value):
        return "-"
    text = f"{value:.{decimals}f}" if abs(value) < 1e12 else f"{value:.10g}"
    return text.lstrip("-") if float(text) == 0 else text


def short(value: float | None) -> str:
    """A number with six digits, "-" where it does not exist.

    >>> short(8575323.816748314)
    '8.57532e+06'
    """
    return "-" if value is None or not math.isfinite(value) else f"{value:.6g}"


def tiny(value: float | None) -> str:
    """A residual with two digits, "-" where it does not exist."""
    return "-" if value is None or not math.isfinite(value) else f"{value:.1e}"


def mode_words(record: MechanismRecord, mode: str) -> str:
    """A working mode in words, also where it has no signs.

    >>> from assur.model.registry import load_record
    >>> mode_words(load_record("fivebar"), "-+"), mode_words(load_record("three_upu"), "")
    ('working mode -+', 'its only working mode')
    """
    if mode:
        return f"working mode {mode}"
    only = record.closed_form is not None and not record.modes.working
    return "its only working mode" if only else "the working mode of home"


def count(number: int, noun: str) -> str:
    """A number of things.

    >>> count(1, "solution"), count(4, "branch")
    ('1 solution', '4 branches')
    """
    ending = "es" if noun.endswith(("ch", "s", "x")) else "s"
    return f"{number} {noun}" if number == 1 else f"{number} {noun}{ending}"
