"""Random walks over the assemblies of a mechanism, and how far from a singularity a function changes its sign there."""

from __future__ import annotations

import numpy as np

from assur.kinematics.closing_blocks.columns import assemblies_by_chance
from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.turns import in_one_turn

HALVES = 16
STEP = 0.02
"""Of a walk, in rad and characteristic lengths over all joints together."""


def distances(record, problem, values):
    """The smallest singular value (N,) of the whole closure with the inputs held, or the pose, that counts."""
    motion, usual = motions(record, values, RANK_GAP), general(record)
    part, rank = (motion.inputs, usual.inputs) if problem == "direct" else (motion.pose, usual.pose)
    sizes = np.linalg.svd(part, compute_uv=False)[:, int(rank) - 1]
    return np.minimum(sizes, motion.values[:, int(usual.closure) - 1])


def changes(record, problem, signs, walks, steps, seed=0):
    """Where a sign changed: how far (K,) from a singularity, as a share of what is usual.

    `signs` are (N, s) of joint values (N, n). The walks begin at home and at assemblies by chance.
    """
    rng = np.random.default_rng(seed)
    known = assemblies_by_chance(record)
    usual = np.median(distances(record, problem, known))
    values = known[rng.integers(len(known), size=walks)]
    values[: walks // 4] = known[0]
    along = rng.normal(size=values.shape)
    shares = []
    before = signs(values)
    for _ in range(steps):
        motion = motions(record, values, RANK_GAP)
        along = np.einsum("nij,nkj,nk->ni", motion.null, motion.null, along + 0.15 * rng.normal(size=values.shape))
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        closed = assemble(record, values + STEP * along * motion.scale)
        near = np.max(np.abs(closed.values - values) / motion.scale, axis=1) < 3 * STEP
        after = np.where((closed.closed & near)[:, None], closed.values, values)
        now = signs(after)
        changed = np.flatnonzero(np.any(now * before < 0, axis=1))
        shares += [_nearest(record, problem, signs, values[k], after[k]) / usual for k in changed]
        values, before = in_one_turn(record, after), now
    return np.array(shares)


def _nearest(record, problem, signs, first, second):
    """How far from a singularity a sign changes between two assemblies (n,): by halves, some 1e-5 of the step."""
    begun = signs(first[None])
    for _ in range(HALVES):
        closed = assemble(record, 0.5 * (first + second)[None])
        if not closed.closed[0]:
            break
        middle = closed.values[0]
        if np.any(signs(middle[None]) * begun < 0):
            second = middle
        else:
            first = middle
    return float(np.min(distances(record, problem, np.stack([first, second]))))
