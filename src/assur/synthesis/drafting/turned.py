"""Turned links: how the links of a drafted limb are turned at home, so that what is long in them lies along an axis.

All frames of a draft are parallel at home. Where joints allow it, a link is turned there instead, in such a way that
in its own frame the way from joint to joint is one length: a link between parallel R about their axis, a rod between
balls at will, a leg behind a U about both of its axes. A P along its leg has the leg's length as its value then.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joints.universal import UNIVERSAL
from assur.numerics.rotations import about_axis, taking
from assur.synthesis.drafting.joint_values import EXACT, across, angle_about, joint_values
from assur.synthesis.drafting.limb import BASE_LINK, PLATFORM_LINK
from assur.synthesis.drafting.linear import Point
from assur.synthesis.drafting.tables import DraftJoint, Template

FloatArray = NDArray[np.float64]
SHORT = 1.0
"""A link that is shorter, in mm, has no direction."""


@dataclass(frozen=True)
class TurnedLinks:
    """A limb at home.

    Attributes:
        points: joint -> its point on its parent link (3,), in the base frame.
        origins: link -> the origin of its frame (3,), in the base frame.
        turns: link -> its frame (3, 3) in the base frame.
        slides: P -> its axis (3,) in the frames of its links.
        values: joint -> its values, in deg and mm.
    """

    points: Mapping[str, FloatArray]
    origins: Mapping[str, FloatArray]
    turns: Mapping[str, FloatArray]
    slides: Mapping[str, FloatArray]
    values: Mapping[str, tuple[float, ...]]


def number(point: Point, sizes: Mapping[str, float]) -> FloatArray:
    """A point (3,) whose coordinates are sums of dimensions.

    >>> from assur.synthesis.drafting.linear import along
    >>> number(along("w", (0.0, 0.6, -0.8), 0.5), {"w": 60.0}).tolist()
    [0.0, 18.0, -24.0]
    """
    return np.array([sum(factor * sizes[name] for name, factor in part.terms) for part in point])


def is_shared(name: str) -> bool:
    """Whether a dimension says where a point is that limbs share."""
    return name.endswith("_d") or name.startswith("centre")


def turned_links(template: Template, sizes: Mapping[str, float], platform: FloatArray) -> TurnedLinks:
    """The links of a limb at home, turned where joints allow it; `platform` is the origin (3,) of its frame there."""
    drawn = _Drawn(template, sizes, platform)
    for turned in (True, False):
        chosen = {root: drawn.turn(root) if turned else drawn.still(root) for root in sorted(set(drawn.roots.values()))}
        made = drawn.turned(chosen)
        if made is not None:
            return made
    raise AssertionError("links that are not turned at all need no joint that allows it")


@dataclass(frozen=True)
class _Turn:
    """How links that slide on one another are turned (3, 3), and the direction (3,) in them that is their length."""

    rotation: FloatArray
    along: FloatArray | None = None


class _Drawn:
    """A limb as drawn, with all frames parallel: `roots` says which links keep one orientation."""

    def __init__(self, template: Template, sizes: Mapping[str, float], platform: FloatArray) -> None:
        self.template = template
        self.joints = template.joints
        self.origins: dict[str, FloatArray] = {BASE_LINK: np.zeros(3), PLATFORM_LINK: platform}
        self.points: dict[str, FloatArray] = {}
        self.legs: dict[str, FloatArray] = {}
        for joint in self.joints:
            self.points[joint.name] = self.origins[joint.parent] + number(joint.at, sizes)
            self.origins.setdefault(joint.child, self.points[joint.name] - number(joint.child_at, sizes))
            if joint.leg is not None:
                self.legs[joint.name] = number(joint.leg, sizes)
        self.shared = {joint.name for joint in self.joints if any(map(is_shared, _names(joint)))}
        self.roots = {link: link for link in self.origins}
        for joint in self.joints:
            if _is_slider(joint) or joint.type.screw:
                self._join(joint.parent, joint.child)
        for group in template.groups:
            if group.kind == "P(4R)":
                self._join(group.parent, group.child)

    def _join(self, first: str, second: str) -> None:
        old, new = self.roots[second], self.roots[first]
        self.roots = {link: new if root == old else root for link, root in self.roots.items()}

    def still(self, root: str) -> _Turn:
        """Links that are not turned; a P that has no direction of its own goes along its leg."""
        sliders = self._sliders(root)
        leg = self.legs.get(sliders[0].name) if len(sliders) == 1 else None
        return _Turn(np.eye(3), None if leg is None else leg / np.linalg.norm(leg))

    def turn(self, root: str) -> _Turn:
        """How the links of one orientation are turned so that the way through them lies along an axis of theirs."""
        if root in (self.roots[BASE_LINK], self.roots[PLATFORM_LINK]):
            return self.still(root)
        ends = self._ends(root)
        sliders = self._sliders(root)
        way = self._way(root)
        kept = self._kept(root)
        if way is None or len(sliders) > 1 or len(kept) > 1:
            return self.still(root)
        slider = sliders[0] if sliders else None
        axis = kept[0] if kept else None
        along = self._along(slider, way, axis)
        if along is None:
            return self.still(root)
        if axis is None:
            return _Turn(taking(along, way / np.linalg.norm(way)), along)
        near = _universal_alone(ends)
        if near is not None:
            return _Turn(_about_both(near, self.roots[near.child] == root, along, way), along)
        if np.linalg.norm(across(way, axis)) < SHORT:
            return self.still(root)
        return _Turn(about_axis(axis, np.array(angle_about(axis, along, way))), along)

    def turned(self, turns: Mapping[str, _Turn]) -> TurnedLinks | None:
        """Everything at home; None where a joint does not allow how its links are turned."""
        rotations = {link: turns[root].rotation for link, root in self.roots.items()}
        points, origins = dict(self.points), dict(self.origins)
        slides: dict[str, FloatArray] = {}
        strokes: dict[str, float] = {}
        for joint in self.joints:
            if not _is_slider(joint):
                continue
            root = self.roots[joint.parent]
            along = turns[root].along
            own = along if along is not None and len(self._sliders(root)) == 1 else np.array(joint.axes[0])
            slides[joint.name] = own
            if root == self.roots[BASE_LINK] or len(self._sliders(root)) > 1:
                continue
            entry = self._ends(root)[:1]
            last = joint.child == PLATFORM_LINK
            if not entry or (root == self.roots[PLATFORM_LINK] and not last):
                continue
            way = points[joint.name] - points[entry[0].name] if last else self._way(root)
            if way is None:
                continue
            if last:
                points[joint.name] = points[entry[0].name]
            strokes[joint.name] = float(way @ (rotations[joint.parent] @ own))
            if not last:
                origins[joint.child] = points[joint.name] + strokes[joint.name] * (rotations[joint.parent] @ own)
        self._slide_along_axes(points, origins, rotations, slides, strokes)
        values = {}
        for joint in self.joints:
            relative = rotations[joint.parent].T @ rotations[joint.child]
            own_values = joint_values(joint, relative, strokes.get(joint.name, 0.0))
            if own_values is None:
                return None
            values[joint.name] = own_values
        return TurnedLinks(points, origins, rotations, slides, values)

    def _slide_along_axes(
        self,
        points: dict[str, FloatArray],
        origins: dict[str, FloatArray],
        rotations: Mapping[str, FloatArray],
        slides: Mapping[str, FloatArray],
        strokes: Mapping[str, float],
    ) -> None:
        """Joints inside a limb, moved along their axes, where any point will do, so that links need no offset there."""
        corners = {name for group in self.template.groups for name in group.joints}
        owned: set[str] = {BASE_LINK, PLATFORM_LINK}
        for joint in self.joints:
            inside = joint.parent != BASE_LINK and joint.child not in owned
            owned.add(joint.child)
            if not inside or joint.name in corners or joint.name in self.shared:
                continue
            point = points[joint.name]
            if joint.name in slides:
                points[joint.name] = origins[joint.parent]
                stroke = strokes.get(joint.name, 0.0) * (rotations[joint.parent] @ slides[joint.name])
                origins[joint.child] = points[joint.name] + stroke
            elif joint.type.turns == 1 and len(joint.axes) == 1 and not joint.type.screw:
                axis = rotations[joint.parent] @ np.array(joint.axes[0])
                points[joint.name] = point - ((point - origins[joint.parent]) @ axis) * axis
                origins[joint.child] = points[joint.name]

    def _ends(self, root: str) -> list[DraftJoint]:
        """The joints between links of this orientation and others."""
        return [
            joint for joint in self.joints if (self.roots[joint.parent] == root) != (self.roots[joint.child] == root)
        ]

    def _sliders(self, root: str) -> list[DraftJoint]:
        return [joint for joint in self.joints if _is_slider(joint) and self.roots[joint.parent] == root]

    def _way(self, root: str) -> FloatArray | None:
        """From the first joint of links to the middle of the others; None where there is none."""
        ends = [self.points[joint.name] for joint in self._ends(root)]
        if len(ends) < 2:
            return None
        way = np.mean(ends[1:], axis=0) - ends[0]
        return np.asarray(way) if np.linalg.norm(way) > SHORT else None

    def _kept(self, root: str) -> list[FloatArray]:
        """Directions that joints hold links to: about two of them nothing can be turned."""
        kept: list[FloatArray] = []
        for joint in self._ends(root):
            places = (0,) if joint.type is not UNIVERSAL or self.roots[joint.parent] == root else (1,)
            kept += [np.array(joint.axes[place]) for place in places if joint.axes]
        for group in self.template.groups:
            if root in (self.roots[group.parent], self.roots[group.child]):
                short = self.points[group.joints[3]] - self.points[group.joints[0]]
                kept.append(short / np.linalg.norm(short))
        different: list[FloatArray] = []
        for axis in kept:
            if all(np.linalg.norm(np.cross(axis, other)) > EXACT for other in different):
                different.append(axis)
        return different

    def _along(self, slider: DraftJoint | None, way: FloatArray, axis: FloatArray | None) -> FloatArray | None:
        """The direction in links that the way through them is to have: that of a P, else x, y or z, across an axis."""
        if slider is not None and slider.name not in self.legs:
            own = np.array(slider.axes[0])
            return own if axis is None or abs(own @ axis) < EXACT else None
        units = [unit for unit in np.eye(3) if axis is None or abs(unit @ axis) < EXACT]
        rest = way if axis is None else across(way, axis)
        nearest = max(units, key=lambda unit: abs(float(unit @ rest)) + EXACT * unit[2], default=None)
        return None if nearest is None else nearest * math.copysign(1.0, float(nearest @ rest))


def _names(joint: DraftJoint) -> list[str]:
    return [name for point in (joint.at, joint.child_at) for part in point for name, _ in part.terms]


def _is_slider(joint: DraftJoint) -> bool:
    """Whether a joint is a P."""
    return not joint.type.turning


def _universal_alone(ends: Sequence[DraftJoint]) -> DraftJoint | None:
    """The first U of a leg between a U and a ball, or between two U of which one undoes what the other does."""
    pairs = [joint for joint in ends if joint.type is UNIVERSAL]
    balls = [joint for joint in ends if joint.type.ball]
    if len(ends) != 2 or not pairs or len(pairs) + len(balls) != 2:
        return None
    return pairs[0] if balls or _reversed(*pairs) else None


def _reversed(first: DraftJoint, second: DraftJoint) -> bool:
    """Whether two U have the same axes, the second in the other order: then one undoes what the other does."""
    pairs = zip(first.axes, second.axes[::-1], strict=True)
    return all(np.linalg.norm(np.cross(one, other)) < EXACT for other, one in pairs)


def _about_both(near: DraftJoint, behind: bool, along: FloatArray, way: FloatArray) -> FloatArray:
    """The rotation (3, 3) about both axes of a U that takes a direction onto that of a way, of two the smaller one."""
    outer, inner = (np.array(axis) for axis in (near.axes if behind else near.axes[::-1]))
    start = np.array(angle_about(outer, np.cross(inner, outer), way))
    turned = [about_axis(outer, start + half) for half in (0.0, np.pi)]
    both = [turn @ about_axis(inner, np.array(angle_about(inner, along, turn.T @ way))) for turn in turned]
    return max(both, key=lambda rotation: float(np.trace(rotation)))
