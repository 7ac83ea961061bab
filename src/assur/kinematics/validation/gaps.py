"""Why loops do not close: which of them, by how much, and whether a dimension, an axis or only the home is at fault."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import Problem
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import angle_at_border, quantity_text
from assur.kinematics.closure import Assembly, assemble, residuals
from assur.kinematics.limits import limits
from assur.kinematics.turns import unwrapped
from assur.model.file.place import place, problem, table_place
from assur.model.mechanism import Coordinate, Joint, MechanismRecord
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]

LONGER = 1.0 + 1e-9
"""A side longer than the rest of its loop by no more than rounding still closes, stretched out."""

EFFORT = 40_000
"""Starts of a search times the square of the number of joint values; between `FEWEST` and `MOST` starts."""
FEWEST, MOST = 8, 96
SHOWN = 12
SAME = 1e-6
NEARLY = np.radians(10.0)
"""Below `SAME` (rad) axes are parallel; below `NEARLY` they may have been meant to be."""


@dataclass(frozen=True)
class JointCycle:
    """Joints in turn around a loop; `links[i]` lies between joint i and the next, the last before the first."""

    joints: tuple[str, ...]
    links: tuple[str, ...]

    def __str__(self) -> str:
        return f"the loop through {', '.join(self.joints)}"


def loops(record: MechanismRecord) -> tuple[JointCycle, ...]:
    """One loop for each joint that closes one, by the shortest ways to the base.

    >>> from assur.model.registry import load_record
    >>> [str(loop) for loop in loops(load_record("fivebar"))]
    ['the loop through A1, B1, P, B2, A2']
    """
    graph = joint_graph(record)
    return tuple(_turned(record, cut, list(tree)) for cut, tree in zip(graph.cut, graph.loops, strict=True))


def _turned(record: MechanismRecord, cut: Joint, left: list[str]) -> JointCycle:
    """Around from the joint that the file names first."""
    joints, links = [cut.name], [cut.child]
    while left:
        name = next(name for name in left if links[-1] in _ends(record.joints[name]))
        left.remove(name)
        first, second = _ends(record.joints[name])
        joints.append(name)
        links.append(second if links[-1] == first else first)
    order = list(record.joints)
    start = min(range(len(joints)), key=lambda at: order.index(joints[at]))
    return JointCycle(tuple(joints[start:] + joints[:start]), tuple(links[start:] + links[:start]))


def _ends(joint: Joint) -> tuple[str, str]:
    return joint.parent, joint.child


def gap_problems(record: MechanismRecord) -> tuple[Problem, ...]:
    """What keeps the loops of a mechanism from closing near its home; empty where nothing does.

    A side that is longer than the rest of its loop is a proof that it never closes. Else every loop is tried by itself,
    so that the faults of one do not hide those of another; then all together.

    >>> from assur.model.registry import load_record
    >>> gap_problems(load_record("fivebar"))
    ()
    """
    found = assemble(record, record.home)
    if bool(found.closed):
        return ()
    own: dict[object, Problem] = {}
    for loop in loops(record):
        alike = frozenset(place(record, "joints", name) for name in loop.joints)  # as those of a template's limbs are
        fault = None if alike in own else _too_long(record, loop) or _of_one(record, loop)
        if fault:
            own[alike] = fault
    return tuple(dict.fromkeys(own.values())) or (_of_all(record, found),)


def _too_long(record: MechanismRecord, loop: JointCycle) -> Problem | None:
    """A side of a loop that the others together cannot span, whatever their angles."""
    if any(record.joints[name].type.carries for name in loop.joints):
        return None  # which carry any distance
    following = [*loop.joints[1:], loop.joints[0]]
    spans = [
        float(np.linalg.norm(_point(record.joints[first], link) - _point(record.joints[second], link)))
        for first, second, link in zip(loop.joints, following, loop.links, strict=True)
    ]
    longest = int(np.argmax(spans))
    reach = sum(spans) - spans[longest]
    if spans[longest] <= LONGER * reach:
        return None
    link, unit = loop.links[longest], record.unit
    pair = (loop.joints[longest], following[longest])
    ends = " and ".join(sorted(pair, key=list(record.joints).index))
    found = f"spans {spans[longest]:.6g} {unit} between {ends}, the rest of its loop only {reach:.6g} {unit}"
    factor = spans[longest] / reach if reach else np.inf
    hint = f"it is {factor:.3g} times as much: are all lengths in {unit}?" if factor > 20 else ""
    hint = hint or f"whatever the angles, {loop} cannot close"
    return problem(record, place(record, "links", link), found, "no side longer than the others together", hint)


def _point(joint: Joint, link: str) -> FloatArray:
    return joint.at if link == joint.parent else joint.child_at


def _of_one(record: MechanismRecord, loop: JointCycle) -> Problem | None:
    """A loop that does not close by itself, all others open."""
    alone, indices = _alone(record, loop)
    found = assemble(alone, alone.home)
    if bool(found.closed):
        return None
    coordinates = [record.coordinates[index] for index in indices]
    hint = _hint(alone, coordinates, found, loop.joints)
    text = f"{loop} does not close from home: a gap of {_gap(alone, found)} remains"
    return problem(record, table_place(record, "home"), text, "values near an assembled configuration", hint)


def _alone(record: MechanismRecord, loop: JointCycle) -> tuple[MechanismRecord, list[int]]:
    """The mechanism with the links and joints of one loop only, and the indices of its joint values."""
    kept = [item for item in record.coordinates if item.joint in loop.joints]
    indices = [item.index for item in kept]
    own = {item.index: dataclasses.replace(item, index=index) for index, item in enumerate(kept)}
    driven = [item for item in record.inputs if item.coordinate.index in own]
    base, platform = loop.links[-1], record.platform.link
    alone = dataclasses.replace(
        record,
        joints={name: joint for name, joint in record.joints.items() if name in loop.joints},
        links={name: record.links[name] for name in loop.links},
        base=base,
        platform=dataclasses.replace(record.platform, link=platform if platform in loop.links else base),
        coordinates=tuple(own.values()),
        home=record.home[indices],
        inputs=tuple(dataclasses.replace(item, coordinate=own[item.coordinate.index]) for item in driven),
        generalised={},
        chains={},
        closed_form=None,
    )
    return alone, indices


def _of_all(record: MechanismRecord, assembly: Assembly) -> Problem:
    """Loops each of which closes by itself, but not all at once."""
    text = f"each loop closes by itself, but not all together: a gap of {_gap(record, assembly)} remains"
    hint = _hint(record, record.coordinates, assembly, tuple(record.joints))
    return problem(record, table_place(record, "home"), text, "values near an assembled configuration", hint)


def _gap(record: MechanismRecord, assembly: Assembly) -> str:
    """The largest gap left: a distance or, where that weighs more, an angle."""
    gaps = np.linalg.norm(residuals(record, assembly.values).reshape(-1, 2, 3), axis=-1)
    distance, turn = np.max(gaps, axis=0)
    if distance >= turn:
        return quantity_text(record, distance, "length", digits=3)
    return quantity_text(record, turn / characteristic_length(record), "angle", digits=3)


def _hint(
    record: MechanismRecord, coordinates: Sequence[Coordinate], assembly: Assembly, joints: tuple[str, ...]
) -> str:
    home = _other_home(record)
    axes = axes_hint(record, assembly.values, joints)
    if isinstance(home, int):
        return f"nor from {home} other starts, so a dimension or an axis is at fault{'; ' if axes else ''}{axes}"
    values: dict[str, list[str]] = {}
    for item, value in zip(coordinates, home, strict=True):
        shown = angle_at_border(record, value) if item.kind == "angle" else value
        values.setdefault(item.joint, []).append(f"{round(float(shown), 6):.6g}")
    lists = [f"{name} = " + (only[0] if len(only) == 1 else f"[{', '.join(only)}]") for name, only in values.items()]
    more = ", ..." if len(lists) > SHOWN else ""
    return f"{axes}{'; ' if axes else ''}another home closes: {', '.join(lists[:SHOWN])}{more}"


def _other_home(record: MechanismRecord) -> FloatArray | int:
    """Joint values (n,) that close, the nearest that random starts lead to; or how many starts led to none.

    Within the limits and strokes, if any of them is.
    """
    size = len(record.home)
    count = int(np.clip(EFFORT // size**2, FEWEST, MOST))
    scale = joint_scales(record)
    random = np.random.default_rng(0)
    spread = np.where(np.arange(count) % 2, 0.5, 2.0)[:, None]
    found = assemble(record, record.home + spread * scale * random.normal(size=(count, size)))
    if not found.closed.any():
        return count
    closed = found.values[found.closed]
    margins = [limit.margin(closed) for limit in limits(record, closed[0])]
    inside = np.all(np.array(margins).reshape(len(margins), len(closed)) >= 0.0, axis=0)
    closed = closed[inside] if inside.any() else closed
    away = unwrapped(record, closed - record.home) / scale
    nearest = away[np.argmin(np.linalg.norm(away, axis=-1))]
    return np.asarray(record.home + nearest * scale)


def axes_hint(record: MechanismRecord, values: FloatArray, joints: Sequence[str]) -> str:
    """Which axes of joints with one axis among `joints` are, at joint values (n,), probably meant to be parallel.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> axes_hint(record, home_values(record), tuple(record.joints))
    ''
    """
    placed = frames(record, values)
    axes = {
        name: placed[joint.parent][0] @ joint.axes[0]
        for name, joint in record.joints.items()
        if name in joints and joint.type.turns == 1
    }
    names = list(axes)
    angles = {
        (one, other): float(np.arctan2(np.linalg.norm(cross(axes[one], axes[other])), abs(axes[one] @ axes[other])))
        for place, one in enumerate(names)
        for other in names[:place]
    }
    near = {pair: angle for pair, angle in angles.items() if SAME < angle < NEARLY}
    if near:
        one, other = min(near, key=lambda pair: (round(near[pair], 9), not _share_link(record, pair)))
        apart = quantity_text(record, near[one, other], "angle", digits=3)
        return f"the axes of {other} and {one} are {apart} from parallel"
    for name in names:
        rest = [other for other in names if other != name]
        among = [angle for pair, angle in angles.items() if name not in pair]
        own = [angle for pair, angle in angles.items() if name in pair]
        if len(rest) > 2 and max(among) <= SAME < min(own):
            return f"the axis of {name} is not parallel to those of {', '.join(rest)}"
    return ""


def _share_link(record: MechanismRecord, pair: tuple[str, str]) -> bool:
    first, second = (record.joints[name] for name in pair)
    return not {first.parent, first.child}.isdisjoint((second.parent, second.child))
