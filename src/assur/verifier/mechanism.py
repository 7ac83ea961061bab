"""The joint graph of a mechanism file: its joints with the formulas of their dimensions, limbs written out."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from assur.verifier.formula import PI, RADIAN, AngleSum, NumberType, value

Triple = tuple[Any, Any, Any]
SIGNED = {f"{sign}{name}": tuple(sense * (k == i) for k in range(3))
          for i, name in enumerate("xyz") for sign, sense in (("", 1), ("-", -1))}  # fmt: skip
COORDINATES = {
    "revolute": ("rotation",),
    "prismatic": ("translation",),
    "helical": ("rotation",),
    "cylindrical": ("translation", "rotation"),
    "universal": ("first", "second"),
    "spherical": ("rx", "ry", "rz"),
    "planar": ("first", "second", "rotation"),
}
"""Joint types, and the coordinates of each in the order in which they move its child."""
MOST = 200


@dataclass(frozen=True)
class FileLimb:
    """By what the vectors of a template are turned: an angle, as written, about an axis."""

    about: Triple
    angle: Any


@dataclass(frozen=True)
class FileJoint:
    """A joint as it is written: formulas of points, axes and pitch, in the frames of its template."""

    type: str
    parent: str
    child: str
    at: Triple
    child_at: Triple
    axes: tuple[Triple, ...]
    child_axis: Triple | None = None
    pitch: Any = None
    limb: FileLimb | None = None


@dataclass(frozen=True)
class FileInput:
    """How an input is printed: its value is the sense times that of its coordinate, plus the offset as written."""

    name: str
    sense: int
    offset: Any


@dataclass(frozen=True)
class FileParallelogram:
    """Four joints between two links and two rods, of a kind such as `P(4R)`, that are taken to stay a parallelogram."""

    name: str
    kind: str
    joints: tuple[str, ...]
    parent: str
    child: str


@dataclass(frozen=True)
class FileMechanism:
    """What a file says of the joint graph.

    Attributes:
        parameters: name -> its formula, and its unit if that is one of angles.
        joints: by their full names, in the order of the file, those of limbs last.
        base, platform: links; `point` is that of the platform, in its frame, and `pose` names what counts of it.
        inputs: (joint, coordinate) each, of those that determine the mechanism.
        positive: parameters that may be nothing else.
        degrees: whether plain numbers that are angles are in degrees.
        printed: how each input is printed, in their order.
        parallelograms: what the file says acts as one joint.
    """

    parameters: Mapping[str, tuple[Any, str]]
    joints: Mapping[str, FileJoint]
    base: str
    platform: str
    point: Triple
    pose: tuple[str, ...]
    inputs: tuple[tuple[str, str], ...]
    degrees: bool
    positive: frozenset[str] = frozenset()
    printed: tuple[FileInput, ...] = ()
    parallelograms: tuple[FileParallelogram, ...] = ()

    def angle(self, written: Any, names: Mapping[str, Any], numbers: NumberType) -> AngleSum:
        """An angle of the file; a plain number is in the file's unit."""
        result = value(written, names, numbers)
        return result if isinstance(result, AngleSum) else in_unit(result, "deg" if self.degrees else "rad")

    def dimensions(self, numbers: NumberType) -> dict[str, Any]:
        """The parameters by their formulas: numbers, rationals and angles."""
        result: dict[str, Any] = {}
        waiting = dict(self.parameters)
        while waiting:
            before = len(waiting)
            for name, (written, unit) in list(waiting.items()):
                try:
                    own = value(written, result, numbers)
                except KeyError:  # of what is not yet known
                    continue
                result[name] = in_unit(own, unit) if unit and not isinstance(own, AngleSum) else own
                del waiting[name]
            if len(waiting) == before:
                raise ValueError(f"parameters that have no value: {', '.join(waiting)[:80]}")
        return result


def in_unit(number: Any, unit: str) -> AngleSum:
    """A plain number of degrees or radians as an angle."""
    return AngleSum({PI: number / 180} if unit == "deg" else {RADIAN: number})


def mechanism(text: str, changed: Mapping[str, float] | None = None) -> FileMechanism:
    """Read a mechanism file; some parameters may have other values, in their own units.

    Errors:
        ValueError, KeyError, TypeError: it says nothing, or not in this form; other faults are not looked for.

    >>> mechanism('base = "b"').base
    Traceback (most recent call last):
    KeyError: 'platform'
    """
    data = tomllib.loads(text, parse_float=Fraction)
    new = {name: Fraction(repr(float(number))) for name, number in (changed or {}).items()}
    units = {name: entry.get("unit", "") for name, entry in data.get("parameters", {}).items()}
    written = {name: new.get(name, entry["value"]) for name, entry in data.get("parameters", {}).items()}
    parts: dict[str, FileJoint] = {}
    inputs: list[tuple[str, str]] = []
    printed: dict[str, FileInput] = {}
    parallelograms: list[FileParallelogram] = []
    aliases: dict[str, str] = {}
    known = set(data.get("links", {}))
    for prefix, limb, number, tables in _parts(data):
        local = {*tables.get("links", {}), *tables.get("joints", {})}
        full = {name: f"{prefix}{name}" for name in local}
        known.update(full.values())
        for name, entry in tables.get("joints", {}).items():
            parts[f"{prefix}{name}"] = _joint(entry, full, limb)
            if "alias" in entry:
                aliases[f"{prefix}{entry['alias']}"] = f"{prefix}{name}"
        driven = {name: entry for name, entry in tables.get("inputs", {}).items() if name != "order"}
        inputs += [(prefix, name) for name in driven]
        for name, entry in driven.items():
            own = FileInput(f"{entry['name']}{number or ''}", entry.get("sign", 1), entry.get("offset", 0))
            printed[f"{prefix}{name}"] = own
        for name, entry in tables.get("generalised", {}).items():
            stands = (full.get(entry["stands_for"][end], entry["stands_for"][end]) for end in ("parent", "child"))
            joints = (full.get(joint, f"{prefix}{joint}") for joint in entry["joints"])
            parallelograms.append(FileParallelogram(f"{prefix}{name}", entry["kind"], tuple(joints), *stands))
    if len(parts) > MOST or not all({joint.parent, joint.child} <= known for joint in parts.values()):
        raise ValueError("joints of links that are not there, or too many")
    base, platform = data["base"], data["platform"]
    order = data.get("inputs", {}).get("order")
    named = [("", name) for name in order] if order else inputs
    ways = {_coordinate(name, parts, aliases): own for name, own in printed.items()}
    rates = len(platform["pose"]) - ("qw" in platform["pose"])  # as many inputs determine it, and others follow
    driven_ones = tuple(_coordinate(f"{prefix}{name}", parts, aliases) for prefix, name in named)[:rates]
    return FileMechanism(
        {name: (written[name], unit if unit in ("deg", "rad") else "") for name, unit in units.items()},
        parts,
        base,
        platform["link"],
        tuple(platform.get("point", (0, 0, 0))),
        tuple(platform["pose"]),
        driven_ones,
        data["angle"] == "deg",
        frozenset(n for n, entry in data.get("parameters", {}).items() if entry.get("sign", "positive") == "positive"),
        tuple(ways[own] for own in driven_ones),
        tuple(replace(own, joints=tuple(aliases.get(j, j) for j in own.joints)) for own in parallelograms),
    )


def _parts(data: Mapping[str, Any]) -> list[tuple[str, FileLimb | None, int, Mapping[str, Any]]]:
    """The prefix of names, the turn, the number and the tables of what stands outside limbs, and of each limb."""
    result: list[tuple[str, FileLimb | None, int, Mapping[str, Any]]] = [("", None, 0, data)]
    for name, tables in data.get("limbs", {}).items():
        repeat = tables["repeat"]
        count = repeat.get("count", 0)
        angles = repeat.get("angles") or [f"2*pi*{k}/{count}" for k in range(count)]
        limbs = [FileLimb(_axis(repeat["about"]), angle) for angle in angles]
        result += [(f"{name}{k}.", limb, k, tables) for k, limb in enumerate(limbs, 1)]
    return result


def _joint(entry: Mapping[str, Any], full: Mapping[str, str], limb: FileLimb | None) -> FileJoint:
    kind, own = entry["type"], entry.get("axes", [entry["axis"]] if "axis" in entry else [])
    if len(own) != {"spherical": 0, "universal": 2}.get(kind, 1) or kind not in COORDINATES:
        raise ValueError(f"a joint of type {str(kind)[:40]!r} with {len(own)} axes")
    return FileJoint(
        kind,
        full.get(entry["parent"], entry["parent"]),
        full.get(entry["child"], entry["child"]),
        _triple(entry.get("at", [0, 0, 0])),
        _triple(entry.get("child_at", [0, 0, 0])),
        tuple(map(_axis, own)),
        _axis(entry["child_axis"]) if "child_axis" in entry else None,
        entry["pitch"] if kind == "helical" else None,
        limb,
    )


def _coordinate(name: str, joints: Mapping[str, FileJoint], aliases: Mapping[str, str]) -> tuple[str, str]:
    """A joint of one coordinate by its name, or one coordinate of a joint as `joint.coordinate`."""
    own = aliases.get(name, name)
    if own in joints:
        (component,) = COORDINATES[joints[own].type]
        return own, component
    joint, _, component = name.rpartition(".")
    own = aliases.get(joint, joint)
    if component not in COORDINATES[joints[own].type]:
        raise ValueError(f"{name[:40]!r} is no coordinate of a joint")
    return own, component


def _axis(written: Any) -> Triple:
    return SIGNED[written] if isinstance(written, str) else _triple(written)  # type: ignore[return-value]


def _triple(written: Any) -> Triple:
    x, y, z = written
    return x, y, z
