"""What a sign between two elements speaks of: the last axis of the left one, the first of the right one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from assur.joints.catalogue import BY_LETTER
from assur.topology.notation.signs import WRITTEN
from assur.topology.notation.sketch import ConditionKind, Sketch
from assur.topology.notation.syntax import WrittenJoint, WrittenSign

PLACED = ", ".join(letter for letter, joint_type in BY_LETTER.items() if joint_type.turning)
_MARKS = WRITTEN["unicode"]
_PLACE = "write - there, and place the axes: R[x]-P(4R)[y], y being the direction of its hinges"


@dataclass(frozen=True)
class SketchEnd:
    """One side of an element.

    Attributes:
        kind: an axis; a plane, `slot` being its normal; a centre (S); or nothing that a sign can speak of.
        what: the element, for messages.
        joint: the joint, where it can share a point.
    """

    kind: Literal["axis", "plane", "centre", "nothing"]
    what: str
    slot: int = -1
    joint: WrittenJoint | None = None


def relate(sketch: Sketch, left: SketchEnd, right: SketchEnd, sign: WrittenSign) -> None:
    """Put what a sign says into the sketch.

    Errors:
        NotationError: a sign beside an element that has no axis or point of which it could speak.
    """
    for relation in sign.relations:
        mark = _MARKS[relation]
        if relation in ("meeting", "coaxial"):
            _share(sketch, (left, right), sign.at, mark, coaxial=relation == "coaxial")
            continue
        _refuse(sketch, (left, right), sign.at, mark, ("axis", "plane"))
        mixed = left.kind != right.kind
        kind: ConditionKind = "parallel" if (relation == "parallel") != mixed else "perpendicular"
        sketch.require(kind, (left.slot, right.slot), sign.at, f"'{mark}'")


def _share(sketch: Sketch, ends: tuple[SketchEnd, SketchEnd], at: int, mark: str, *, coaxial: bool) -> None:
    """Two axes on one line, or through one point. A translation has no line: parallel is all there is."""
    left, right = ends
    _refuse(sketch, ends, at, mark, ("axis",) if coaxial else ("axis", "centre"))
    if left.joint and right.joint:
        sketch.meetings.append((left.joint.at, right.joint.at, at))
    elif not coaxial:
        what = right.what if left.joint else left.what
        raise sketch.source.error(at, f"'{mark}' beside {what}", f"joints with a place: {PLACED}")
    if left.kind == right.kind == "axis":
        sketch.require("parallel" if coaxial else "different", (left.slot, right.slot), at, f"'{mark}'")


def _refuse(sketch: Sketch, ends: tuple[SketchEnd, SketchEnd], at: int, mark: str, allowed: tuple[str, ...]) -> None:
    for end in ends:
        if end.kind not in allowed:
            expected = (
                "a joint with one axis there" if "centre" not in allowed else "a joint with an axis or a centre there"
            )
            raise sketch.source.error(
                at, f"'{mark}' beside {end.what}", expected, _PLACE if end.kind == "nothing" else ""
            )
