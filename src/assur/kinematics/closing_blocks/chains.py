"""Chains of the joint graph where joints are held: links that stand still against each other are one node.

With the inputs held, or the platform, what is left of the joint graph is a smaller graph. Its nodes are sets of links
that no free joint parts; between nodes where three or more joints meet, the free joints form chains.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from assur.model.mechanism import MechanismRecord


@dataclass(frozen=True)
class FreeJoint:
    """A joint with what is free of it.

    Attributes:
        name: of the joint.
        ends: the nodes of its parent and its child.
        columns: its free coordinates, as places among the columns of `screw_columns`.
    """

    name: str
    ends: tuple[str, str]
    columns: tuple[int, ...]


@dataclass(frozen=True)
class FreeChain:
    """Free joints in series between two nodes, which may be the same one.

    Attributes:
        ends: the nodes.
        joints: in the order from the first end to the second.
    """

    ends: tuple[str, str]
    joints: tuple[FreeJoint, ...]


def joined(joints: Iterable[FreeJoint], nodes: Iterable[str], into: str) -> tuple[FreeJoint, ...]:
    """The joints where some nodes have become one; those within it are gone.

    >>> first, second = FreeJoint("A", ("base", "crank"), (0,)), FreeJoint("B", ("crank", "rod"), (1,))
    >>> joined([first, second], ["crank"], "base")
    (FreeJoint(name='B', ends=('base', 'rod'), columns=(1,)),)
    """
    inside = {*nodes, into}
    renamed = (
        FreeJoint(joint.name, (_end(joint.ends[0], inside, into), _end(joint.ends[1], inside, into)), joint.columns)
        for joint in joints
    )
    return tuple(joint for joint in renamed if joint.ends != (into, into))


def _end(node: str, inside: set[str], into: str) -> str:
    return into if node in inside else node


def nodes(record: MechanismRecord, pairs: Iterable[tuple[str, str]]) -> Mapping[str, str]:
    """Link -> the node that it is part of where pairs of links stand still against each other.

    A node bears the name of its first link, the base before all others.
    """
    order = [record.base, *(name for name in record.links if name != record.base)]
    node = {name: name for name in order}
    for pair in pairs:
        first, second = sorted((node[link] for link in pair), key=order.index)
        node = {name: first if own == second else own for name, own in node.items()}
    return node


def chains(joints: Sequence[FreeJoint], base: str) -> tuple[FreeChain, ...]:
    """The chains between nodes at which three or more free joints meet, and the base.

    Joints on branches that close no loop are left out.
    """
    kept = in_loops(joints)
    meeting = _meeting(kept)
    stops = {node for node, own in meeting.items() if len(own) != 2} | ({base} & meeting.keys())
    answer: list[FreeChain] = []
    used: set[str] = set()
    while len(used) < len(kept):
        left = [joint for joint in kept if joint.name not in used]
        # a ring that touches none of these nodes begins at any of its own
        begin = next((joint for joint in left if stops & {*joint.ends}), left[0])
        start = next((end for end in begin.ends if end in stops), begin.ends[0])
        run, node = [begin], _other(begin, start)
        while node not in stops and node != start:
            run.append(next(joint for joint in meeting[node] if joint.name not in {own.name for own in run}))
            node = _other(run[-1], node)
        used |= {joint.name for joint in run}
        answer.append(FreeChain((start, node), tuple(run)))
    return tuple(answer)


def loops(joints: Sequence[FreeJoint]) -> Iterator[Mapping[str, int]]:
    """Independent loops: joint -> +1 where it is run through from parent to child, -1 against.

    One for each joint that a spanning tree leaves out, with the way back along the tree, which grows breadth first, so
    that loops are short.
    """
    paths: dict[str, dict[str, int]] = {joints[0].ends[0]: {}}
    waiting, left = [joints[0].ends[0]], list(joints)
    for node in waiting:
        for joint in [joint for joint in left if node in joint.ends]:
            far = _other(joint, node)
            if far not in paths:
                left.remove(joint)
                paths[far] = {**paths[node], joint.name: 1 if joint.ends[0] == node else -1}
                waiting.append(far)
    for joint in left:
        first, second = (paths[end] for end in joint.ends)
        back = {name: first.get(name, 0) - second.get(name, 0) for name in first | second}
        yield {joint.name: 1, **{name: sense for name, sense in back.items() if sense}}


def shortest(loops_of: Sequence[Mapping[str, int]]) -> list[Mapping[str, int]]:
    """Independent loops as others, of fewer joints: sums and differences of two of them, as long as one is shorter.

    >>> shortest([{"A": 1, "B": 1, "C": 1}, {"B": 1, "C": 1, "D": -1, "E": 1}])
    [{'A': 1, 'B': 1, 'C': 1}, {'D': -1, 'E': 1, 'A': -1}]
    """
    answer = [*loops_of]
    while True:
        for (k, own), (other, sense) in product(enumerate(answer), product(answer, (1, -1))):
            joined_loop = {name: own.get(name, 0) + sense * other.get(name, 0) for name in (*own, *other)}
            shorter = {name: value for name, value in joined_loop.items() if value}
            if other is not own and len(shorter) < len(own) and all(abs(value) == 1 for value in shorter.values()):
                answer[k] = shorter
                break
        else:
            return answer


def _other(joint: FreeJoint, node: str) -> str:
    return joint.ends[1] if joint.ends[0] == node else joint.ends[0]


def _meeting(joints: Iterable[FreeJoint]) -> dict[str, list[FreeJoint]]:
    """Node -> the joints that meet there; one with both ends there is listed twice."""
    meeting: dict[str, list[FreeJoint]] = {}
    for joint in joints:
        for end in joint.ends:
            meeting.setdefault(end, []).append(joint)
    return meeting


def in_loops(joints: Sequence[FreeJoint]) -> list[FreeJoint]:
    """The joints that are left when those that end freely are taken away, again and again."""
    kept = list(joints)
    while True:
        loose = {node for node, own in _meeting(kept).items() if len(own) == 1}
        if not loose:
            return kept
        kept = [joint for joint in kept if not loose & {*joint.ends}]
