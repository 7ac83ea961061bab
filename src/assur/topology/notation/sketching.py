"""From what a text says to a sketch: slots for axes, conditions from signs, tags expanded to loops."""

from __future__ import annotations

from assur.joints.catalogue import BY_LETTER
from assur.topology.notation.ends import SketchEnd, relate
from assur.topology.notation.inner import expand
from assur.topology.notation.sketch import ConditionKind, ElementSketch, JointSketch, LoopSketch, Sketch
from assur.topology.notation.syntax import Diamond, Serial, WrittenJoint, WrittenLimb, WrittenLoop
from assur.topology.notation.tags import Part, parts

Sketched = tuple[tuple[ElementSketch, ...], SketchEnd, SketchEnd]


def sketch_of(limb: WrittenLimb) -> Sketch:
    """A sketch of a chain.

    Errors:
        NotationError: a name twice; a sign to which its neighbours give no meaning; tags that make no loop.
    """
    sketch = Sketch(limb.source, limb.literature, ends=limb.ends)
    sketch.elements = _series(sketch, limb.serial)
    return sketch


def _series(sketch: Sketch, serial: Serial) -> tuple[ElementSketch, ...]:
    items, signs = parts(sketch.source, serial)
    elements: list[ElementSketch] = []
    left: SketchEnd | None = None
    for item, sign in zip(items, (None, *signs), strict=True):
        made, first, last = _part(sketch, item)
        if left and sign:
            relate(sketch, left, first, sign)
        elements += made
        left = last
    return tuple(elements)


def _part(sketch: Sketch, part: Part) -> Sketched:
    if isinstance(part, WrittenJoint):
        return _joint(sketch, part)
    if isinstance(part, Diamond):
        return _diamond(sketch, part)
    if isinstance(part, WrittenLoop):
        loop = LoopSketch(tuple(_series(sketch, branch) for branch in part.branches))
        end = SketchEnd("nothing", "a loop in braces")
        return (loop,), end, end
    for joint in part.members:
        _note_name(sketch, joint)
    expanded, first, last = expand(sketch, part)
    return (expanded,), first, last


def _joint(sketch: Sketch, joint: WrittenJoint) -> Sketched:
    _note_name(sketch, joint)
    point, further = joint.points
    if point:
        sketch.labels[joint.at] = point
    sketch.written_labels.update({point, *(label for labels in further for label in labels)} - {""})
    count = BY_LETTER[joint.letter].axes
    slots = tuple(sketch.slot(joint.directions[i] if joint.directions else None) for i in range(count))
    if slots and not sketch.first:
        sketch.first.append(slots[0])
    made = (JointSketch(joint, slots),)
    if joint.kind:
        end = SketchEnd("nothing", "a parallelogram")
        return made, end, end
    placeable = joint if BY_LETTER[joint.letter].turning else None
    if not slots:
        end = SketchEnd("centre", joint.letter, joint=placeable)
        return made, end, end
    if count == 2:
        placed = bool(joint.directions)
        kind: ConditionKind = "different" if placed else "perpendicular"
        at = joint.directions[1].at if placed else joint.at
        sketch.require(kind, (slots[0], slots[1]), at, "the two axes of a U", ties=False)
    first, last = (SketchEnd("axis", joint.letter, slot, placeable) for slot in (slots[0], slots[-1]))
    return made, first, last


def _diamond(sketch: Sketch, diamond: Diamond) -> Sketched:
    """Two elements in series, and their plane by a slot for its normal."""
    made = [_joint(sketch, joint)[0][0] for joint in diamond.members]
    first, second = (slider.slots[0] for slider in made if isinstance(slider, JointSketch))
    normal = sketch.slot(auxiliary=True)
    why = "a diamond"
    sketch.require("different", (first, second), diamond.at, why)
    sketch.require("perpendicular", (first, normal), diamond.at, why)
    sketch.require("perpendicular", (second, normal), diamond.at, why)
    end = SketchEnd("plane", "a diamond", normal)
    return tuple(made), end, end


def _note_name(sketch: Sketch, joint: WrittenJoint) -> None:
    if not joint.name:
        return
    if joint.name in sketch.names:
        offending = f"the name {joint.name} again"
        raise sketch.source.error(joint.at, offending, "another one: every joint of a chain has its own")
    sketch.names[joint.name] = joint.at
