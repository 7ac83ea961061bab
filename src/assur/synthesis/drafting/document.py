"""The text of a drafted file: TOML in the look of the catalogue's files, every section with a word on what it is."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from assur.model.mechanism import GeneralisedJoint
from assur.synthesis.drafting.limb import AXES, BASE_LINK, PLATFORM_LINK
from assur.synthesis.drafting.linear import ORIGIN, Point
from assur.synthesis.drafting.tables import Dimension, DraftJoint, DraftLink, Template
from assur.synthesis.drafting.templates import Draft
from assur.topology.directions import Vector
from assur.topology.notation.brackets import direction_text

HOME = "near home, as drawn"
ROOTS = {
    "sqrt(3)/2": math.sqrt(3) / 2, "sqrt(2)/2": math.sqrt(2) / 2, "sqrt(3)/3": math.sqrt(3) / 3,
    "sqrt(6)/3": math.sqrt(6) / 3, "sqrt(6)/6": math.sqrt(6) / 6,
}  # fmt: skip
"""Components of directions that are written as roots."""
SAME = 1e-14
"""Within which they are these."""


@dataclass(frozen=True)
class DrivenJoint:
    """What is driven: the full name of a joint, and its component where it has several."""

    joint: str
    component: str = ""


@dataclass(frozen=True)
class Chosen:
    """What a file says beside what its draft holds.

    Attributes:
        header: lines of comment at the top.
        box: coordinate -> low and high, as the file writes them.
        working: name -> formula, positive at home.
        home: joint -> values in the file's units where the loops do not close as drawn, or that is singular.
        motion: of the platform, in a word: 2T1R.
    """

    name: str
    header: tuple[str, ...]
    pose: tuple[str, ...]
    constant: bool
    inputs: tuple[DrivenJoint, ...]
    box: Mapping[str, tuple[str, str]]
    working: Mapping[str, str]
    home: Mapping[str, Sequence[float]] = field(default_factory=dict)
    motion: str = ""


def document(draft: Draft, chosen: Chosen) -> str:
    """The whole file."""
    sections = [
        _head(draft, chosen),
        _parameters(draft),
        ["[links]", *_aligned([DraftLink(BASE_LINK, "fixed base"), DraftLink(PLATFORM_LINK, "moving platform")])],
    ]
    driven = _in_template(draft, chosen.inputs)
    chained = all(template.chain is not None for template in draft.templates)
    for template in draft.templates:
        sections += _limb(template, driven, drawn=not chosen.home, chained=chained)
    if not driven:
        sections.append(_inputs(chosen.inputs))
    if chosen.home:
        rows = [f'"{name}" = {_values(values)}' for name, values in chosen.home.items()]
        sections.append(
            ["[home]                               # as the loops close, away from where it was drawn", *rows]
        )
    if chosen.working:
        sections.append(_modes(chosen))
    ends = [f"{name} = [{low}, {high}]" for name, (low, high) in chosen.box.items()]
    sections.append(
        ["[workspace]                          # where to look for the workspace", f"box = {{ {', '.join(ends)} }}"]
    )
    return "\n\n".join("\n".join(section) for section in sections) + "\n"


def _head(draft: Draft, chosen: Chosen) -> list[str]:
    constant = ['orientation = "constant"             # a declared fact, which is tested'] if chosen.constant else []
    return [
        *(f"# {line}".rstrip() for line in chosen.header),
        "",
        "format = 1",
        f'name   = "{chosen.name}"',
        f'title  = "{_title(draft, chosen.motion)}"',
        'unit   = "mm"',
        'angle  = "deg"',
        "",
        f'base = "{BASE_LINK}"',
        "",
        "[platform]",
        f'link = "{PLATFORM_LINK}"',
        f"pose = {_list(chosen.pose)}",
        *constant,
    ]


def _title(draft: Draft, motion: str) -> str:
    """The limbs as titles of papers have them, by letters; the axes stand in the comments above."""
    limbs = Counter(_AXES.sub("", chain) for chain in draft.chains)
    if len(limbs) == 1:
        names = [f"{number}-{letters}" if number > 1 else letters for letters, number in limbs.items()]
    else:
        names = [f"{number if number > 1 else ''}{letters}" for letters, number in limbs.items()]
    return f"{'-'.join(names)} mechanism, {motion}"


_AXES = re.compile(r"\[[^\]]*\]|@\w+|\s")
"""What a chain says of its axes, and spaces."""


def _parameters(draft: Draft) -> list[str]:
    listed = [*draft.dimensions]
    for template in draft.templates:
        listed += [*template.dimensions, *template.turn_dimensions]
    width = max((len(dimension.name) for dimension in listed), default=0)
    tied = any(size.formula for size in listed)
    said = "change numbers as you like, not formulas, by which loops close" if tied else "change them as you like"
    return [
        f"[parameters]                         # {said}",
        *(f"# not alone, as loops close for some values of them together: {', '.join(own)}" for own in draft.together),
        *(_dimension(dimension, width) for dimension in listed),
    ]


def _dimension(dimension: Dimension, width: int) -> str:
    sign = "" if dimension.sign == "positive" else f', sign = "{dimension.sign}"'
    sign += f', unit = "{dimension.unit}"' if dimension.unit else ""
    value = f'"{dimension.formula}"' if dimension.formula else f"{dimension.value:.12g}"
    return f'{dimension.name:{width}} = {{ value = {value}, meaning = "{dimension.meaning}"{sign} }}'


def _limb(template: Template, driven: Mapping[str, DrivenJoint], *, drawn: bool, chained: bool) -> Iterator[list[str]]:
    top = f"limbs.{template.name}"
    names = ", ".join(f"{template.name}{number}" for number, _ in enumerate(template.members, 1))
    places = (
        f'"{turn}"' if turn else f"{angle:.12g}" for angle, turn in zip(template.angles, template.turns, strict=True)
    )
    angles = f"count = {len(template.angles)}" if template.even else f"angles = [{', '.join(places)}]"
    yield [
        f"[{top}]".ljust(37)
        + f"# {names}: {template.text}"
        + (", turned about z" if len(template.members) > 1 else ""),
        f'repeat = {{ about = "z", {angles} }}',
    ]
    yield [f"[{top}.links]", *_aligned(template.links)]
    yield [f"[{top}.joints]", *_joints(template.joints)]
    for group in template.groups:
        yield _group(top, group)
    if chained and template.chain is not None:
        said = template.chain
        loop = [f"loop = {_list(said.loop)}", f'output = "{said.output}"', f"tail = {_list(said.tail)}"]
        yield [f"[{top}.chain]", *([f"serial = {_list(said.serial)}"] if said.serial else loop)]
    if template.name in driven:
        yield [f"[{top}.inputs]", _input_line(driven[template.name], "q")]
    if drawn:
        zero = "all zero: the loops close as drawn"
        rows = [
            f"{joint.name} = {_values(template.home.get(joint.name) or [0.0] * joint.type.freedoms)}"
            for joint in template.joints
        ]
        yield [f"[{top}.home]".ljust(37) + f"# {HOME if template.home else zero}", *rows]


def _joints(joints: Sequence[DraftJoint]) -> list[str]:
    names, kinds = max(len(joint.name) for joint in joints), max(len(joint.type.name) for joint in joints)
    return [f"{joint.name:{names}} = {{ {' '.join(_parts(joint, kinds))} }}".replace(", }", " }") for joint in joints]


def _parts(joint: DraftJoint, width: int) -> Iterator[str]:
    kind = f'"{joint.type.name}"'
    yield f"type = {kind + ',':{width + 3}}"
    yield f'parent = "{joint.parent}",'
    yield f'child = "{joint.child}",'
    if joint.at != ORIGIN:
        yield f"at = {point_text(joint.at)},"
    if joint.child_at != ORIGIN:
        yield f"child_at = {point_text(joint.child_at)},"
    if joint.leg is not None:
        yield f"axis = {point_text(joint.leg)},"
    elif len(joint.axes) == 1:
        yield f"axis = {axis_text(joint.axes[0])},"
    elif joint.axes:
        yield f"axes = [{', '.join(map(axis_text, joint.axes))}],"
    if joint.pitch:
        yield f'pitch = "{joint.pitch}",'


def axis_text(axis: Vector) -> str:
    """An axis as a mechanism's file writes it.

    >>> axis_text((0.0, -1.0, 0.0)), axis_text((0.6, 0.0, 0.8))
    ('"-y"', '[0.6, 0, 0.8]')
    >>> axis_text((-0.8660254037844386, -0.5, 0.0))
    '["-sqrt(3)/2", -0.5, 0]'
    """
    text = direction_text(axis)
    if text.strip("-") in AXES:
        return f'"{text}"'
    return f"[{', '.join(_root_text(part, own) for part, own in zip(axis, text.split(','), strict=True))}]"


def _root_text(number: float, text: str) -> str:
    """A number by the root that it is to all digits, so that the file's loops close exactly; else as it is."""
    for formula, root in ROOTS.items():
        if abs(abs(number) - root) < SAME:
            return f'"{"-" if number < 0 else ""}{formula}"'
    return text


def point_text(point: Point) -> str:
    """A point as a mechanism's file writes it.

    >>> from assur.synthesis.drafting.linear import Linear, dimension
    >>> point_text((dimension("R"), Linear(), Linear()))
    '["R", 0, 0]'
    """
    texts = [part.text() for part in point]
    return "[" + ", ".join(text if text == "0" else f'"{text}"' for text in texts) + "]"


def _group(top: str, group: GeneralisedJoint) -> list[str]:
    return [
        f"[{top}.generalised.{group.name}]",
        f'kind = "{group.kind}"',
        f"joints = {_list(group.joints)}",
        f'stands_for = {{ parent = "{group.parent}", child = "{group.child}" }}',
    ]


def _in_template(draft: Draft, inputs: Sequence[DrivenJoint]) -> dict[str, DrivenJoint]:
    """Inputs as a template has them, where there is one template and each of its limbs has the same single one."""
    if len(draft.templates) != 1:
        return {}
    template = draft.templates[0]
    locals_ = [(actuated.joint.split(".", 1)[1], actuated.component) for actuated in inputs]
    limbs = [actuated.joint.split(".", 1)[0] for actuated in inputs]
    every = [f"{template.name}{number}" for number, _ in enumerate(template.members, 1)]
    if limbs != every or len(set(locals_)) != 1:
        return {}
    return {template.name: DrivenJoint(*locals_[0])}


def _inputs(inputs: Sequence[DrivenJoint]) -> list[str]:
    return ["[inputs]", *(_input_line(actuated, f"q{number}") for number, actuated in enumerate(inputs, 1))]


def _input_line(actuated: DrivenJoint, name: str) -> str:
    key = f"{actuated.joint}.{actuated.component}" if actuated.component else actuated.joint
    return (f'"{key}"' if "." in key else key) + f' = {{ name = "{name}" }}'


def _modes(chosen: Chosen) -> list[str]:
    return [
        "[modes]                              # + is the branch that is drawn",
        *(f'working.{name} = "{formula}"' for name, formula in chosen.working.items()),
        f'default = {{ working = "{"+" * len(chosen.working)}" }}',
    ]


def _aligned(links: Iterable[DraftLink]) -> list[str]:
    listed = list(links)
    width = max((len(entry.name) for entry in listed), default=0)
    return [f'{entry.name:{width}} = {{ meaning = "{entry.meaning}" }}' for entry in listed]


def _list(texts: Iterable[str]) -> str:
    return "[" + ", ".join(f'"{text}"' for text in texts) + "]"


def _values(values: Sequence[float]) -> str:
    texts = [f"{value:.12g}" for value in values]
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"
