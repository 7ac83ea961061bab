"""Elements with a loop's tag, put together: the three that say what the output link of one planar loop can do."""

from __future__ import annotations

from dataclasses import dataclass

from assur.topology.notation.errors import Source
from assur.topology.notation.syntax import Diamond, Serial, Tag, WrittenJoint, WrittenLoop, WrittenSign

FREEDOMS = 3
"""Freedoms of a plane, and so the number of tagged elements of a loop; its joints are three more."""

_MOST_P = 4


@dataclass(frozen=True)
class Tagged:
    """Three neighbours with one tag, a diamond counting as two, and the signs between them."""

    tag: Tag
    items: tuple[WrittenJoint | Diamond, ...]
    signs: tuple[WrittenSign, ...]

    @property
    def members(self) -> tuple[WrittenJoint, ...]:
        """The tagged joints."""
        return tuple(joint for item in self.items for joint in members(item))


Part = WrittenJoint | Diamond | WrittenLoop | Tagged


def members(element: WrittenJoint | Diamond) -> tuple[WrittenJoint, ...]:
    """The joint itself, or the two of a diamond."""
    return element.members if isinstance(element, Diamond) else (element,)


def parts(source: Source, serial: Serial) -> tuple[tuple[Part, ...], tuple[WrittenSign, ...]]:
    """Elements in series with tagged neighbours put together, and the signs between these parts.

    Errors:
        NotationError: a tag that is no planar loop with three freedoms, or not three elements with it.
    """
    gathered: list[Part] = []
    signs: list[WrittenSign] = []
    index = 0
    while index < len(serial.items):
        if index:
            signs.append(serial.signs[index - 1])
        item = serial.items[index]
        tag = None if isinstance(item, WrittenLoop) else _tag(source, item)
        length = _length(source, serial, index, tag) if tag else 1
        if tag:
            run = tuple(item for item in serial.items[index : index + length] if not isinstance(item, WrittenLoop))
            gathered.append(Tagged(tag, run, serial.signs[index : index + length - 1]))
        else:
            gathered.append(item)
        index += length
    return tuple(gathered), tuple(signs)


def _length(source: Source, serial: Serial, start: int, tag: Tag) -> int:
    """How many elements belong to the loop that starts there."""
    _check(source, tag)
    count = length = 0
    for item in serial.items[start:]:
        if count >= FREEDOMS or isinstance(item, WrittenLoop) or str(_tag(source, item)) != str(tag):
            break
        count += len(members(item))
        length += 1
    if count != FREEDOMS:
        hint = f"they say what the loop's output link can do: ◇(P({tag}), P({tag})) ⊥ R({tag})"
        raise source.error(serial.items[start].at, f"{count} with the tag {tag}", "three neighbours with it", hint)
    return length


def _check(source: Source, tag: Tag) -> None:
    if tag.prismatic + tag.revolute != 2 * FREEDOMS or tag.prismatic > _MOST_P:
        hint = "a planar loop with three freedoms has six joints, two or more of them R: 2P4R; write others in braces"
        raise source.error(tag.at, f"the tag {tag}", "that of a planar loop with three freedoms", hint)


def _tag(source: Source, element: WrittenJoint | Diamond) -> Tag | None:
    """The tag of an element; in a diamond both have one or none."""
    tags = [joint.tag for joint in members(element)]
    if len({str(tag) for tag in tags}) > 1:
        raise source.error(element.at, "a diamond of two loops", "one tag at both, or none")
    if isinstance(element, Diamond) and tags[0] and any(joint.letter != "P" for joint in element.members):
        raise source.error(element.at, "a tagged diamond with an R", "two P, which span the plane of the loop")
    return tags[0]
