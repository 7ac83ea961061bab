"""Lengths and angles of a mechanism as text: how many digits, with which units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, is_angle
from assur.results import plain_text

PARTS = 6
"""Digits of a part of a quaternion."""


@dataclass(frozen=True)
class Style:
    """How a mechanism's lengths and angles are written: seven digits of its size, angles to 1e-4 degrees."""

    unit: str
    angle: str
    decimals: int
    typeset: bool = False

    def number(self, value: float | None, *, angle: bool) -> str:
        """A length, or an angle in the mechanism's angle unit, without its unit."""
        return self._fixed(value, (4 if self.angle == "deg" else 6) if angle else self.decimals)

    def coordinate(self, name: str, value: float | None) -> str:
        """A pose's coordinate without its unit."""
        return self._fixed(value, PARTS) if name in QUATERNION else self.number(value, angle=is_angle(name))

    def kind(self, kind: str, value: float | None) -> str:
        """An "angle" or a "length" without its unit."""
        return self.number(value, angle=kind == "angle")

    def kind_unit(self, kind: str) -> str:
        """Unit of an "angle" or a "length"."""
        return self._shown(self.angle if kind == "angle" else self.unit)

    def coordinate_unit(self, name: str) -> str:
        """Unit of a pose's coordinate; none for a part of a quaternion."""
        return "" if name in QUATERNION else self.kind_unit("angle" if is_angle(name) else "length")

    def coordinate_title(self, name: str) -> str:
        """A pose's coordinate over a column: x [mm]."""
        unit = self.coordinate_unit(name)
        return f"{name} [{unit}]" if unit else name

    def kind_title(self, name: str, kind: str) -> str:
        """An "angle" or a "length" over a column: theta1 [deg]."""
        return f"{name} [{self.kind_unit(kind)}]"

    def pose(self, names: Sequence[str], pose: Sequence[float | None]) -> str:
        """A pose with names and units.

        >>> Style("mm", "deg", 2).pose(("x", "phi"), (-1.0, 30.0))
        'x = -1.00 mm, phi = 30.0000 deg'
        >>> Style("mm", "deg", 2, typeset=True).pose(("x", "phi", "qw"), (-1.0, 30.0, 1.0))
        'x = −1.00 mm, phi = 30.0000°, qw = 1.000000'
        """
        return ", ".join(
            f"{name} = {self.coordinate(name, value)}{self._after(self.coordinate_unit(name))}"
            for name, value in zip(names, pose, strict=True)
        )

    def kinds(self, values: Iterable[tuple[str, str, float]]) -> str:
        """Names with values and units, each (name, "angle" or "length", value)."""
        return ", ".join(
            f"{name} = {self.kind(kind, value)}{self._after(self.kind_unit(kind))}" for name, kind, value in values
        )

    def point(self, names: Sequence[str], pose: Sequence[float | None]) -> str:
        """A pose without names: (1.0000, 2.0000)."""
        return f"({', '.join(self.coordinate(name, value) for name, value in zip(names, pose, strict=True))})"

    def point_title(self, names: Sequence[str]) -> str:
        """What stands over such poses: (x, y) [mm]."""
        units = [self.coordinate_unit(name) or "1" for name in names]
        return f"({', '.join(names)}) [{units[0] if len(set(units)) == 1 else ', '.join(units)}]"

    def _after(self, unit: str) -> str:
        """A unit as it stands after a value."""
        return "°" if self.typeset and unit == "deg" else f" {unit}" if unit else ""

    def _fixed(self, value: float | None, decimals: int) -> str:
        if not self.typeset:
            return plain_text.fixed(value, decimals)
        from assur.results import typeset_text  # a terminal does without

        return typeset_text.fixed(value, decimals)

    def _shown(self, unit: str) -> str:
        if not self.typeset:
            return unit
        from assur.results import typeset_text

        return typeset_text.shown_unit(unit)


def style_of(record: MechanismRecord, *, typeset: bool = False) -> Style:
    """The style for a mechanism: seven digits of its characteristic length."""
    size = characteristic_length(record)
    decimals = min(12, max(0, 6 - math.floor(math.log10(size)))) if size > 0 else 6
    return Style(record.unit, record.angle, decimals, typeset)


def titles_of(record: MechanismRecord, style: Style, *, direct: bool) -> list[str]:
    """What stands over the numbers of solutions: coordinates of poses, or inputs, those that follow last."""
    if direct:
        return [style.coordinate_title(name) for name in record.platform.pose]
    return [style.kind_title(item.name, item.coordinate.kind) for item in record.drives]


def texts_of(record: MechanismRecord, style: Style, numbers: Sequence[float], *, direct: bool) -> list[str]:
    """The numbers of one solution: a pose's coordinates, or inputs."""
    if direct:
        return [style.coordinate(*pair) for pair in zip(record.platform.pose, numbers, strict=True)]
    return [style.kind(item.coordinate.kind, value) for item, value in zip(record.drives, numbers, strict=False)]


def given_words(record: MechanismRecord, style: Style, numbers: Sequence[float], *, direct: bool) -> str:
    """What a problem is given, with names and units: inputs of the direct problem, a pose of the inverse."""
    if not direct:
        return style.pose(record.platform.pose, numbers)
    return style.kinds(
        (item.name, item.coordinate.kind, value) for item, value in zip(record.drives, numbers, strict=False)
    )
