"""What a certificate says, in words and numbers for a person; the numbers are rounded outwards to what is printed."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Mapping
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from fractions import Fraction
from typing import Any

from assur.kinematics.answers.at_border import power
from assur.kinematics.limits import NO_LIMITS, limits_stated
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle

DIGITS = 8
ANSWERS = {"yes": "yes", "no": "no", "open": "undecided"}
PARTS = {
    "regular": "reached all over, and free of singularities",
    "inside": "reached all over; whether free of singularities is undecided",
    "outside": "not reached anywhere",
    "open": "undecided: nothing is proved there",
}
"""What is proved of the parts of a proof, by the names that a certificate has for its leaves."""
_LEAVES = {"r": "regular", "i": "inside", "o": "outside", "b": "open"}


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
        lines.append(f"strokes: {', '.join(_stroke(*stroke) for stroke in statement['strokes'].items())}")
    if record is not None and not limits_stated(record, statement["strokes"]):
        lines.append(f"limits: {NO_LIMITS}")
    return lines


def claim_lines(document: Mapping[str, Any], record: MechanismRecord | None = None) -> list[str]:
    """What the certificate claims, and what is proved of how many parts."""
    claims = document["claims"]
    factors = ", ".join(name for name, _ in document["program"]["factors"]) or "none"
    lines = []
    if "volume" in claims:
        unit = _unit(document, record)
        low, high = (float.fromhex(value) for value in claims["volume"])
        size = {1: "length", 2: "area"}.get(len(document["statement"]["coordinates"]), "volume")
        lines += [f"{size} reached: {rounded(low, high)}{unit}"]
        least = rounded(float.fromhex(claims["regular_volume"]), 0.0).split(" ")[0]
        lines += [f"at least {least}{unit} of it is free of singularities"]
    if "reached" in claims:
        lines += [f"all of the {document['kind']} is reached: {ANSWERS[claims['reached']]}"]
        lines += [f"all of it is free of singularities: {ANSWERS[claims['regular']]}"]
    return [*lines, f"factors looked at: {factors}", *_part_lines(document)]


def _part_lines(document: Mapping[str, Any]) -> list[str]:
    """Into how many parts the proof cuts the box or the boxes of a path, and how many are proved to be what.

    Of a box it is told how much of it, too; boxes of a path overlap, so that shares of them say nothing.
    """
    counts, share = document["claims"]["leaves"], shares(document["proof"])
    parts, of_path = sum(counts.values()), document["kind"] == "path"
    where = f" in {len(document['statement']['boxes'])} boxes" if of_path else ", which cover the box without overlap"
    texts = [f"{counts[n]}{'' if of_path else f' ({_percent(share[n])})'} {PARTS[n]}" for n in PARTS if counts[n]]
    return [f"parts: {parts}{where}; of these", *(f"  {text}" for text in texts)]


def shares(proof: str) -> dict[str, float]:
    """Which share of a proof is regular, inside, outside and open: boxes weigh alike, every halving halves.

    >>> shares("0r1bi")
    {'regular': 0.5, 'inside': 0.25, 'outside': 0.0, 'open': 0.25}
    """
    leaves, trees, depths = Counter[tuple[str, int]](), 0, list[int]()
    for token in re.findall("[0-9]|[irb]|o..", proof):
        trees += not depths
        depth = depths.pop() if depths else 0
        if token.isdigit():
            depths += [depth + 1, depth + 1]
        else:
            leaves[_LEAVES[token[0]], depth] += 1
    totals = dict.fromkeys(PARTS, Fraction(0))
    for (name, depth), count in leaves.items():
        totals[name] += Fraction(count, 2**depth)
    return {name: float(total / max(trees, 1)) for name, total in totals.items()}


def _percent(share: float) -> str:
    """A share in per cent, with three digits; what is not all is never called all.

    >>> _percent(1.0), _percent(0.12345), _percent(0.99999), _percent(1e-9)
    ('100 %', '12.3 %', 'over 99.9 %', '1e-07 %')
    """
    return "over 99.9 %" if 0.9995 <= share < 1 else f"{100 * share:.3g} %"


def rounded(low: float, high: float) -> str:
    """Bounds with eight digits, rounded outwards; no minus before zero.

    >>> rounded(1 / 3, 2 / 3)
    '0.33333333 .. 0.66666667'
    """
    down, up = (Context(prec=DIGITS, rounding=rule) for rule in (ROUND_FLOOR, ROUND_CEILING))
    return f"{float(down.create_decimal(low)) + 0.0:.8g} .. {float(up.create_decimal(high)) + 0.0:.8g}"


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
