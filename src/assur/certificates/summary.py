"""What a certificate says, in words and numbers for a person; the numbers are rounded outwards to what is printed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import Any

from assur.kinematics.answers.at_border import power
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle

DIGITS = 8


def statement_lines(document: Mapping[str, Any], record: MechanismRecord | None = None) -> list[str]:
    """Mechanism, mode, box or path and what is held; angles in degrees where the mechanism's file has them so."""
    statement = document["statement"]
    where = _path(statement, record) if document["kind"] == "path" else _box(statement, record)
    lines = [f"{statement['mechanism']}, working mode {statement['mode'] or 'of home'}", *where]
    if statement["held"]:
        held = [f"{name} = {_value(record, name, float.fromhex(v))}" for name, v in statement["held"].items()]
        lines.append(f"held: {', '.join(held)}")
    if statement["parameters"]:
        changed = [f"{name} = {float.fromhex(value):g}" for name, value in statement["parameters"].items()]
        lines.append(f"dimensions: {', '.join(changed)}")
    if statement["strokes"]:
        lines.append(f"strokes: {', '.join(_stroke(*item) for item in statement['strokes'].items())}")
    return lines


def claim_lines(document: Mapping[str, Any], record: MechanismRecord | None = None) -> list[str]:
    """What the certificate claims, and in how many leaves."""
    claims = document["claims"]
    factors = ", ".join(name for name, _ in document["program"]["factors"]) or "none"
    lines = []
    if "volume" in claims:
        unit = _unit(document, record)
        low, high = (float.fromhex(value) for value in claims["volume"])
        size = ("length", "area", "volume")[len(document["statement"]["coordinates"]) - 1]
        lines += [f"{size} reached: {rounded(low, high)}{unit}"]
        least = rounded(float.fromhex(claims["regular_volume"]), 0.0).split(" ")[0]
        lines += [f"at least {least}{unit} of it is free of singularities"]
    if "reached" in claims:
        lines += [f"all of the {document['kind']} is reached: {claims['reached']}"]
        lines += [f"all of it is free of singularities: {claims['regular']}"]
    leaves = ", ".join(f"{count} {name}" for name, count in claims["leaves"].items())
    return [*lines, f"factors looked at: {factors}", f"leaves: {leaves}"]


def rounded(low: float, high: float) -> str:
    """Bounds with eight digits, rounded outwards.

    >>> rounded(1 / 3, 2 / 3)
    '0.33333333 .. 0.66666667'
    """
    down, up = (Context(prec=DIGITS, rounding=rule) for rule in (ROUND_FLOOR, ROUND_CEILING))
    return f"{float(down.create_decimal(low)):.8g} .. {float(up.create_decimal(high)):.8g}"


def _box(statement: Mapping[str, Any], record: MechanismRecord | None) -> list[str]:
    pairs = zip(statement["coordinates"], statement["box"], strict=True)
    box = [_interval(record, name, float.fromhex(low), float.fromhex(high)) for name, (low, high) in pairs]
    return [f"box: {', '.join(box)}"]


def _path(statement: Mapping[str, Any], record: MechanismRecord | None) -> list[str]:
    """Both ends of a path, and of how many pieces it is."""
    lines = []
    for word in ("from", "to"):
        pairs = zip(statement["coordinates"], statement[word], strict=True)
        pose = [f"{name} = {_value(record, name, float.fromhex(value))}" for name, value in pairs]
        lines.append(f"{word}: {', '.join(pose)}")
    return [*lines, f"path: {len(statement['boxes'])} straight pieces, each in a box"]


def _unit(document: Mapping[str, Any], record: MechanismRecord | None) -> str:
    if record is None:
        return ""
    names = document["statement"]["coordinates"]
    angles = sum(map(is_angle, names))
    parts = (power(record.unit, len(names) - angles), power("rad", angles))
    return " " + " ".join(part for part in parts if part)


def _interval(record: MechanismRecord | None, name: str, low: float, high: float) -> str:
    factor, unit = _scale(record, name)
    return f"{name} {low * factor:.9g} .. {high * factor:.9g}{unit}"


def _value(record: MechanismRecord | None, name: str, value: float) -> str:
    factor, unit = _scale(record, name)
    return f"{value * factor:.9g}{unit}"


def _scale(record: MechanismRecord | None, name: str) -> tuple[float, str]:
    if is_angle(name):
        degrees = record is not None and record.angle == "deg"
        return (180 / math.pi, " deg") if degrees else (1.0, " rad")
    return 1.0, f" {record.unit}" if record is not None else ""


def _stroke(name: str, pair: list[str] | None) -> str:
    return f"{name} none" if pair is None else f"{name} {' .. '.join(f'{float.fromhex(v):g}' for v in pair)}"
