"""The joint graph: links are nodes, joints are edges; a spanning tree and the joints that close its loops."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

from assur.model.mechanism import Joint, MechanismRecord


@dataclass(frozen=True, eq=False)
class JointGraph:
    """A spanning tree of the joint graph and its independent loops.

    Attributes:
        base, platform: the link that stands still, and the one that is moved.
        joints: all of them, in the order of the vector of joint values.
        tree: (joint, forward) in an order in which each joint's near link is already placed;
            forward means from parent to child.
        cut: the joints that close a loop each, v = m - n + 1 of them.
        loops: per cut joint, the tree joints of its loop with +1 where the loop runs from parent to
            child on the parent's side of the cut, -1 where it runs so on the child's side.
        slices: joint -> its place in the vector of joint values.
        paths: link -> the tree joints from the base to it, +1 where run from parent to child.
    """

    base: str
    platform: str
    joints: tuple[Joint, ...]
    tree: tuple[tuple[Joint, bool], ...]
    cut: tuple[Joint, ...]
    loops: tuple[Mapping[str, int], ...]
    slices: Mapping[str, slice]
    paths: Mapping[str, Mapping[str, int]]

    def joint(self, name: str) -> Joint:
        """The joint of that name."""
        return self._named[name]

    @cached_property
    def turns(self) -> tuple[slice, ...]:
        """Where rotation vectors of ball joints stand in the vector of joint values."""
        first = {joint.name: self.slices[joint.name].start for joint in self.joints}
        return tuple(
            slice(first[joint.name] + place, first[joint.name] + place + 3)
            for joint in self.joints
            for step, place in joint.type.places
            if step.kind == "ball"
        )

    @cached_property
    def _named(self) -> dict[str, Joint]:
        return {joint.name: joint for joint in self.joints}


@lru_cache(maxsize=64)
def joint_graph(record: MechanismRecord) -> JointGraph:
    """Breadth-first spanning tree from the base, joints in the file's order."""
    placed, tree, used = [record.base], [], set()
    for link in placed:
        for name, joint in record.joints.items():
            if link not in (joint.parent, joint.child) or name in used:
                continue
            other = joint.child if joint.parent == link else joint.parent
            if other not in placed:
                placed.append(other)
                used.add(name)
                tree.append((joint, joint.parent == link))
    cut = tuple(joint for name, joint in record.joints.items() if name not in used)
    paths = _paths(record.base, tree)
    loops = tuple(_difference(paths[joint.parent], paths[joint.child]) for joint in cut)
    slices, start = {}, 0
    for name, joint in record.joints.items():
        slices[name] = slice(start, start + joint.type.freedoms)
        start += joint.type.freedoms
    ends = record.base, record.platform.link
    return JointGraph(*ends, tuple(record.joints.values()), tuple(tree), cut, loops, slices, paths)


def _paths(base: str, tree: list[tuple[Joint, bool]]) -> dict[str, dict[str, int]]:
    """Tree joints from the base to each link, +1 where run from parent to child."""
    paths: dict[str, dict[str, int]] = {base: {}}
    for joint, forward in tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        paths[far] = {**paths[near], joint.name: 1 if forward else -1}
    return paths


def _difference(first: Mapping[str, int], second: Mapping[str, int]) -> dict[str, int]:
    names = [name for name in (*first, *second) if not (name in first and name in second)]
    return {name: first.get(name, 0) - second.get(name, 0) for name in names}
