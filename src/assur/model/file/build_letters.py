"""The source's letters: signs that name modes, angles, points."""

from __future__ import annotations

from collections.abc import Mapping

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.build_joints import JointVectors
from assur.model.file.limbs import Tables
from assur.model.file.numbers import MIXED, MIXED_HINT, Kind, KindError, Numbers, kind_of
from assur.model.file.scope import Scope
from assur.model.formula import Formula
from assur.model.mechanism import Coordinate, Modes, Point


def build_modes(file: schema.FileEntry, scope: Scope, numbers: Numbers) -> Modes:
    """Signs of formulas over joint values, coordinates of points, parameters and angles; and the defaults."""
    entry = file.modes
    tables = {"working": entry.working, "assembly": entry.assembly}
    letters: dict[str, Kind] = {**numbers.kinds, **dict.fromkeys(numbers.broken, "either")}
    letters.update(dict.fromkeys(file.angles, "angle"))
    for table, formulas in tables.items():
        for name, formula in formulas.items():
            _check_mode(formula, ("modes", table, name), scope, letters)
        _check_default(table, getattr(entry.default, table), list(formulas), scope)
    for name in sorted(entry.working.keys() & entry.assembly.keys()):
        scope.faults.add(("modes", "assembly", name), "a working sign has this name", "allowed: another name")
    own = {
        table: {name: scope.without_aliases(formula) for name, formula in formulas.items()}
        for table, formulas in tables.items()
    }
    return Modes(own["working"], own["assembly"], entry.default.working, entry.default.assembly)


def _check_mode(formula: Formula, path: KeyPath, scope: Scope, letters: Mapping[str, Kind]) -> None:
    kinds = {text: letters.get(text) or scope.quantity_kind(text) for text in formula.names}
    unknown = sorted(text for text, kind in kinds.items() if kind is None)
    for text in unknown:
        scope.faults.unknown(path, "quantity", text, [*scope.quantities, *letters])
    if not unknown and not any(scope.quantity_kind(text) or letters.get(text) == "angle" for text in formula.names):
        scope.faults.add(path, f'"{formula.text}" never changes', "allowed: a formula of joints and points")
    try:
        kind_of(formula.root, {text: kind or "either" for text, kind in kinds.items()})
    except KindError as error:
        scope.faults.add(path, f'"{formula.text}": {error}', MIXED, MIXED_HINT)


def _check_default(table: str, default: str, names: list[str], scope: Scope) -> None:
    path = ("modes", "default", table)
    if len(default) != len(names) or set(default) - {"+", "-"}:
        allowed = f"allowed: + or - for each of {', '.join(names)}" if names else f"there are no {table} signs"
        scope.faults.add(path, f'"{default}"' if default else "missing", allowed)


def build_angles(file: schema.FileEntry, scope: Scope) -> dict[str, Coordinate]:
    """Letters for joint values that are angles."""
    found = {}
    for name, text in file.angles.items():
        item = scope.coordinate(text, ("angles", name))
        if item and item.kind != "angle":
            scope.faults.add(("angles", name), f"'{text}' is a length", "allowed: a joint value that is an angle")
        if item:
            found[name] = item
    return found


def build_points(tables: Tables, scope: Scope, geometry: JointVectors) -> dict[str, Point]:
    """Letters for points fixed in links, and their places there."""
    found = {}
    for name, placed in tables.points.items():
        link = scope.link(placed.entry.link, (*placed.path, "link"), placed.instance)
        at = geometry.vector(placed.entry.at, (*placed.path, "at"), placed.instance)
        written = geometry.written(placed.entry.at, placed.instance)
        found[name] = Point(name, link or "", at, written)
    return found
