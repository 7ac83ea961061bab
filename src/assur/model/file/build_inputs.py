"""Actuated coordinates in their order, and the joint values of home."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath
from assur.joints.catalogue import JOINT_TYPES
from assur.model.file import schema
from assur.model.file.build_joints import JointVectors
from assur.model.file.faults import listed
from assur.model.file.limbs import Tables
from assur.model.file.numbers import Numbers
from assur.model.file.scope import Scope
from assur.model.mechanism import Input

FloatArray = NDArray[np.float64]


def build_inputs(file: schema.FileEntry, tables: Tables, scope: Scope, numbers: Numbers) -> tuple[Input, ...]:
    """Inputs in the order that the file names, else in the order in which they stand there."""
    found: dict[int, Input] = {}
    places: dict[int, KeyPath] = {}
    for placed in tables.inputs.values():
        entry, path = placed.entry, placed.path
        item = scope.coordinate(placed.local, path, placed.instance)
        if item is None:
            continue
        offset = numbers.of(item.kind, entry.offset, (*path, "offset"))
        stroke = numbers.interval(item.kind, entry.stroke, (*path, "stroke")) if entry.stroke else None
        if item.index in found:
            first = scope.faults.first(places[item.index])
            scope.faults.add(path, f"'{placed.local}' is an input already; {first}", "allowed: each joint once")
        places.setdefault(item.index, path)
        found[item.index] = Input(item, entry.name, entry.latex or entry.name, offset, float(entry.sign), stroke)
    complete = len(found) == len(tables.inputs) and not tables.broken.get("inputs")
    if file.inputs.order is None or not complete:
        return tuple(found.values())
    return _ordered(file.inputs.order, found, scope)


def _ordered(order: tuple[str, ...], inputs: Mapping[int, Input], scope: Scope) -> tuple[Input, ...]:
    indices = []
    places: dict[int, int] = {}
    for place, name in enumerate(order):
        path = ("inputs", "order", place)
        item = scope.coordinate(name, path)
        if item is None:
            continue
        if item.index not in inputs:
            hint = f'add {name} = {{ name = "q" }}'
            scope.faults.add(path, f"'{name}' has no entry in [inputs]", "allowed: the inputs, each once", hint)
        elif item.index in indices:
            first = scope.faults.first(("inputs", "order", places[item.index]))
            scope.faults.add(path, f"'{name}' twice; {first}", "allowed: the inputs, each once")
        places.setdefault(item.index, place)
        indices.append(item.index)
    left = [item.coordinate.joint for index, item in inputs.items() if index not in indices]
    if left and len(indices) == len(order):
        scope.faults.add(("inputs", "order"), f"lacks {listed(left)}", "allowed: the inputs, each once")
    return tuple(inputs[index] for index in indices if index in inputs)


def build_home(tables: Tables, scope: Scope, geometry: JointVectors) -> FloatArray:
    """Joint values (n,) near one assembled configuration; every joint must have its own."""
    home = np.full(len(scope.coordinates), np.nan)
    places: dict[str, KeyPath] = {}
    for placed in tables.home.values():
        joint = scope.joint(placed.local, placed.path, placed.instance)
        if joint is None:
            continue
        items = [item for item in scope.coordinates if item.joint == joint]
        if joint in places:
            first = scope.faults.first(places[joint])
            scope.faults.add(placed.path, f"'{placed.local}' is given twice; {first}", "allowed: each joint once")
        places.setdefault(joint, placed.path)
        if len(placed.entry) != len(items):
            allowed = f"allowed: {len(items)} ({', '.join(item.component for item in items)})"
            scope.faults.add(placed.path, f"{len(placed.entry)} values", allowed)
            continue
        for place, (item, value) in enumerate(zip(items, placed.entry, strict=True)):
            home[item.index] = geometry.numbers.of(item.kind, value, (*placed.path, place))
        if JOINT_TYPES[tables.joints[joint].entry.type].ball:
            turning = [item.index for item in items]
            home[turning] = geometry.turned(home[turning], placed.instance)  # a rotation vector turns with its limb
    given = {scope.aliases.get(name, name) for name in (*tables.home, *tables.broken.get("home", ()))}
    if tables.home or tables.broken.get("home"):
        _check_complete(given, tables, scope)
    home.flags.writeable = False
    return home


def _check_complete(given: set[str], tables: Tables, scope: Scope) -> None:
    lacking: dict[KeyPath, dict[str, str]] = {}
    for name, placed in tables.joints.items():
        if name not in given:
            path: KeyPath = ("limbs", placed.instance.limb, "home") if placed.instance else ("home",)
            count = len(JOINT_TYPES[placed.entry.type].components)
            zeros = "0" if count == 1 else f"[{', '.join(['0'] * count)}]"
            lacking.setdefault(path, {})[placed.local] = f"{placed.local} = {zeros}"
    for path, guesses in lacking.items():
        allowed = "every joint needs a value near one assembled configuration"
        guess = next(iter(guesses.values()))
        scope.faults.add(path, f"lacks {listed(set(guesses))}", allowed, f"add {guess}, or a better guess")
