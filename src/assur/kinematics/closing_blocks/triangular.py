"""Factors of a block's determinant in triangular form: rates that open the loops in as many directions as they are.

A block need not close piece by piece for its determinant to be a product. Of two parallelograms in a row the second
may move the platform along one line whatever its angle; then the first alone decides about what is left across it.
Where that line turns with an input, it stands still seen from the link that the input moves: so what is left is seen
from all links that stand still where a problem is held.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closing_blocks.blocks import PLATFORM, SMALL, standing_links
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.signs import BlockSign, size_of
from assur.kinematics.closing_blocks.spaces import span
from assur.kinematics.modes import Problem

FloatArray = NDArray[np.float64]
MOST_RATES = 9
"""Rates of a block up to which sets of them are tried."""
MOST_ROWS = 3
"""Rates up to which sets of as many rows are tried."""


def triangular_factors(known: Sequence[object], screws: ScrewColumns, problem: Problem) -> list[BlockSign]:
    """Further factors of the determinants of blocks; each has other signs, at assemblies, than all that are known."""
    record, blocks = screws.record, [sign for sign in known if isinstance(sign, BlockSign)]
    standing = [link for link, own in standing_links(record, problem, False).items() if own == record.base != link]
    met = {_senses(sign, screws) for sign in blocks}
    factors = []
    for sign in blocks:
        if sign.block.spins or not 1 < sign.rates.shape[1] <= MOST_RATES:
            continue
        parts = [factor for seen in _seen(sign, screws) for factor in _factors(seen, screws)]
        turned = (own for part in parts for link in standing for own in _seen_from(link, part, screws))
        for factor in (*parts, *(factor for own in turned for factor in _factors(own, screws))):
            if (senses := _senses(factor, screws)) not in met:
                met.add(senses)
                factors.append(factor)
    return factors


def _seen_from(link: str, sign: BlockSign, screws: ScrewColumns) -> Iterator[BlockSign]:
    """The same determinant, but for its size, of as many rows in the frame of one link; none of one rate."""
    count, links = sign.rates.shape[1], (link,) * len(sign.links)
    if not 1 < count <= MOST_ROWS:
        return
    rows = sign.block.derivative(screws, links) @ sign.rates
    kept = [k for k in range(rows.shape[1]) if np.max(np.abs(rows[:, k])) > SMALL]
    alike = np.all(np.isclose(rows[:, kept, None], rows[:, None, kept]), axis=(0, 3))
    sets = [*combinations([k for n, k in enumerate(kept) if not np.any(alike[n, :n])], count)]
    if not sets:
        return
    values = sign.shares(screws) * sign.size
    own = np.linalg.det(rows[:, sets])
    ratios = values @ own / (values @ values)
    scale = np.max(np.abs(own), axis=0)
    same = np.all(np.abs(own - np.outer(values, ratios)) <= SMALL * (scale + np.abs(np.outer(values, ratios))), axis=0)
    for k in np.flatnonzero(same & (np.abs(ratios) > SMALL)):
        yield replace(sign, links=links, basis=np.eye(rows.shape[1])[:, sets[k]])


def _seen(sign: BlockSign, screws: ScrewColumns) -> list[BlockSign]:
    """The sign with its loop seen from where it is, and one through a pose from any other link, too.

    A point of the platform that a pose holds is a ball in the platform's own frame alone.
    """
    if PLATFORM not in sign.joints or sign.basis.shape != (6, 6):
        return [sign]
    joints = [screws.record.joints[name] for name in sign.joints if name in screws.record.joints]
    links = dict.fromkeys([*sign.links, *(link for joint in joints for link in (joint.parent, joint.child))])
    return [replace(sign, links=(link,), basis=np.eye(6)) for link in links]


def _factors(sign: BlockSign, screws: ScrewColumns) -> Iterator[BlockSign]:
    """The factors of a determinant, if it has any: blocks on the diagonal, each modulo what those before it span."""
    rates = _sparse(sign.rates)
    matrices = sign.basis.T @ sign.block.derivative(screws, sign.links) @ rates
    basis, left = sign.basis, [*range(rates.shape[1])]
    while chosen := _narrow(matrices, left):
        own = span(matrices[:, :, chosen])
        yield _with_home(_at_rates(replace(sign, basis=basis @ own), rates[:, chosen]), screws)
        across = np.linalg.svd(own)[0][:, len(chosen) :]
        matrices, basis = across.T @ matrices, basis @ across
        left = [k for k in left if k not in chosen]


def _narrow(matrices: FloatArray, left: Sequence[int]) -> list[int]:
    """The fewest of the columns that are left whose span, over all assemblies, has as many dimensions."""
    for size in range(1, len(left) + 1):
        for chosen in combinations(left, size):
            if span(matrices[:, :, chosen]).shape[1] == size:
                return [*chosen]
    return []


def _sparse(rates: FloatArray) -> FloatArray:
    """A basis (k, d) of the span of rates with as many zeros as elimination makes: of joints that move by themselves.

    >>> _sparse(np.array([[1.0, 1.0], [1.0, 1.0], [0.0, 2.0]])).T.tolist()
    [[1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    rows, pivots = rates.T.copy(), 0
    for column in range(rows.shape[1]):
        best = pivots + int(np.argmax(np.abs(rows[pivots:, column])))
        if abs(rows[best, column]) <= SMALL:
            continue
        rows[[pivots, best]] = rows[[best, pivots]]
        rows[pivots] /= rows[pivots, column]
        others = np.arange(len(rows)) != pivots
        rows[others] -= rows[others, column, None] * rows[pivots]
        pivots += 1
        if pivots == len(rows):
            break
    return np.where(np.abs(rows) > SMALL, rows, 0.0).T


def _at_rates(sign: BlockSign, rates: FloatArray) -> BlockSign:
    """The sign at some rates, of the joints alone that move at these; a pose stands for what it leaves of its block."""
    if PLATFORM in sign.joints:
        return replace(sign, rates=rates)
    block, moving = sign.block, np.flatnonzero(np.any(rates != 0.0, axis=1))
    owners = tuple(block.owners[k] for k in moving)
    own = replace(
        block, joints=tuple(name for name in block.joints if name in owners),
        columns=tuple(block.columns[k] for k in moving), owners=owners,
    )  # fmt: skip
    return replace(sign, block=own, rates=rates[moving])


def _with_home(sign: BlockSign, screws: ScrewColumns) -> BlockSign:
    """With its size, so that home reads +."""
    return replace(sign, size=size_of(np.linalg.det(sign.matrices(screws))))


def _senses(sign: BlockSign, screws: ScrewColumns) -> bytes:
    return sign.signs(screws).tobytes()
