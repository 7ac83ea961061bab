"""Closing blocks in their order of solution: the smallest part that closes by itself, then the next one.

A part of the joint graph closes by itself where its loops determine all its free joints: an Assur chain with the
inputs held, a limb with the platform held. Special dimensions count, since the rank is that of the screws themselves;
rods may spin about their own lines.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import combinations
from math import comb

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closing_blocks.chains import (
    FreeChain,
    FreeJoint,
    chains,
    in_loops,
    joined,
    loops,
    nodes,
    shortest,
)
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance, open_freedoms
from assur.kinematics.modes import Problem
from assur.kinematics.turns import told_by_turns
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SMALL = 1e-7
"""Share of the largest singular value below which one counts as zero: assemblies close to some 1e-9 of their size."""

SPINNING = 1e-6
"""Velocity by which a spin opens the loops, at unit rate, up to which it keeps them closed: as much, ten times over."""

LOOKED_AT = 4
"""Assemblies at which a block's rank is taken: the largest counts, as single ones may be singular."""

MOST_SETS = 4000
"""Sets of chains of one size that are tried; beyond, only all of them at once."""

PLATFORM = "platform in its pose"
"""The joint that stands for what a pose leaves free of the platform."""


@dataclass(frozen=True)
class Spin:
    """A part between two ball joints that may turn about the line through them.

    Attributes:
        first, second: the ball joints.
        senses: how each turns about the line from the first to the second.
    """

    first: str
    second: str
    senses: tuple[int, int]


@dataclass(frozen=True)
class ClosingBlock:
    """A part of the joint graph that closes by itself.

    Attributes:
        joints: its free joints, in the file's order.
        loops: joint -> +1 or -1 where a loop runs through it from parent to child or against.
        columns: its free coordinates, as columns of `ScrewColumns`.
        owners: the joint of each column.
        spins: of its rods.
    """

    joints: tuple[str, ...]
    loops: tuple[Mapping[str, int], ...] = field(hash=False)
    columns: tuple[int, ...]
    owners: tuple[str, ...]
    spins: tuple[Spin, ...] = ()

    @property
    def rank(self) -> int:
        """That of its passive derivative where it is regular."""
        return len(self.columns) - len(self.spins)

    def derivative(self, screws: ScrewColumns, links: Sequence[str]) -> FloatArray:
        """Passive derivative (N, 6 L, k) of its L loops, each seen from a link."""
        rows = []
        for loop, link in zip(self.loops, links, strict=True):
            senses = np.array([loop.get(name, 0) for name in self.owners])
            rows.append(screws.seen_from(link)[:, :, list(self.columns)] * senses)
        return np.concatenate(rows, axis=1)


@dataclass(frozen=True)
class ClosingGroup:
    """Blocks that must follow each other: nothing outside them moves when they do.

    Attributes:
        blocks: in the order of solution.
        whole: all of them as one block.
    """

    blocks: tuple[ClosingBlock, ...]
    whole: ClosingBlock


@lru_cache(maxsize=128)
def closing_groups(
    record: MechanismRecord, problem: Problem, held: tuple[str, ...] = (), whole_pose: bool = False
) -> tuple[ClosingGroup, ...]:
    """The blocks in the order of solution, grouped; what no set of loops determines is in none.

    Args:
        record: the mechanism.
        problem: "direct" holds the inputs, "inverse" the pose.
        held: links that stand still besides.
        whole_pose: whether the platform stands still where a pose leaves coordinates of it open.

    >>> from assur.model.registry import load_record
    >>> groups = closing_groups(load_record("fivebar"), "inverse")
    >>> [block.joints for group in groups for block in group.blocks]
    [('A1', 'B1', 'platform in its pose'), ('A2', 'B2', 'P')]
    """
    node = standing_links(record, problem, whole_pose)
    left = joined(_free_joints(record, problem, whole_pose), (node[link] for link in held), record.base)
    screws = _few_assemblies(record)
    answer: list[ClosingGroup] = []
    blocks: list[ClosingBlock] = []
    before = left
    while left:
        block = next((block for block in _candidates(chains(left, record.base)) if _closes(block, screws)), None)
        if block is None:
            break
        blocks.append(replace(block, spins=_spins(block, screws)))
        within = [end for joint in left if joint.name in block.joints for end in joint.ends]
        left = joined(left, within, record.base if record.base in within else within[0])
        names = {name for block in blocks for name in block.joints}
        own = [joint for joint in before if joint.name in names]
        carried = {end for joint in own for end in joint.ends} - {record.base}
        followers = {end for joint in in_loops(before) if joint.name not in names for end in joint.ends}
        if not followers & carried:
            answer += [_group(part, own) for part in _parted(blocks, own, record.base)]
            blocks, before = [], left
    return tuple(answer)


def _parted(
    blocks: Sequence[ClosingBlock], joints: Sequence[FreeJoint], base: str
) -> Iterator[tuple[ClosingBlock, ...]]:
    """Sets of blocks, in their order, none of which moves a link that joints of another set stand on."""
    sets: list[tuple[set[str], tuple[int, ...]]] = []
    for k, block in enumerate(blocks):
        reached = {end for joint in joints if joint.name in block.joints for end in joint.ends} - {base}
        touching = [own for own in sets if own[0] & reached]
        sets = [own for own in sets if not own[0] & reached]
        members = sorted(k for _, own in touching for k in own)
        sets.append((reached.union(*(ends for ends, _ in touching)), (*members, k)))
    yield from (tuple(blocks[k] for k in own) for _, own in sorted(sets, key=lambda own: own[1]))


def _group(blocks: Sequence[ClosingBlock], joints: Sequence[FreeJoint]) -> ClosingGroup:
    names = {name for block in blocks for name in block.joints}
    spins = tuple(spin for block in blocks for spin in block.spins)
    whole = _block([joint for joint in joints if joint.name in names])
    return ClosingGroup(tuple(blocks), replace(whole, spins=spins))


def loop_blocks(record: MechanismRecord) -> tuple[ClosingBlock, ...]:
    """Single loops of the joint graph, all their joints free, as blocks; not all of them close by themselves.

    >>> from assur.model.registry import load_record
    >>> [block.joints for block in loop_blocks(load_record("fivebar"))]
    [('A1', 'A2', 'B1', 'B2', 'P')]
    """
    graph = joint_graph(record)
    answer = []
    for loop in shortest([{cut.name: 1, **loop} for cut, loop in zip(graph.cut, graph.loops, strict=True)]):
        columns = [(k, item.joint) for k, item in enumerate(record.coordinates) if item.joint in loop]
        names = tuple(name for name in record.joints if name in loop)
        answer.append(ClosingBlock(names, (loop,), tuple(k for k, _ in columns), tuple(name for _, name in columns)))
    return tuple(answer)


def _free_joints(record: MechanismRecord, problem: Problem, whole_pose: bool) -> tuple[FreeJoint, ...]:
    """The joints that the inputs or the pose leave free; where it leaves some of the platform, a joint for that."""
    node, free = standing_links(record, problem, whole_pose), _free_columns(record, problem)
    answer = [
        FreeJoint(name, (node[joint.parent], node[joint.child]), free[name])
        for name, joint in record.joints.items()
        if free[name]
    ]
    count, more = len(record.coordinates), len(open_freedoms(record))
    if problem == "inverse" and more and not whole_pose:
        ends = (node[record.base], node[record.platform.link])
        answer.append(FreeJoint(PLATFORM, ends, tuple(range(count, count + more))))
    return tuple(joint for joint in answer if joint.ends[0] != joint.ends[1])


def standing_links(record: MechanismRecord, problem: Problem, whole_pose: bool) -> Mapping[str, str]:
    """Link -> the first of those that stand still against it, the base before all others, where a problem is held.

    >>> from assur.model.registry import load_record
    >>> standing_links(load_record("fivebar"), "direct", False)
    {'base': 'base', 'crank1': 'base', 'crank2': 'base', 'rod1': 'rod1', 'rod2': 'rod2'}
    """
    free = _free_columns(record, problem)
    pairs = [(joint.parent, joint.child) for name, joint in record.joints.items() if not free[name]]
    if problem == "inverse" and (whole_pose or not open_freedoms(record)):
        pairs.append((record.base, record.platform.link))
    return nodes(record, pairs)


def _free_columns(record: MechanismRecord, problem: Problem) -> dict[str, tuple[int, ...]]:
    held = {index: float(record.home[index]) for index in record.input_indices} if problem == "direct" else {}
    locked = {*held, *told_by_turns(record, held)}
    slices = joint_graph(record).slices
    return {name: tuple(k for k in range(place.start, place.stop) if k not in locked) for name, place in slices.items()}


def _candidates(pieces: Sequence[FreeChain]) -> Iterator[ClosingBlock]:
    """Connected sets of chains in which every node closes, the smaller ones first; if they are many, all at once.

    Of as many chains those of fewer freedoms are the smaller: of a slide beside a screw and its nut the slide.
    """
    numbered = [(chain, _freedoms(chain.joints)) for chain in pieces]
    for size in range(1, len(pieces) + 1):
        if comb(len(pieces), size) > MOST_SETS and size < len(pieces):
            continue
        for rows in sorted(combinations(numbered, size), key=lambda rows: sum(free for _, free in rows)):
            chosen, free = zip(*rows, strict=True)
            meeting = Counter(end for chain in chosen for end in chain.ends)
            loop_count = size - len(meeting) + 1  # where they are connected
            if min(meeting.values()) > 1 and sum(free) <= 6 * loop_count and _connected(chosen):
                yield _block([joint for chain in chosen for joint in chain.joints])


def _freedoms(joints: Sequence[FreeJoint]) -> float:
    """How many freedoms of joints loops must determine at least: half a spin at each that may be a ball is none."""
    return sum(len(joint.columns) - (len(joint.columns) > 1) / 2 for joint in joints)


def _block(joints: Sequence[FreeJoint]) -> ClosingBlock:
    listed = sorted(joints, key=lambda joint: joint.columns)
    columns = [(column, joint.name) for joint in listed for column in joint.columns]
    return ClosingBlock(
        tuple(joint.name for joint in listed),
        tuple(loops(joints)),
        tuple(column for column, _ in columns),
        tuple(name for _, name in columns),
    )


def _connected(chosen: Iterable[FreeChain]) -> bool:
    left = list(chosen)
    reached = {*left.pop().ends}
    while left:
        chain = next((chain for chain in left if reached & {*chain.ends}), None)
        if chain is None:
            return False
        left.remove(chain)
        reached |= {*chain.ends}
    return True


@lru_cache(maxsize=64)
def _few_assemblies(record: MechanismRecord) -> ScrewColumns:
    return ScrewColumns(record, assemblies_by_chance(record)[:LOOKED_AT])


# The same blocks are candidates again whichever links are held: of 3123 in a 6-RUS, 174 differ.
@lru_cache(maxsize=8192)
def _closes(block: ClosingBlock, screws: ScrewColumns) -> bool:
    """Whether the loops of a block determine its free joints, but for the spins of its rods."""
    matrices = block.derivative(screws, [screws.record.base] * len(block.loops))
    sizes = np.linalg.svd(matrices, compute_uv=False)
    lost = len(block.columns) - int(np.max(np.sum(sizes > SMALL * sizes[:, :1], axis=1)))
    return lost == len(_spins(block, screws)) if lost else True


@lru_cache(maxsize=8192)
def _spins(block: ClosingBlock, screws: ScrewColumns) -> tuple[Spin, ...]:
    """Pairs of its ball joints with a part between them that may turn about their line."""
    record = screws.record
    own = [name for name in block.joints if name != PLATFORM and record.joints[name].type.ball]
    spins: list[Spin] = []
    for first, second in combinations(own, 2):
        if {first, second} & {name for spin in spins for name in (spin.first, spin.second)}:
            continue
        through = {(loop.get(first, 0), loop.get(second, 0)) for loop in block.loops}
        for sense in (-1, 1):  # turns about the line through both cancel in every loop
            if all(one + sense * other == 0 for one, other in through):
                if _apart(first, second, screws):
                    spins.append(Spin(first, second, (1, sense)))
                break
    return tuple(spins)


def _apart(first: str, second: str, screws: ScrewColumns) -> bool:
    gaps = np.linalg.norm(screws.centre(second) - screws.centre(first), axis=1)
    return bool(np.min(gaps) > SMALL * characteristic_length(screws.record))


def spin_rates(spin: Spin, screws: ScrewColumns) -> FloatArray:
    """Rates (N, c) of a spin, one for each column of `ScrewColumns`; NaN where the balls are in one place."""
    if spin not in screws.spins:
        screws.spins[spin] = _spin_rates(spin, screws)
    return screws.spins[spin]


def _spin_rates(spin: Spin, screws: ScrewColumns) -> FloatArray:
    record = screws.record
    line = screws.centre(spin.second) - screws.centre(spin.first)
    size = np.linalg.norm(line, axis=1, keepdims=True)
    rates = np.zeros((len(line), screws.in_base.shape[2]))
    with np.errstate(invalid="ignore", divide="ignore"):
        line = np.where(size > SMALL * characteristic_length(record), line / size, np.nan)
    for name, sense in zip((spin.first, spin.second), spin.senses, strict=True):
        rates[:, joint_graph(record).slices[name]] = sense * line
    return rates
