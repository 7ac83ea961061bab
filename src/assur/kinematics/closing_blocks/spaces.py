"""Spaces that the screws of loops span over many assemblies, and the loops and links for which they are smallest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closing_blocks.blocks import ClosingBlock
from assur.kinematics.closing_blocks.columns import ScrewColumns

FloatArray = NDArray[np.float64]
SAME_SPACE = 1e-4
"""Share of the largest singular value by which bases of one space fill no further direction."""

WHOLE = 6
"""Dimension of the space of all screws."""

MOST_LOOPS = 3
"""Loops of a block up to which others than its own are looked at."""


def in_narrow_loops(block: ClosingBlock, screws: ScrewColumns) -> ClosingBlock:
    """The block with loops whose screws span as little as they can: two limbs that stay in a plane in one loop.

    A loop may be the sum of two of the block's, or their difference.

    >>> from assur.kinematics.closing_blocks.blocks import loop_blocks
    >>> from assur.kinematics.closing_blocks.columns import assemblies_by_chance
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> (block,) = loop_blocks(record)
    >>> in_narrow_loops(block, ScrewColumns(record, assemblies_by_chance(record))) is block
    True
    """
    if not 1 < len(block.loops) <= MOST_LOOPS:
        return block
    every = [*block.loops]
    for (first, second), sense in product(combinations(block.loops, 2), (1, -1)):
        joined = {name: first.get(name, 0) + sense * second.get(name, 0) for name in (*first, *second)}
        if all(abs(own) < 2 for own in joined.values()):
            every.append({name: own for name, own in joined.items() if own})
    whole = replace(block, loops=tuple(every))
    widths = [min(_widths(whole, number, screws).values()) for number in range(len(every))]
    names = [*dict.fromkeys(block.owners)]
    chosen: list[Mapping[str, int]] = []
    for number in sorted(range(len(every)), key=lambda number: widths[number]):
        rows = [[loop.get(name, 0) for name in names] for loop in (*chosen, every[number])]
        if np.linalg.matrix_rank(rows) == len(rows):
            chosen.append(every[number])
    return replace(block, loops=tuple(chosen))


def _widths(block: ClosingBlock, number: int, screws: ScrewColumns) -> Mapping[str, int]:
    """Dimension of the space that the screws of a loop span, seen from each link of it; the base before others."""
    record, loop = screws.record, block.loops[number]
    own = tuple(k for k, owner in zip(block.columns, block.owners, strict=True) if owner in loop)
    question = tuple(loop), own
    if question not in screws.widths:
        joints = [record.joints[name] for name in loop if name in record.joints]
        links = dict.fromkeys([record.base, *(link for joint in joints for link in (joint.parent, joint.child))])
        few = _widths(block, number, screws.few) if screws.few is not screws else dict.fromkeys(links, 0)
        screws.widths[question] = {  # what fills all directions in a few assemblies does in all
            link: WHOLE if few[link] == WHOLE else span(screws.seen_from(link)[:, :, [*own]]).shape[1] for link in links
        }
    return screws.widths[question]


def steadiest_link(block: ClosingBlock, number: int, screws: ScrewColumns) -> str:
    """The link from which the screws of a loop span the smallest space over all assemblies; the base before others.

    >>> from assur.kinematics.closing_blocks.blocks import loop_blocks
    >>> from assur.kinematics.closing_blocks.columns import assemblies_by_chance
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> (block,) = loop_blocks(record)
    >>> steadiest_link(block, 0, ScrewColumns(record, assemblies_by_chance(record)))
    'base'
    """
    widths = _widths(block, number, screws)
    return min(widths, key=lambda link: widths[link])


def span(matrices: FloatArray) -> FloatArray:
    """Orthonormal basis (k, r) of what all columns of matrices (N, k, c) span together.

    >>> span(np.array([[[1.0], [0.0], [0.0]], [[0.0], [2.0], [0.0]]])).shape
    (3, 2)
    """
    columns = np.moveaxis(matrices, 1, 0).reshape(matrices.shape[1], -1)
    weights, basis = np.linalg.eigh(columns @ columns.T)
    return np.asarray(basis[:, weights > SAME_SPACE**2 * np.max(weights, initial=0.0)])
