"""The grid that `assur sweep` is asked for, from words: places along coordinates, the others held."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from assur.cli.numbers import assignments, interval, number, whole_number
from assur.errors import UnknownNameError, UsageError

if TYPE_CHECKING:
    from assur.kinematics.closed_form.grids import Grid
    from assur.kinematics.modes import Problem
    from assur.model.mechanism import MechanismRecord

Place = tuple[float, float, int]
"""(low, high, count), in the mechanism's units."""


def asked(record: MechanismRecord, problem: Problem, along: Sequence[str], at: Sequence[str]) -> Grid:
    """The grid of a problem: every coordinate of the pose, or every input, varies or is held; angles in rad."""
    from assur.kinematics.closed_form.about import coordinates
    from assur.kinematics.closed_form.grids import Grid
    from assur.kinematics.status import NO_CLOSED_FORM
    from assur.model.pose import has_quaternion

    if problem == "direct" and record.closed_form is None:
        raise UsageError(f"{record.name} has no closed form to sweep its inputs with", hint=NO_CLOSED_FORM)
    if problem == "inverse" and has_quaternion(record.platform.pose):
        raise UsageError(
            f"{record.name}: no grid over quaternions", hint="Mechanism.inverse takes an array of poses of your own"
        )
    kinds = coordinates(record, problem)
    places = _along(record, problem, along, kinds)
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
    lows, highs = (tuple(places[name][k] for name in kinds) for k in (0, 1))
    scales = tuple((record.angle_unit if kind == "angle" else 1.0) for kind in kinds.values())
    return Grid(tuple(kinds), lows, highs, tuple(places[name][2] for name in kinds), scales)


def _along(record: MechanismRecord, problem: Problem, texts: Sequence[str], kinds: dict[str, str]) -> dict[str, Place]:
    first = next(iter(kinds))
    example = f"{first}=-100:100:41"
    places: dict[str, Place] = {}
    for name, text in assignments(texts, "--along", example).items():
        _known(record, name, kinds)
        limits, colon, last = text.rpartition(":")
        if colon and ":" not in limits:
            raise UsageError(f"--along {name}: '{text}' is not LOW:HIGH:COUNT", hint=f"for example --along {example}")
        count = whole_number(last, f"--along {name}, count")
        if count < 2:
            raise UsageError(f"--along {name}: {count} places", hint=f"at least 2; to hold {name}: --at {name}=VALUE")
        pair = interval(limits, f"--along {name}", example) if colon else _of_file(record, problem, name, kinds[name])
        places[name] = (*pair, count)
    return places


def _known(record: MechanismRecord, name: str, kinds: dict[str, str]) -> None:
    if name not in kinds:
        raise UnknownNameError(f"coordinate of this grid of {record.name}", name, kinds)


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
