"""Missing: how far every leg stays from the platform where that is wanted.

For a moment every leg stands on a foot that can be pushed about on the base. The loops are closed and the platform is
where it is wanted, and the feet are pushed as little as can be: what is left of that is what the leg misses.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joints.prismatic import PRISMATIC
from assur.kinematics.closure import CLOSED, RANK_GAP, assemble, closing_system
from assur.model.mechanism import Coordinate, Joint, Link, MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
MISSED = 1e3 * CLOSED
"""Push from which on a leg misses, as a share of the characteristic length."""

SLIGHT = 1e-3
"""Share of the worst miss below which another one is not worth a word, nor sure."""

STRAIGHT = 0.7
"""Cosine from which on a push counts as one along the leg."""

STEPS, FEW = 120, 20
"""Steps at most, and those after which a pose that has not been reached is taken for one that cannot be."""

DAMPING, LEAST = 1.0, 1e-9
"""Of the first step; and the least push that a leg is taken to have, in characteristic lengths."""

GAIN = 1e-9
"""A step that promises to lessen the sum of squares by a smaller share is the last."""

DIGITS = 6
"""Misses that agree to so many digits are equal, so that rounding decides no order."""


@dataclass(frozen=True)
class Miss:
    """What one leg misses: its name in the file, a length in the mechanism's unit, and in what sense."""

    leg: str
    amount: float
    sense: str


def misses(record: MechanismRecord, start: FloatArray, pose: FloatArray) -> tuple[Miss, ...]:
    """Legs that do not reach the platform at a pose (m,), the worst first; equal ones in the order of the file.

    Where the platform's orientation is said to be constant it is held; coordinates that the pose does not name are
    those at which the legs together miss least. Limits are not asked. () where every leg reaches, and where the least
    was not found: there is no number then.

    Args:
        record: the mechanism.
        start: (n,) joint values, an assembly from which the legs are stretched.
        pose: (m,) in lengths and rad.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = misses(record, home_values(record), np.array([0.0, 300.0]))
    >>> [(item.leg, round(item.amount, 3), item.sense) for item in found]
    [('leg1', 14.058, 'too short'), ('leg2', 14.058, 'too short')]
    """
    if bool(assemble(record, start, poses=pose, max_steps=FEW).closed):
        return ()
    pushed = _on_feet(record)
    values = _stretched(record, start, pose)
    if values is None:
        return ()
    rotation, origin = frames(pushed, values)[record.platform.link]
    at_platform = rotation @ record.platform.point + origin
    by_leg: dict[str, Miss] = {}
    for k, foot in enumerate(_feet(record)):
        push = values[len(start) + 3 * k : len(start) + 3 * k + 3]
        amount = float(np.linalg.norm(push))
        if amount > by_leg.get(foot.leg, Miss(foot.leg, 0.0, "")).amount:
            by_leg[foot.leg] = Miss(foot.leg, amount, _sense(push, at_platform - foot.at))
    worst = max((miss.amount for miss in by_leg.values()), default=0.0)
    least = max(MISSED * characteristic_length(record), SLIGHT * worst)
    order = sorted(by_leg.values(), key=lambda miss: -float(f"{miss.amount:.{DIGITS}g}"))
    return tuple(miss for miss in order if miss.amount > least)


@dataclass(frozen=True, eq=False)
class _Foot:
    """What a leg stands on: the joints that begin there, those of one generalised joint or a single one.

    `at` (3,) is the point of the first of them in the base, `leg` the name of the leg.
    """

    joints: tuple[str, ...]
    at: FloatArray
    leg: str


@lru_cache(maxsize=16)
def _feet(record: MechanismRecord) -> tuple[_Foot, ...]:
    """The feet of every leg, in the order of the file."""
    groups: dict[str, list[Joint]] = {}
    for joint in record.joints.values():
        if record.base in _links(joint) and _to_platform(record, joint):
            together = [name for name, generalised in record.generalised.items() if joint.name in generalised.joints]
            groups.setdefault(together[0] if together else joint.name, []).append(joint)
    return tuple(
        _Foot(
            tuple(joint.name for joint in group),
            group[0].at if group[0].parent == record.base else group[0].child_at,
            _named(record, _to_platform(record, group[0])),
        )
        for group in groups.values()
    )


def _to_platform(record: MechanismRecord, first: Joint) -> tuple[str, ...]:
    """The fewest joints to the platform, beginning with one at the base; () where they pass the base again."""
    ways: dict[str, tuple[str, ...]] = {_across(first, record.base): (first.name,)}
    for link in (queue := list(ways)):
        for name, joint in record.joints.items():
            other = _across(joint, link)
            if other and other != record.base and other not in ways:
                ways[other] = (*ways[link], name)
                queue.append(other)
    return ways.get(record.platform.link, ())


def _across(joint: Joint, link: str) -> str:
    """The link on the other side of a joint; "" where it is not at this one."""
    return joint.child if joint.parent == link else joint.parent if joint.child == link else ""


def _links(joint: Joint) -> tuple[str, str]:
    return joint.parent, joint.child


def _named(record: MechanismRecord, joints: Sequence[str]) -> str:
    """The chain of the file to which most of the joints belong, or the repeated limb; else the leg of the first."""
    joints_in_chain = {
        chain.name: sum(name in joints for name in _members(record, chain.name)) for chain in record.chains.values()
    }
    best = max(joints_in_chain, key=lambda name: joints_in_chain[name], default="")
    if best and joints_in_chain[best]:
        return best
    links = [link for name in joints for link in _links(record.joints[name])]
    limbs = [link.partition(".")[0] for link in links if "." in link]
    return limbs[0] if limbs else f"the leg of {joints[0]}"


def _members(record: MechanismRecord, chain: str) -> Iterator[str]:
    """Joints of a chain, those of its generalised joints too."""
    chain_record = record.chains[chain]
    for name in dict.fromkeys((*chain_record.serial, *chain_record.loop, *chain_record.tail)):
        yield from record.generalised[name].joints if name in record.generalised else (name,)


@lru_cache(maxsize=16)
def _on_feet(record: MechanismRecord) -> MechanismRecord:
    """The mechanism with three slides along X, Y and Z under every foot, their values after all others.

    Where the platform does not turn, its orientation is among the coordinates of the pose.
    """
    joints, links, coordinates = dict(record.joints), dict(record.links), list(record.coordinates)
    for foot in _feet(record):
        between = [record.base, *(f"{foot.joints[0]} foot {axis}" for axis in LENGTHS)]
        links |= {name: Link(name) for name in between[1:]}
        for name in foot.joints:
            near, far = ((between[-1] if link == record.base else link) for link in _links(joints[name]))
            joints[name] = replace(joints[name], parent=near, child=far)
        for axis, (near, far) in zip(np.eye(3), pairwise(between), strict=True):
            joints[far] = Joint(far, PRISMATIC, near, far, np.zeros(3), np.zeros(3), axis[None], np.eye(3))
            coordinates.append(Coordinate(far, "translation", len(coordinates), "length"))
    pose = record.platform.pose
    if record.platform.orientation == "constant" and set(pose) <= set(LENGTHS):
        pose = (*pose, *QUATERNION)
    platform = replace(record.platform, pose=pose)
    return replace(record, platform=platform, joints=joints, links=links, coordinates=tuple(coordinates))


def _stretched(record: MechanismRecord, start: FloatArray, pose: FloatArray) -> FloatArray | None:
    """Joint values with the loops closed, the platform at a pose (m,) and the feet pushed as little as can be.

    None where the loops do not close, and where `STEPS` do not get there: small steps that heavy damping makes small
    are no proof of it.

    Gauss-Newton steps along what the loops and the pose leave free, closed again after each; damped as H. B. Nielsen
    does (Damping parameter in Marquardt's method, IMM-REP-1999-05, 1999), but every leg by as much as it is pushed,
    as the curvature that Gauss and Newton leave out is in proportion to that.
    """
    pushed, whole_pose = _on_feet(record), _whole(record, start, pose)
    size = characteristic_length(record)
    scale = joint_scales(pushed)
    feet, legs, damping, harder = np.arange(len(start), len(scale)), _legs(pushed), DAMPING, 2.0
    first = assemble(pushed, np.concatenate([start, np.zeros(len(feet))]), poses=whole_pose)
    if not bool(first.closed):
        return None
    values = first.values
    for _ in range(STEPS):
        push = values[feet] / size
        error = float(push @ push)
        if error <= CLOSED**2:
            return values
        free = null_space(closing_system(pushed, values[None], whole_pose[None])[1][0] * scale / size, rcond=RANK_GAP)
        turned = free[feet]
        pushes = np.bincount(legs[feet], push**2, minlength=int(np.max(legs)) + 1) ** 0.5
        curved = free.T @ (np.maximum(pushes[legs], LEAST)[:, None] * free)
        step = np.linalg.solve(turned.T @ turned + damping * curved, -turned.T @ push)
        promised = error - float(np.sum((push + turned @ step) ** 2))
        if promised <= GAIN * error:
            return values if damping <= DAMPING else None
        closed = assemble(pushed, values + scale * (free @ step), poses=whole_pose, near=True)
        gain = error - float(np.sum((closed.values[feet] / size) ** 2))
        if bool(closed.closed) and gain > 0.0:
            values, harder = closed.values, 2.0
            damping *= max(1 / 3, 1.0 - (2.0 * gain / promised - 1.0) ** 3)
        else:
            damping, harder = damping * harder, 2.0 * harder
    return None


@lru_cache(maxsize=16)
def _legs(record: MechanismRecord) -> NDArray[np.int64]:
    """A number (n,) for every joint value: the same for what hangs together without the base and the platform."""
    inner = [link for link in record.links if link not in (record.base, record.platform.link)]
    number = {link: k for k, link in enumerate(inner)}
    for joint in record.joints.values():
        if joint.parent in number and joint.child in number:
            old, new = number[joint.parent], number[joint.child]
            number = {link: new if leg == old else leg for link, leg in number.items()}
    ends = [_links(record.joints[coordinate.joint]) for coordinate in record.coordinates]
    return np.array([next(number[link] for link in pair if link in number) for pair in ends])


def _whole(record: MechanismRecord, start: FloatArray, pose: FloatArray) -> FloatArray:
    """A pose (m,) with the orientation (4,) that the platform has at the start, where it does not turn."""
    if _on_feet(record).platform.pose == record.platform.pose:
        return pose
    return np.concatenate([pose, rotations.to_quaternion(frames(record, start)[record.platform.link][0])])


def _sense(push: FloatArray, way: FloatArray) -> str:
    """Whether a leg is too short, too long or off to the side, by the push (3,) that its foot needs.

    `way` (3,) leads from where it stands to the platform's point.
    """
    cosine = float(push @ way) / max(float(np.linalg.norm(push) * np.linalg.norm(way)), 1e-300)
    return "too short" if cosine > STRAIGHT else "too long" if cosine < -STRAIGHT else "off"
