"""Parameters: in what order their formulas are computed, what they may be, and how a user changes them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from numbers import Real

from assur.errors import UnknownNameError, UsageError
from assur.model.file.faults import Faults
from assur.model.file.numbers import AngleUnit, Kind, Numbers, kind_of
from assur.model.file.schema import ParameterEntry
from assur.model.formula import ANGLE_UNITS, Formula, parse
from assur.model.mechanism import MechanismRecord, Parameter
from assur.model.written import in_degrees

ALLOWED = {
    "positive": "a positive number",
    "nonnegative": "zero or a positive number",
    "any": "any finite number",
}


def evaluate_parameters(
    entries: Mapping[str, ParameterEntry],
    overrides: Mapping[str, float],
    units: tuple[str, AngleUnit],
    broken: frozenset[str],
    faults: Faults,
) -> tuple[dict[str, Parameter], Numbers]:
    """Parameters in the file's order, and the numbers that all other formulas are made of.

    Args:
        entries: parameters as the file gives them.
        overrides: values that replace the file's, in each parameter's unit.
        units: the file's units of length and of angle.
        broken: names of parameters that are in the file but not in form.
        faults: where problems are noted.
    """
    formulas = {name: _formula(name, entry, overrides) for name, entry in entries.items()}
    own_units = {name: entry.unit or units[0] for name, entry in entries.items()}
    for name, unit in own_units.items():
        if _kind(unit, units[0]) == "either":
            allowed = f"allowed: {units[0]} (the file's length unit), deg, rad, or 1 for a pure number"
            faults.add(("parameters", name, "unit"), f'"{unit}"', allowed)
    order, cyclic = _order(formulas, faults)
    kinds = {name: _kind(unit, units[0]) for name, unit in own_units.items()}
    numbers = Numbers({}, kinds, {*broken, *cyclic}, units[1], faults)
    found: dict[str, Parameter] = {}
    for name in order:
        value = _value(name, formulas[name], own_units[name], numbers)
        if math.isnan(value):
            numbers.broken.add(name)
            continue
        entry = entries[name]
        _check_sign(name, formulas[name], value, own_units[name], entry.sign, faults)
        found[name] = Parameter(name, value, entry.meaning, own_units[name], entry.sign, entry.drawn_only)
        numbers.values[name] = found[name].inside
    return {name: found[name] for name in entries if name in found}, numbers


def parameter_formulas(record: MechanismRecord) -> dict[str, Formula]:
    """What each parameter is, as a formula; angles in rad, and a value that replaces the file's as its decimals.

    >>> from assur.model.registry import load_record
    >>> parameter_formulas(load_record("orthoglide"))["L"].text
    'cube / (1/sqrt(6) + 1/sqrt(18))'
    """
    entries = record.description.form.entry.parameters if record.description else {}
    kinds = {name: _kind(item.unit, record.unit) for name, item in record.parameters.items()}
    formulas = {name: _formula(name, entry, record.overrides) for name, entry in entries.items()}
    plain = {name for name, formula in formulas.items() if kind_of(formula.root, kinds) == "plain"}
    return {
        name: in_degrees(formula) if name in plain and record.parameters[name].unit == "deg" else formula
        for name, formula in formulas.items()
    }


def checked_overrides(
    mechanism: str, parameters: Mapping[str, Parameter], overrides: Mapping[str, object]
) -> dict[str, float]:
    """Values that a user gives to parameters, as floats in each parameter's unit.

    Errors:
        UnknownNameError: there is no such parameter.
        UsageError: not a finite number, or one that the parameter may not be.
    """
    checked: dict[str, float] = {}
    for name, value in overrides.items():
        if name not in parameters:
            raise UnknownNameError(f"parameter of {mechanism}", name, parameters)
        parameter = parameters[name]
        number = _finite(value)
        if number is None or not _allowed(number, parameter.sign):
            unit = "" if parameter.unit == "1" else f" in {parameter.unit}"
            shown = repr(value) if number is None else f"{number:g}"
            raise UsageError(
                f"parameter '{name}' of {mechanism} ({parameter.meaning}) cannot be {shown[:60]}; "
                f"allowed: {ALLOWED[parameter.sign]}{unit}"
            )
        checked[name] = number
    return checked


def _finite(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def _allowed(value: float, sign: str) -> bool:
    return value > 0 or (value == 0 and sign != "positive") or sign == "any"


def _kind(unit: str, length_unit: str) -> Kind:
    """Kind of a parameter; "either" where its unit is none that the file may use."""
    if unit in ANGLE_UNITS:
        return "angle"
    return "plain" if unit in (length_unit, "1") else "either"


def _formula(name: str, entry: ParameterEntry, overrides: Mapping[str, float]) -> Formula:
    return parse(repr(overrides[name])) if name in overrides else entry.value


def _order(formulas: Mapping[str, Formula], faults: Faults) -> tuple[list[str], set[str]]:
    """Names such that each comes after those in its formula, and the names that go round in a circle."""
    needs = {name: sorted(other for other in formula.names if other in formulas) for name, formula in formulas.items()}
    try:
        return list(TopologicalSorter(needs).static_order()), set()
    except CycleError:
        return _order_without_circles(needs, faults)


def _order_without_circles(needs: Mapping[str, Sequence[str]], faults: Faults) -> tuple[list[str], set[str]]:
    """The same where formulas need one another; each such circle is noted."""
    import networkx as nx  # slow to load, and no file without that fault needs it

    graph: nx.DiGraph[str] = nx.DiGraph()
    graph.add_nodes_from(needs)
    for name, others in needs.items():
        graph.add_edges_from((other, name) for other in others)
    cyclic: set[str] = set()
    place = {name: index for index, name in enumerate(needs)}
    for group in nx.strongly_connected_components(graph):
        first = min(group, key=place.__getitem__)
        if len(group) > 1 or graph.has_edge(first, first):
            edges = nx.find_cycle(graph.subgraph(group).reverse(), first)
            circle = " -> ".join([first, *(edge[1] for edge in edges)])
            found = f"a formula that needs itself: {circle}"
            faults.add(("parameters", first, "value"), found, "allowed: formulas of parameters that do not need it")
            cyclic |= group
    rest = graph.subgraph(graph.nodes - cyclic)
    return list(nx.topological_sort(rest)), cyclic


def _value(name: str, formula: Formula, unit: str, numbers: Numbers) -> float:
    """Value in the parameter's unit."""
    path = ("parameters", name, "value")
    value, kind = numbers.evaluate(formula, path)
    if unit not in ANGLE_UNITS:
        if kind == "angle":
            numbers.faults.add(path, f'"{formula.text}" is an angle', f"allowed: a number in {unit}")
        return value
    return math.degrees(value) if unit == "deg" and kind != "plain" else value


def _check_sign(name: str, formula: Formula, value: float, unit: str, sign: str, faults: Faults) -> None:
    if not _allowed(value, sign):
        what = f"{name} = {formula.text} = {value:g}" if formula.names else f"{name} = {value:g}"
        hint = "" if value else 'sign = "nonnegative" allows zero'
        if value < 0:
            hint = 'sign = "any" allows negative values'
        faults.add(("parameters", name, "value"), f"{what} {unit}", f"allowed: {ALLOWED[sign]}", hint)
