"""Signs of closing blocks: on which side of its own singularities a block stands.

The passive derivative A of a block has full column rank wherever the block is regular. Where its columns span one
space everywhere, each loop seen from a link of its own, det(U^T A) with a basis U of that space is a function of the
configuration that vanishes at singularities alone: its sign is kept along every regular path. Planar, spherical and
translational blocks are of that kind, and those whose loops are independent in all six directions.

What closes by itself where further links are held gives signs too: a motion of it alone is one of the whole mechanism.
So the signs of smaller parts split that of a larger one into factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations, product
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closing_blocks.blocks import (
    LOOKED_AT,
    SMALL,
    SPINNING,
    ClosingBlock,
    ClosingGroup,
    closing_groups,
    loop_blocks,
    spin_rates,
    standing_links,
)
from assur.kinematics.closing_blocks.columns import FEW, ScrewColumns, assemblies_by_chance, open_freedoms
from assur.kinematics.closing_blocks.platform_signs import PlatformSign
from assur.kinematics.closing_blocks.spaces import in_narrow_loops, span, steadiest_link
from assur.kinematics.closing_blocks.strokes import MERGED, StrokeSign, stroke_signs, with_zero
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SignArray = NDArray[np.int8]
PAIRS = 14
"""Links up to which two of them are held at once, in search of factors."""

MOST_RATES = 9
"""Motions of a group up to which single joints of it are left at rest, in search of factors: each takes some 10 ms."""


class ChangingSign(Protocol):
    """What is zero at singularities alone."""

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where it vanishes."""
        ...

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """Values (N,)."""
        ...


@dataclass(frozen=True, eq=False)
class BlockSign:
    """The sign of a closing block.

    Attributes:
        block: the block.
        links: from which each of its loops is seen.
        rates: (k, d) basis of the rates that count: all, those in motions of the mechanism, or those in none of them.
        basis: (6 L, r) of the space that its screws span there at such rates.
        size: of its largest determinant among assemblies by chance, negative where home would read minus.
        moving: whether it is a loop that moves by itself, as a parallelogram.
    """

    block: ClosingBlock
    links: tuple[str, ...]
    rates: FloatArray
    basis: FloatArray
    size: float
    moving: bool = False

    @property
    def joints(self) -> tuple[str, ...]:
        """Those of the block."""
        return self.block.joints

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """The block's determinant (N,) as a share of its largest among assemblies by chance; positive at home."""
        if self not in screws.shares:
            screws.shares[self] = np.asarray(np.linalg.det(self.matrices(screws)) / self.size)
        return screws.shares[self]

    def matrices(self, screws: ScrewColumns) -> FloatArray:
        """The block's square matrices (N, d, d): its derivative in its own space, bordered by spins."""
        own = self.basis.T @ self.block.derivative(screws, self.links)
        spins = [spin_rates(spin, screws)[:, None, list(self.block.columns)] for spin in self.block.spins]
        return np.concatenate([own, *spins], axis=1) @ self.rates

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where the block is singular."""
        return with_zero(self.shares(screws))


Factor = BlockSign | StrokeSign | PlatformSign
"""A function of the configuration whose sign only changes at singularities."""


def factor_signs(known: Sequence[ChangingSign], screws: ScrewColumns) -> SignArray:
    """Signs (N, s) of factors; 0 where one vanishes."""
    signs = [factor.signs(screws) for factor in known]
    return np.array(signs, dtype=np.int8).reshape(len(known), len(screws.values)).T


@lru_cache(maxsize=64)
def factors(record: MechanismRecord, problem: Problem) -> tuple[Factor, ...]:
    """All signs that change at singularities of a problem alone, those of fewer joints first; home reads + in each.

    >>> from assur.model.registry import load_record
    >>> ('A2', 'B2', 'P') in [factor.joints for factor in factors(load_record("fivebar"), "inverse")]
    True
    """
    screws = screws_apart(record)
    signs = dict.fromkeys([*_of_no_problem(record), *_block_signs(record, problem, screws)])
    return tuple(sorted(signs, key=lambda sign: len(sign.joints)))


@lru_cache(maxsize=8)
def _of_no_problem(record: MechanismRecord) -> tuple[Factor, ...]:
    """Signs that hold whichever problem is asked: those of strokes, and of loops that move by themselves."""
    screws = screws_apart(record)
    return (*stroke_signs(screws), *_loop_signs(screws))


@lru_cache(maxsize=8)
def screws_apart(record: MechanismRecord) -> ScrewColumns:
    """Assemblies by chance, home first, without those in which balls meet that are apart at home.

    A rod between them would have no line.
    """
    screws = ScrewColumns(record, assemblies_by_chance(record))
    balls = [screws.centre(name) for name, joint in screws.record.joints.items() if joint.type.ball]
    gaps = [np.linalg.norm(second - first, axis=1) for first, second in combinations(balls, 2)]
    near = [gap <= SMALL * characteristic_length(screws.record) for gap in gaps]
    meeting = np.any([held & ~held[0] for held in near], axis=0) if near else np.zeros(len(screws.values), dtype=bool)
    return ScrewColumns(screws.record, screws.values[~meeting])


def _loop_signs(screws: ScrewColumns) -> Iterator[BlockSign]:
    """Signs of single loops that move in one way at all configurations, as parallelograms: where one is flat it is 0.

    What they do besides in no motion has a determinant, that vanishes where the loop loses rank. Then so does the whole
    closure, if the loop's equations do not depend on those of the others: of an overconstrained mechanism they may.
    """
    blocks = loop_blocks(screws.record)
    for number, block in enumerate(blocks):
        if not _independent(blocks, number, screws):
            continue
        own = span(screws.motions[:, list(block.columns)])
        matrices = block.derivative(screws, [screws.record.base] * len(block.loops))
        if np.max(np.abs(matrices @ own)) > SPINNING:  # what is a motion here is none there
            continue
        across = np.linalg.svd(own)[0][:, own.shape[1] :]
        sign = _sign(block, screws, across)
        if sign is not None:
            yield replace(sign, moving=True)


def _independent(blocks: Sequence[ClosingBlock], number: int, screws: ScrewColumns) -> bool:
    """Whether the equations of a loop are independent of those of all others, at some assembly."""
    count = len(screws.record.coordinates)
    senses = [[block.loops[0].get(item.joint, 0) for item in screws.record.coordinates] for block in blocks]
    rows = [screws.in_base[:LOOKED_AT, :, :count] * own for own in senses]
    ranks = [
        np.max(np.linalg.matrix_rank(np.concatenate(part, axis=1), tol=SMALL)) if part else 0
        for part in (rows, rows[:number] + rows[number + 1 :], rows[number : number + 1])
    ]
    return bool(ranks[0] == ranks[1] + ranks[2])


def _block_signs(record: MechanismRecord, problem: Problem, screws: ScrewColumns) -> Iterator[BlockSign]:
    """Signs of the problem's blocks, then of those with the platform held in its whole pose, or any link, or any two.

    Where all screws of a group span one space, its determinant is the product of those of its blocks. Elsewhere that
    of the group at rates of motions has a sign, and the last block, which moves by itself.
    """
    links = [link for link in record.links if link != record.base]
    sizes = (0, 1, 2) if len(links) <= PAIRS else (0, 1)
    held = [chosen for size in sizes for chosen in combinations(links, size)]
    poses = (False, True) if problem == "inverse" and open_freedoms(record) else (False,)
    standing = {whole_pose: standing_links(record, problem, whole_pose) for whole_pose in poses}
    asked, met = set(), set()
    for links_held, whole_pose in product(held, poses):
        question = frozenset(standing[whole_pose][link] for link in links_held) - {record.base}, whole_pose
        if question in asked:
            continue
        asked.add(question)
        for group in closing_groups(record, problem, links_held, whole_pose):
            if group.whole.columns not in met:
                met.add(group.whole.columns)
                yield from _of_group(group, screws, record.input_indices if problem == "direct" else ())


def _of_group(group: ClosingGroup, screws: ScrewColumns, inputs: Sequence[int]) -> Iterator[BlockSign]:
    whole = _sign(group.whole, screws) or _sign(in_narrow_loops(group.whole, screws.few), screws)
    blocks = group.blocks if whole is not None else group.blocks[-1:]
    signs = [*_along_motions(group.whole, screws, inputs, parts=whole is None), whole]
    signs += [_sign(block, screws) for block in blocks]
    signs.append(_along_slides(group.whole, screws))
    yield from (sign for sign in signs if sign is not None)


def _along_motions(
    block: ClosingBlock, screws: ScrewColumns, inputs: Sequence[int], *, parts: bool
) -> Iterator[BlockSign | None]:
    """A block's sign at rates of motions where these are fewer, and with `parts` at those that leave a joint at rest.

    Where screws depend on each other at some rates, they do at all: so these are singular there, too. Rods that stay
    parallel leave a platform its translations; whether it could turn as well is another factor of the whole. Rates of
    motions in which one of the inputs rests tell a limb's own flip.
    """
    rates = _motion_rates(block, screws)
    if not parts and rates.shape[1] + len(block.spins) >= len(block.columns):
        return
    along = _sign(block, screws, rates)
    yield along
    if parts and 1 < rates.shape[1] <= MOST_RATES:
        own = replace(block, spins=along.block.spins if along else ())
        for row in _directions(rates[~_spinning(block, screws)]):
            yield _sign(own, screws, rates @ np.linalg.svd(row[None])[2][1:].T)
        for index in inputs:
            still = _motion_rates(block, screws, index)
            if 0 < still.shape[1] < rates.shape[1]:
                yield _sign(own, screws, still)


def _spinning(block: ClosingBlock, screws: ScrewColumns) -> NDArray[np.bool_]:
    """Columns (k,) of a block that turn as a rod spins.

    Rates at which one of them rests have that spin among them where it is across the column, which is no singularity.
    """
    spins = [spin_rates(spin, screws)[:, list(block.columns)] for spin in block.spins]
    return np.any(spins, axis=(0, 1)) if spins else np.zeros(len(block.columns), dtype=bool)


def _along_slides(block: ClosingBlock, screws: ScrewColumns) -> BlockSign | None:
    """A block's sign at rates of slides alone: of three cylindrical joints the whole determinant is a square of it."""
    coordinates = screws.record.coordinates
    sliding = [
        k
        for k, column in enumerate(block.columns)
        if column < len(coordinates) and coordinates[column].kind == "length"
    ]
    return (
        _sign(block, screws, np.eye(len(block.columns))[:, sliding]) if 1 < len(sliding) < len(block.columns) else None
    )


def _directions(rows: FloatArray) -> list[FloatArray]:
    """One of each direction, whatever its sense, among rows (k, d) that are not zero."""
    kept: list[FloatArray] = []
    for row in rows:
        size = float(np.linalg.norm(row))
        if size > SMALL and all(abs(row @ other) < (1.0 - SMALL) * size for other in kept):
            kept.append(row / size)
    return kept


def _sign(block: ClosingBlock, screws: ScrewColumns, rates: FloatArray | None = None) -> BlockSign | None:
    """A block's sign, at rates of any kind or in the span (k, d) of some; None where its screws span no one space.

    Parts that close with one link held often do with another one, and in the other problem: each is looked at once.
    """
    rates = np.eye(len(block.columns)) if rates is None else rates
    question = block, rates.shape, rates.tobytes()
    if question not in screws.signs:
        screws.signs[question] = _sign_at(block, screws, rates)
    sign: BlockSign | None = screws.signs[question]
    return sign


def _sign_at(block: ClosingBlock, screws: ScrewColumns, rates: FloatArray) -> BlockSign | None:
    if not rates.shape[1] or (screws.few is not screws and _sign(block, screws.few, rates) is None):
        return None  # what does not span one space in a few assemblies does not in all
    links = tuple(steadiest_link(block, number, screws) for number in range(len(block.loops)))
    matrices = block.derivative(screws, links) @ rates
    left, sizes, _ = np.linalg.svd(matrices, full_matrices=False)
    ranks = np.sum(sizes > SMALL * sizes[:, :1], axis=1)
    rank = int(np.max(ranks))
    basis = span(left[ranks == rank][:, :, :rank])
    spinning = rates.shape[1] - rank
    if basis.shape[1] != rank or spinning > len(block.spins):
        return None
    for spins in combinations(block.spins, spinning):
        trial = BlockSign(replace(block, spins=spins), links, rates, basis, 1.0)
        matrices = trial.matrices(screws)
        if any(  # in a few of them mostly: the others are seldom asked
            np.max(np.linalg.matrix_rank(own, tol=SMALL), initial=0) == rates.shape[1]
            for own in (matrices[:FEW], matrices[FEW:])
        ):
            values = np.linalg.det(matrices)
            sign = replace(trial, size=size_of(values))
            screws.shares[sign] = values / sign.size
            return sign
    return None


def size_of(values: FloatArray) -> float:
    """The largest of determinants (N,), home's first; negative where home would read minus.

    Where home is singular the first assembly that is not decides, since a basis has no sense of its own.

    >>> size_of(np.array([-1.0, 2.0])), size_of(np.array([0.0, 2.0]))
    (-2.0, 2.0)
    """
    size = float(np.max(np.abs(values)))
    first = values[np.argmax(np.abs(values) > MERGED * size)]
    return -size if first < 0.0 else size


def _motion_rates(block: ClosingBlock, screws: ScrewColumns, still: int | None = None) -> FloatArray:
    """Basis (k, d) of the rates of a block's columns in all motions of the mechanism, single rods not spinning.

    With `still` in those in which that column rests.

    Rods of a parallelogram spin together: without that its motions may span less than its rods' turns, by an accident
    of the others, and a border of two spins of three would vanish where the third is across it.
    """
    motions = screws.motions if still is None else _resting(screws.motions, still)
    motions = motions[:, list(block.columns)]
    if not block.spins:
        return span(motions)
    spins = np.stack([spin_rates(spin, screws)[:, list(block.columns)] for spin in block.spins], axis=-1)
    motions = motions - spins @ (np.linalg.pinv(spins) @ motions)
    size = float(np.max(np.linalg.norm(motions, axis=1), initial=0.0))
    groups = [{*group.joints} for group in screws.record.generalised.values()]
    pairs = [[k for k, spin in enumerate(block.spins) if {spin.first, spin.second} <= group] for group in groups]
    together = [size * np.sum(spins[:, :, pair], axis=2, keepdims=True) for pair in pairs if len(pair) > 1]
    return span(np.concatenate([motions, *together], axis=2))


def _resting(motions: FloatArray, column: int) -> FloatArray:
    """Of motions (N, c, F) those (N, c, F - 1) in which a column rests."""
    return np.asarray(motions @ np.swapaxes(np.linalg.svd(motions[:, column, None])[2][:, 1:], -1, -2))
