"""Coordinates and modes of a mechanism in words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from assur.model.pose import LENGTHS, is_angle

if TYPE_CHECKING:
    from assur.model.mechanism import MechanismRecord


def unit_of(record: MechanismRecord, name: str) -> str:
    """The unit of a pose's coordinate at the border; a part of a quaternion has none."""
    return record.angle if is_angle(name) else record.unit if name in LENGTHS else ""


def value_words(record: MechanismRecord, values: Mapping[str, float], digits: int = 7) -> str:
    """Coordinates with their values and units, angles in the mechanism's angle unit.

    >>> from assur.model.registry import load_record
    >>> value_words(load_record("planar_3rpr"), {"x": 1.5, "phi": 30.0})
    'x = 1.5 mm, phi = 30 deg'
    """
    return ", ".join(f"{name} = {value:.{digits}g} {unit_of(record, name)}".rstrip() for name, value in values.items())


def interval_words(record: MechanismRecord, pairs: Iterable[tuple[str, Sequence[float]]]) -> str:
    """Coordinates, or inputs, with what they vary between.

    >>> from assur.model.registry import load_record
    >>> interval_words(load_record("planar_3rpr"), [("x", (-1.0, 2.0)), ("phi", (0.0, 30.0))])
    'x -1 .. 2 mm, phi 0 .. 30 deg'
    """
    units = {item.name: record.unit if item.coordinate.kind == "length" else record.angle for item in record.inputs}
    return ", ".join(
        f"{name} {low:g} .. {high:g} {units.get(name) or unit_of(record, name)}".rstrip() for name, (low, high) in pairs
    )


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
