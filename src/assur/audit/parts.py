"""What a part of a joint graph lets a link do, at configurations of the whole mechanism: by rules and by twists."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import lru_cache

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.structure import linkage
from assur.model.mechanism import MechanismRecord
from assur.topology.agreement import agreed, by_twists
from assur.topology.analysis import Sample, sample
from assur.topology.poc import PocSet
from assur.topology.routes import by_rules
from assur.topology.screws.edges import Edge
from assur.topology.screws.limb_linkage import limb_values
from assur.topology.screws.linkage import Linkage, part
from assur.topology.screws.recognition import recognised
from assur.topology.screws.twists import dimensions, edges, motion_space
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal

FloatArray = NDArray[np.float64]

GENERAL = (0.37, -0.71, 0.53)
"""From O' of the platform to a general point, at home, in lengths of the mechanism."""

WITHIN = 1e-6
"""Sine of the angle below which a direction lies in a line or plane."""


@lru_cache(maxsize=8)
def sampled(record: MechanismRecord) -> Sample:
    """The joint graph at some finite displacements from home, where ranks are taken; one sample for every number.

    >>> from assur.model.registry import load_record
    >>> sampled(load_record("zeng2019")).values.shape
    (4, 17)
    """
    return sample(linkage(record))


def called(record: MechanismRecord, names: Collection[str]) -> tuple[str, ...]:
    """Joints as the engine calls them: by their alias, where they have one."""
    alias = {name: joint.alias for name, joint in record.joints.items() if joint.alias}
    return tuple(alias.get(name, name) for name in names)


@dataclass(frozen=True, eq=False)
class LinkMotion:
    """What joints let a link do against another one, O' at a general point of it.

    Attributes:
        poc: by the rules, confirmed by the twists; by the twists alone where the rules refuse.
        refusal: why the rules refuse; empty where they do not.
        space: (N, 6, k) basis of the twists at N configurations.
        joints: their edges at these configurations.
    """

    poc: PocSet
    refusal: str
    space: FloatArray
    joints: tuple[Edge, ...]

    def axes(self, names: Collection[str]) -> FloatArray:
        """Unit directions (N, 3, k) of the axes of some of the joints, where they are at each configuration.

        Errors:
            UnknownNameError: a joint that is not one of them.
        """
        place = {edge.name: edge for edge in self.joints}
        for name in names:
            if name not in place:
                raise UnknownNameError("joint of this part", name, place)
        twists = np.concatenate([place[name].twists for name in names], axis=-1)
        turning = np.any(np.abs(twists[:, :3]) > WITHIN, axis=1, keepdims=True)
        parts = np.where(turning, twists[:, :3], twists[:, 3:])
        directions: FloatArray = parts / np.linalg.norm(parts, axis=1, keepdims=True)
        return directions

    @property
    def translations(self) -> FloatArray:
        """Directions (N, 3, k) that the velocity of O' takes."""
        return self.space[:, 3:]

    @property
    def rotations(self) -> FloatArray:
        """Directions (N, 3, k) that the angular velocity takes."""
        return self.space[:, :3]


def within(directions: FloatArray, axes: FloatArray) -> bool:
    """Whether directions (N, 3, k) lie in what axes (N, 3, j) span, at every configuration.

    >>> x, y = np.eye(3)[None, :, :1], np.eye(3)[None, :, 1:2]
    >>> within(x, np.concatenate([x + y, y], axis=-1)), within(x, y)
    (True, False)
    """
    left, singular, _ = np.linalg.svd(axes, full_matrices=False)
    spanned = left * (singular > WITHIN)[:, None]
    outside = directions - spanned @ np.swapaxes(spanned, -1, -2) @ directions
    return bool(np.max(np.abs(outside), initial=0.0) < WITHIN)


def square(directions: FloatArray, axes: FloatArray) -> bool:
    """Whether directions (N, 3, k) are perpendicular to axes (N, 3, j), at every configuration."""
    return bool(np.max(np.abs(np.swapaxes(axes, -1, -2) @ directions), initial=0.0) < WITHIN)


def link_motion(
    record: MechanismRecord, link: str, joints: Sequence[str] = (), base: str = "", opened: str = ""
) -> LinkMotion:
    """What some joints of a mechanism let a link do, by rules and by twists.

    Args:
        record: a mechanism; its configurations are those of all its loops closed.
        link: what moves.
        joints: by name or alias, or generalised joints by name; all of them by default.
        base: what it moves against, by default the mechanism's base.
        opened: a joint that is taken off the link, so that what is looked at is where the link was on its side: the
            open chain of a loop, whose dim M is ξ of Eq. (4).

    Errors:
        UnknownNameError: no such joint or link in the part. UsageError: the part does not hang together.
        RoutesDisagreeError: rules and twists differ.

    >>> from assur.model.registry import load_record
    >>> link_motion(load_record("zeng2019"), "platform", ("D1", "D2"), base="link11").poc.text("ascii")
    't^2(_|_R3) r^1(||R3)'
    """
    sample = sampled(record)
    some = _part(sample.linkage, called(record, joints) or tuple(sample.linkage.joints), link, base)
    still = sample.keeps_orientation and (some.base, link) == (sample.linkage.base, sample.linkage.platform)
    if opened:
        some = _opened(some, *called(record, [opened]))
    _check_connected(some)
    moved = edges(some, limb_values(sample.linkage, some, sample.values), collapsed=False)
    space = motion_space(moved, some.base, some.platform)
    rules = _rules(some, still, dimensions(space))
    if isinstance(rules, Refusal):
        return LinkMotion(by_twists(space), rules.reason, space, moved)
    what = f"{record.name}, {link} moved by {' '.join(joints) or 'all joints'}"
    return LinkMotion(agreed(what, rules, space), "", space, moved)


def _rules(some: Linkage, still: bool, numbers: tuple[int, int, int]) -> PocSet | Refusal:
    """The POC set by Eqs. (1) and (2), at a general point.

    A mechanism that keeps its platform from turning may hold a limb where it has fewer elements than by itself; so both
    are tried, and that which has the numbers of the twists is taken.
    """
    chains = recognised(some) or None
    free = by_rules(chains, still=False, held=False).platform
    held = by_rules(chains, still=True, held=True).platform if still else free
    for motion in (free, held):
        if isinstance(motion, Motion) and numbers == (motion.restated.t, motion.restated.r, motion.dim):
            return motion.restated
    return free if isinstance(free, Refusal) else free.restated


def _part(whole: Linkage, names: Sequence[str], link: str, base: str) -> Linkage:
    """Some joints of a linkage as a linkage of their own, O' at a general point of a link."""
    point = whole.point + whole.length * np.array(GENERAL)
    some = part(whole, names, link, point)
    return dataclasses.replace(some, base=base or whole.base)


def _opened(some: Linkage, name: str) -> Linkage:
    """A linkage with one joint taken off the link that is looked at; its end on that side is looked at instead."""
    if name not in some.joints:
        raise UnknownNameError("joint of this part", name, some.joints)
    joint, link = some.joints[name], some.platform
    if link not in (joint.parent, joint.child):
        raise UsageError(f"the joint {name} is not on {link}, off which it was to be taken")
    end = f"{link} at {name}"
    parent, child = (end if side == link else side for side in (joint.parent, joint.child))
    moved = dataclasses.replace(joint, parent=parent, child=child)
    return dataclasses.replace(some, joints={**some.joints, name: moved}, platform=end)


def _check_connected(some: Linkage) -> None:
    for link in (some.base, some.platform):
        if link not in some.links:
            raise UnknownNameError("link of this part", link, some.links)
    if not nx.is_connected(nx.Graph([(joint.parent, joint.child) for joint in some.joints.values()])):
        raise UsageError(f"the joints {', '.join(some.joints)} do not hang together")
