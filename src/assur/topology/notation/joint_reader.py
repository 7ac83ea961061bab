"""Reading one joint: its letter, its number, a parallelogram's kind or a loop's tag, directions, a label."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import get_args

from assur.joints.catalogue import BY_LETTER
from assur.topology.chains import ParallelogramKind
from assur.topology.notation.brackets import read_directions
from assur.topology.notation.cursor import Cursor
from assur.topology.notation.syntax import Tag, WrittenDirection, WrittenJoint

_KINDS: dict[str, ParallelogramKind] = {kind: kind for kind in get_args(ParallelogramKind)}
_PARALLELOGRAM = re.compile(r"P(?:a(\d*)|_a(\d*)|_\{a(\d*)\})", re.ASCII)
_LETTER = re.compile(f"[{''.join(BY_LETTER)}]")
_NUMBER = re.compile(r"_?(\d+[a-w]?'*)|_\{(?![xyz]\})([A-Za-z0-9']+)\}|_([a-w])", re.ASCII)
_SUBSCRIPT = re.compile(r"_(?:(\d+[a-w]?'*)|\{(?![xyz]\})([A-Za-z0-9']+)\}|([a-w]))", re.ASCII)
_ROUND = re.compile(r"\^\s*\{\s*\(?([^(){}]*)\)?\s*\}|\^?\s*\(([^()]*)\)")
_BAR = re.compile(r"4R\s*,\s*([a-z][a-z0-9_-]*)", re.ASCII)
_TAG = re.compile(r"(?:(\d*)P)?(?:(\d*)R)?", re.ASCII)
_SQUARE = re.compile(r"\[([^\[\]]*)\]")
_LABEL = re.compile(r"@\s*([A-Z][a-z0-9]*'*)", re.ASCII)
_NOWHERE = WrittenDirection((0.0, 0.0, 0.0), "", 0)
_BEGIN = re.compile(r"[\[(@]|\^[{(]")


def read_joint(cursor: Cursor) -> WrittenJoint | None:
    """The joint that starts here, or None if none does.

    Errors:
        NotationError: what follows the letter is no number, kind, tag, direction or label of such a joint.
    """
    start = cursor.at
    if match := cursor.take(_PARALLELOGRAM):
        digits = _group(match)
        joint = WrittenJoint("P", start, kind=_kind_behind(cursor), name=f"Pa{digits}" if digits else "")
    elif match := cursor.take(_LETTER):
        number = cursor.take(_NUMBER)
        joint = WrittenJoint(match.group(), start, name=match.group() + _group(number) if number else "")
    else:
        return None
    while True:
        grown = _grown(cursor, joint)
        if grown is None:
            return _checked(cursor, joint)
        joint = grown


def _kind_behind(cursor: Cursor) -> ParallelogramKind:
    """That of Pa(4S), which some write for P(4S); a Pa alone has four R."""
    start = cursor.at
    match = cursor.take(_ROUND) if cursor.sees(_ROUND) else None
    kind = _KINDS.get(_group(match).strip()) if match else None
    if kind is None:
        cursor.at = start
    return kind or "4R"


def _grown(cursor: Cursor, joint: WrittenJoint) -> WrittenJoint | None:
    """The joint with one more thing that is said about it, or None."""
    if not joint.name and (number := cursor.take(_SUBSCRIPT)):
        return replace(joint, name=joint.letter + _group(number))
    if not cursor.sees(_BEGIN):
        return None
    start = cursor.at
    if match := cursor.take(_ROUND):
        return _with_round(cursor, joint, _group(match).strip(), start)
    if match := cursor.take(_SQUARE):
        if joint.directions:
            raise cursor.error(start, "a second pair of brackets", "one for each joint")
        directions = read_directions(cursor.source, cursor.text, match.start(1), match.end(1))
        return replace(joint, directions=directions)
    if match := cursor.take(_LABEL):
        return _with_label(cursor, joint, match.group(1), start)
    if cursor.text[start] == "@":
        cursor.at += 1
        raise cursor.unexpected("a label", "a label is a capital letter, then small ones or digits: R[x]@A R[y]@A")
    closing = "']'" if cursor.text[start] == "[" else "the one that closes it, behind a kind or a tag"
    raise cursor.error(start, "a bracket that is not closed", closing)


def _with_round(cursor: Cursor, joint: WrittenJoint, content: str, start: int) -> WrittenJoint:
    if joint.tag or joint.kind:
        raise cursor.error(start, "a second kind or tag", "one for each joint")
    if joint.letter == "P" and content in _KINDS:
        return replace(joint, kind=_KINDS[content])
    if joint.letter == "P" and (bar := _BAR.fullmatch(content)):
        return replace(joint, kind="4R", bar=bar.group(1))
    match = _TAG.fullmatch(content)
    if not content or match is None:
        raise cursor.error(start, f"'({content})'", _round_expected(joint), "directions stand in square brackets: R[x]")
    if joint.letter not in "RP":
        raise cursor.error(start, f"a loop's tag at {joint.letter}", "one at an R or a P")
    prismatic, revolute = (0 if part is None else int(part or 1) for part in match.groups())
    return replace(joint, tag=Tag(prismatic, revolute, start))


def _round_expected(joint: WrittenJoint) -> str:
    tag = "the tag of a planar loop such as 2P4R"
    return f"{', '.join(_KINDS)} or {tag}" if joint.letter == "P" else tag


def _with_label(cursor: Cursor, joint: WrittenJoint, label: str, start: int) -> WrittenJoint:
    if not BY_LETTER[joint.letter].turning:
        raise cursor.error(start, f"a label at {_article(joint)}", "none: a translation has no place")
    return replace(joint, labels=(*joint.labels, label))


def _checked(cursor: Cursor, joint: WrittenJoint) -> WrittenJoint:
    """The joint, if it has as many directions as its kind needs, or none."""
    count, joint_type = len(joint.directions), BY_LETTER[joint.letter]
    needed = joint_type.axes
    _check_labels(cursor, joint)
    if count in (0, needed):
        return joint
    letter = joint.letter
    if not needed:
        raise cursor.error(joint.directions[0].at, "a direction for S", "none: it turns about every axis")
    hint = "U[x,y]: the first fixed in the link before it, the second in the link after it" if needed == 2 else ""
    extra: WrittenDirection = joint.directions[min(count - 1, needed)]
    hint = hint or "decimals are written with a point: [0.5,0.866,0]"
    raise cursor.error(extra.at, f"{count} direction{'s' if count > 1 else ''} for {letter}", str(needed), hint)


def _check_labels(cursor: Cursor, joint: WrittenJoint) -> None:
    """Axes have places where joints turn; several points where there is one axis, and a centre is one point."""
    joint_type = BY_LETTER[joint.letter]
    for direction in joint.directions:
        if direction.labels and not joint_type.turning:
            raise cursor.error(direction.at, f"a label at {_article(joint)}", "none: a translation has no place")
    if len(joint.labels) > 1 and joint_type.axes != 1:
        hint = f"an axis of a U runs through further points as U[x@{joint.labels[1]},y]@{joint.labels[0]}"
        shown = " and ".join(joint.labels)
        raise cursor.error(joint.at, f"the centres {shown} of one {joint.letter}", "one", hint)
    for labels in ((*joint.labels, *direction.labels) for direction in joint.directions or (_NOWHERE,)):
        twice = next((label for index, label in enumerate(labels) if label in labels[:index]), "")
        if twice:
            raise cursor.error(joint.at, f"the label {twice} twice", "each point of an axis once")


def _article(joint: WrittenJoint) -> str:
    return "a parallelogram" if joint.kind else f"a {joint.letter}"


def _group(match: re.Match[str]) -> str:
    return next((group for group in match.groups() if group is not None), "")
