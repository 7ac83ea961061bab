"""Inner loops by their tags: `◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R)` is the real loop of 2 P and 4 R in one plane.

The tagged elements are what the loop's output link can do: three freedoms of one plane, t2 r1. The loop itself
has two branches of three joints: the P stand at the heads of the branches, the R fill them up, every R is
parallel to the tagged R and every P perpendicular to it. The P at the two heads are parallel, as in
Zeng, Yang, Shen, Chablat 2019, unless they are placed or related otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from assur.topology.notation.ends import SketchEnd, relate
from assur.topology.notation.sketch import ConditionKind, JointSketch, LoopSketch, Sketch
from assur.topology.notation.syntax import WrittenJoint
from assur.topology.notation.tags import FREEDOMS, Tagged


def expand(sketch: Sketch, tagged: Tagged) -> tuple[LoopSketch, SketchEnd, SketchEnd]:
    """The real loop, and its two ends: those of the elements that stand for it.

    Errors:
        NotationError: a label; no R; a name or a direction for a joint that the loop does not have.
    """
    normal = sketch.slot(auxiliary=True)
    slots = {joint.at: _member(sketch, tagged, joint, normal) for joint in tagged.members}
    if not sketch.first:
        sketch.first.extend(slots.values())
    ends = [
        SketchEnd("axis", f"the tagged {item.letter}", slots[item.at])
        if isinstance(item, WrittenJoint)
        else SketchEnd("plane", "a diamond", normal)
        for item in tagged.items
    ]
    for left, right, sign in zip(ends, ends[1:], tagged.signs, strict=False):
        relate(sketch, left, right, sign)
    sliders = _sliders(sketch, tagged, slots, normal)
    hinges, name = _hinges(sketch, tagged, normal)
    first, second = sliders[0::2], sliders[1::2]
    cut = FREEDOMS - len(first)
    return LoopSketch(((*first, *hinges[:cut]), (*second, *hinges[cut:])), name), ends[0], ends[-1]


def _member(sketch: Sketch, tagged: Tagged, joint: WrittenJoint, normal: int) -> int:
    """A slot for a tagged element: an R along the normal of the plane, a P in the plane."""
    if any(joint.points):
        raise sketch.source.error(joint.at, "a label at a tagged element", "none: write the loop in braces")
    if all(other.letter == "P" for other in tagged.members):
        hint = f"a plane has one rotation too: ◇(P({tagged.tag}), P({tagged.tag})) ⊥ R({tagged.tag})"
        raise sketch.source.error(tagged.members[-1].at, f"three P with the tag {tagged.tag}", "an R", hint)
    slot = sketch.slot(joint.directions[0] if joint.directions else None)
    kind: ConditionKind = "parallel" if joint.letter == "R" else "perpendicular"
    sketch.require(kind, (slot, normal), joint.at, f"the tag {tagged.tag}")
    return slot


def _sliders(sketch: Sketch, tagged: Tagged, slots: dict[int, int], normal: int) -> list[JointSketch]:
    """The P of the loop: one head, the other, behind the first head, behind the second."""
    tag, why = tagged.tag, f"the tag {tagged.tag}"
    joints = [joint for joint in tagged.members if joint.letter == "P"]
    _refuse_extra(sketch, tagged, joints[tag.prismatic :])
    sliders = [JointSketch(replace(joint, directions=()), (slots[joint.at],)) for joint in joints[: tag.prismatic]]
    while len(sliders) < tag.prismatic:
        sliders.append(JointSketch(WrittenJoint("P", tag.at), (sketch.slot(),)))
        sketch.require("perpendicular", (sliders[-1].slots[0], normal), tag.at, why)
    directions = [slider.slots[0] for slider in sliders]
    if len(directions) > 1 and not _said(sketch, tagged, directions):
        sketch.require("parallel", (directions[0], directions[1]), tag.at, why)
    for head, behind in zip(directions, directions[2:], strict=False):
        sketch.require("different", (head, behind), tag.at, why)
    return sliders


def _said(sketch: Sketch, tagged: Tagged, directions: Sequence[int]) -> bool:
    """Whether the writer says how the P at the two heads lie to each other."""
    letters = [item.letter if isinstance(item, WrittenJoint) else "" for item in tagged.items]
    pairs = zip(letters, letters[1:], tagged.signs, strict=False)
    related = any(left == right == "P" and sign.relations for left, right, sign in pairs)
    return related or all(sketch.slots[slot].placed for slot in directions[:2])


def _hinges(sketch: Sketch, tagged: Tagged, normal: int) -> tuple[list[JointSketch], str]:
    """The R of the loop, and the name of its rotation: that of the tagged R, if there is one only."""
    joints = [joint for joint in tagged.members if joint.letter == "R"]
    _refuse_extra(sketch, tagged, joints[tagged.tag.revolute :])
    names = [joint.name for joint in joints] if len(joints) > 1 else []
    names += [""] * (tagged.tag.revolute - len(names))
    hinges = [
        JointSketch(WrittenJoint("R", tagged.tag.at, name=name), (normal,)) for name in names[: tagged.tag.revolute]
    ]
    return hinges, joints[0].name if len(joints) == 1 else ""


def _refuse_extra(sketch: Sketch, tagged: Tagged, joints: Sequence[WrittenJoint]) -> None:
    """A name or a direction of a joint that stands for the loop, but is none of its own, would be lost."""
    for joint in joints:
        if joint.name or (joint.directions and joint.letter == "P"):
            offending = f"a name or a direction for the tagged {joint.letter}"
            raise sketch.source.error(joint.at, offending, f"neither: the loop {tagged.tag} has no such {joint.letter}")
