"""Directions for the axes of sketches: those written, those that the signs ask for, arbitrary ones for the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from assur.topology.directions import NAMED, Vector, near_slips, parallel, perpendicular
from assur.topology.notation.arbitrary import Arbitrary
from assur.topology.notation.brackets import direction_text
from assur.topology.notation.errors import NotationError
from assur.topology.notation.groups import Groups
from assur.topology.notation.sketch import Condition, Sketch
from assur.topology.notation.syntax import WrittenDirection


def place(sketches: Sequence[Sketch]) -> list[list[Vector]]:
    """A unit vector for every slot of every chain of a mechanism.

    The same text has the same directions. In a chain that stands alone, in the literature's form and with
    nothing placed, the first axis is z.

    Errors:
        NotationError: the literature's form beside other limbs without its first axis placed; directions
            that are nearly parallel or perpendicular; signs and directions that contradict each other.
    """
    if len(sketches) > 1:
        for sketch in sketches:
            _refuse_unplaced(sketch)
    _refuse_slips(sketches)
    taken = [placed.vector for _, placed in _written(sketches)]
    arbitrary = Arbitrary()
    directions = []
    for sketch in sketches:
        alone = len(sketches) == 1 and sketch.literature
        vectors = _solved(sketch, arbitrary, taken, upright=alone)
        for condition in sketch.conditions:
            _verify(sketch, condition, vectors)
        directions.append(vectors)
    return directions


def _solved(sketch: Sketch, arbitrary: Arbitrary, taken: list[Vector], *, upright: bool) -> list[Vector]:
    """Vectors of one chain's slots: parallel ones together, in the order of the text, auxiliary ones last."""
    groups = Groups(len(sketch.slots))
    for condition in sketch.conditions:
        if condition.kind == "parallel":
            groups.join(*condition.slots)
    fixed: dict[int, Vector] = {}
    for slot, entry in enumerate(sketch.slots):
        if entry.placed:
            fixed.setdefault(groups.of(slot), entry.placed.vector)
    order = sorted(range(len(sketch.slots)), key=lambda slot: sketch.slots[slot].auxiliary)
    if upright and not fixed and sketch.first:
        fixed[groups.of(sketch.first[0])] = NAMED["z"]
    waiting = list(dict.fromkeys(groups.of(slot) for slot in order if groups.of(slot) not in fixed))
    while waiting:
        normals = {group: _normals(sketch, groups, group, fixed) for group in waiting}
        group = next((group for group in waiting if _forced(normals[group])), waiting[0])
        waiting.remove(group)
        near = tuple(dict.fromkeys(fixed.values()))
        fixed[group] = _chosen(normals[group], arbitrary, taken, near)
        taken.append(fixed[group])
    return [_own(sketch, slot, groups, fixed) for slot in range(len(sketch.slots))]


def _normals(sketch: Sketch, groups: Groups, group: int, fixed: Mapping[int, Vector]) -> list[Vector]:
    """What a group is said to be perpendicular to, as far as it is known."""
    normals = []
    for condition in sketch.conditions:
        pair = [groups.of(slot) for slot in condition.slots]
        if condition.kind == "perpendicular" and group in pair:
            partner = pair[0] if group == pair[1] else pair[1]
            if partner in fixed:
                normals.append(fixed[partner])
    return normals


def _forced(normals: Sequence[Vector]) -> bool:
    """Whether no more than a line is left."""
    return any(not parallel(normals[0], normal) for normal in normals[1:])


def _chosen(normals: list[Vector], arbitrary: Arbitrary, taken: Sequence[Vector], near: Sequence[Vector]) -> Vector:
    """A direction perpendicular to all normals. Where none is, to the first: what is said last will not verify."""
    while True:
        direction = arbitrary.within(normals, taken, near)
        if direction is not None:
            return direction
        normals = normals[:-1]


def _own(sketch: Sketch, slot: int, groups: Groups, fixed: Mapping[int, Vector]) -> Vector:
    """The direction of a slot: as written; for a diamond's normal by its own members, so that a sign is at fault."""
    entry = sketch.slots[slot]
    if entry.placed:
        return entry.placed.vector
    if entry.auxiliary:
        said = [
            condition
            for condition in sketch.conditions
            if condition.kind == "perpendicular" and slot == condition.slots[1]
        ]
        members = [fixed[groups.of(condition.slots[0])] for condition in said[:2]]
        if _forced(members):
            return _chosen(members, Arbitrary(), (), ())
    return fixed[groups.of(slot)]


def _verify(sketch: Sketch, condition: Condition, vectors: Sequence[Vector]) -> None:
    """That a condition holds between the directions that were found.

    Errors:
        NotationError: it does not.
    """
    first, second = (vectors[slot] for slot in condition.slots)
    wrong = {
        "parallel": ("not parallel", not parallel(first, second)),
        "perpendicular": ("not perpendicular", not perpendicular(first, second)),
        "different": ("parallel", parallel(first, second)),
    }
    how, fails = wrong[condition.kind]
    if fails:
        shown = f"[{direction_text(first)}] and [{direction_text(second)}]"
        what = "not parallel" if condition.kind == "different" else condition.kind
        raise sketch.source.error(
            condition.at, f"a contradiction: {shown} are {how}", f"{what} axes, by {condition.why}"
        )


def _refuse_unplaced(sketch: Sketch) -> None:
    if sketch.literature and sketch.first and not any(sketch.slots[slot].placed for slot in sketch.first):
        text = sketch.source.text
        at = len(text) - len(text.lstrip())
        hint = "write it in brackets: -R[x] ∥ R-; or without signs, U P S, where all axes are left general"
        expected = "the direction of its first axis: the signs say nothing about the other limbs"
        raise sketch.source.error(at, "a limb in the literature's form", expected, hint)


def _written(sketches: Sequence[Sketch]) -> list[tuple[Sketch, WrittenDirection]]:
    """Directions that were written, each once."""
    first_written: dict[Vector, tuple[Sketch, WrittenDirection]] = {}
    for sketch in sketches:
        for slot in sketch.slots:
            if slot.placed:
                first_written.setdefault(slot.placed.vector, (sketch, slot.placed))
    return list(first_written.values())


def _refuse_slips(sketches: Sequence[Sketch]) -> None:
    written = _written(sketches)
    for first, second, relation in near_slips([placed.vector for _, placed in written]):
        raise _slip(written[first], written[second], relation)


def _slip(
    first: tuple[Sketch, WrittenDirection], second: tuple[Sketch, WrittenDirection], relation: str
) -> NotationError:
    """What to raise about the later one of two directions, or the earlier if that one alone is in numbers."""
    (other, reference), (sketch, placed) = sorted((first, second), key=lambda entry: "," in entry[1].shown)
    where = f" of limb {other.source.limb}" if other is not sketch else ""
    offending = f"[{placed.shown}], nearly but not exactly {relation} to [{reference.shown}]{where}"
    hint = "write more digits, 0.8660254037844386 and not 0.8661, or whole numbers in their ratio, [1,2,0]"
    return sketch.source.error(placed.at, offending, f"exactly {relation}, or clearly not", hint)
