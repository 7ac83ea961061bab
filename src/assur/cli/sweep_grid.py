"""The grid that `assur sweep` is asked for, from words: places along coordinates, the others held."""

from __future__ import annotations

import math
from collections.abc import Sequence

from assur.cli.numbers import assignments, interval, number, whole_number
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.closed_form.about import coordinates
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import has_quaternion

Place = tuple[float, float, int]
"""(low, high, count), in the mechanism's units."""


def asked(
    record: MechanismRecord, problem: Problem, along: Sequence[str], at: Sequence[str], dimension: Sequence[str] = ()
) -> Grid:
    """The grid of a problem: every coordinate of the pose, or every input, varies or is held; angles in rad.

    Before them come the dimensions that vary; where nothing else is said, the mechanism is held at home.
    """
    if problem == "inverse" and has_quaternion(record.platform.pose):
        raise UsageError(
            f"{record.name}: no grid over quaternions", hint="Mechanism.inverse takes an array of poses of your own"
        )
    kinds = coordinates(record, problem)
    swept = _dimensions(record, dimension)
    places = _at_home(record, problem) if swept and not (along or at) else _along(record, problem, along, kinds)
    for name, text in assignments(at, "--at", f"{next(iter(kinds))}=0").items():
        _known(record, name, kinds)
        if name in places:
            raise UsageError(f"{name} both varies and is held", hint=f"give it to --along or to --at, as --at {name}=0")
        value = number(text, f"--at {name}")
        places[name] = (value, value, 1)
    left = [name for name in kinds if name not in places]
    if left:
        raise UsageError(
            f"{', '.join(left)}: neither varied nor held",
            hint=f"add --along {left[0]}=LOW:HIGH:COUNT or --at {left[0]}=0",
        )
    for name in ("theta",) if problem == "inverse" and "theta" in kinds else ():
        if max(map(abs, places[name][:2])) * record.angle_unit > math.pi / 2:
            raise UsageError(f"{name} is between -90 and 90 deg", hint="turn phi and psi instead")
    every = [*swept.values(), *(places[name] for name in kinds)]
    lows, highs, counts = zip(*every, strict=True)
    scales = (record.angle_unit if kind == "angle" else 1.0 for kind in kinds.values())
    return Grid((*swept, *kinds), lows, highs, counts, (*(1.0 for _ in swept), *scales))


def _along(record: MechanismRecord, problem: Problem, texts: Sequence[str], kinds: dict[str, str]) -> dict[str, Place]:
    example = f"{next(iter(kinds))}=-100:100:41"
    places: dict[str, Place] = {}
    for name, text in assignments(texts, "--along", example).items():
        _known(record, name, kinds)
        limits = None if ":" in text else _of_file(record, problem, name, kinds[name])
        places[name] = _range(text, f"--along {name}", example, f"--at {name}=VALUE", limits)
    return places


def _dimensions(record: MechanismRecord, texts: Sequence[str]) -> dict[str, Place]:
    """Dimensions in the units of the file."""
    places: dict[str, Place] = {}
    for name, text in assignments(texts, "--dimension", "l2=250:300:51").items():
        if name not in record.parameters:
            raise UnknownNameError(f"dimension of {record.name}", name, record.parameters)
        if name in record.overrides:
            raise UsageError(
                f"{name} both varies and is held", hint=f"give it to --dimension or to --set, as --set {name}=1"
            )
        places[name] = _range(text, f"--dimension {name}", "l2=250:300:51", f"--set {name}=VALUE")
    return places


def _range(text: str, what: str, example: str, held: str, limits: tuple[float, float] | None = None) -> Place:
    """LOW:HIGH:COUNT; or COUNT alone between limits."""
    between, _, last = text.rpartition(":")
    if limits is None and ":" not in between:
        raise UsageError(f"{what}: '{text}' is not LOW:HIGH:COUNT", hint=f"for example {what.split()[0]} {example}")
    count = whole_number(last, f"{what}, count")
    if count < 2:
        raise UsageError(f"{what}: {count} places", hint=f"at least 2; to hold it: {held}")
    return *(limits or interval(between, what, example)), count


def _at_home(record: MechanismRecord, problem: Problem) -> dict[str, Place]:
    """Pose or inputs of home, in the mechanism's units."""
    values = (pose_of if problem == "inverse" else inputs_of)(record, home_values(record))
    kinds = coordinates(record, problem)
    sizes = (record.angle_unit if kind == "angle" else 1.0 for kind in kinds.values())
    held = (float(value / size) for value, size in zip(values, sizes, strict=True))
    return {name: (value, value, 1) for name, value in zip(kinds, held, strict=True)}


def _known(record: MechanismRecord, name: str, kinds: dict[str, str]) -> None:
    if name not in kinds:
        follows = name in {item.name for item in record.redundant_inputs}
        hint = f"{name} is redundant: it follows from the others, along which the grid is" if follows else ""
        raise UnknownNameError(f"coordinate of this grid of {record.name}", name, kinds, hint=hint)


def _of_file(record: MechanismRecord, problem: Problem, name: str, kind: str) -> tuple[float, float]:
    """The box or the stroke of the mechanism's file."""
    if problem == "inverse":
        found = record.box.get(name)
    else:
        found = next(item.stroke for item in record.inputs if item.name == name)
    if found is None:
        raise UsageError(
            f"--along {name}: {record.name} states no limits of {name}", hint=f"give them: {name}=LOW:HIGH:COUNT"
        )
    unit = record.angle_unit if kind == "angle" else 1.0
    return found[0] / unit, found[1] / unit
