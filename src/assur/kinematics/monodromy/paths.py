"""Assemblies followed while inputs or a pose change on a complex line: a midpoint step, then Newton's method."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.monodromy.complex_loops import ComplexLoops

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
BoolArray = NDArray[np.bool_]

CLOSE = 2e-2
"""Largest correction of a predicted assembly, in rad and characteristic lengths: with a larger one the step is halved,
so that no path jumps to another one."""
EASY = 2e-3
"""A correction below which the next step may be longer."""
CLOSED = 1e-6
"""Newton's last step: the next would be its square."""
CORRECTIONS = 4
FIRST, SHORTEST = 0.05, 1e-7
"""Steps, as shares of a path."""
GROWTH = 1.7
MOST_STEPS = 2000
FAR = 1e5
"""A number of a state beyond which a path goes to infinity."""


@dataclass(frozen=True, eq=False)
class ComplexPaths:
    """Ends of paths: states (k, N), whether (N,) they arrived, and whether (N,) they went to infinity instead."""

    state: ComplexArray
    arrived: BoolArray
    infinite: BoolArray


def followed(
    loops: ComplexLoops, state: ComplexArray, start: ComplexArray, end: ComplexArray, *, enough: float = 1.0
) -> ComplexPaths:
    """Assemblies (k, N) at start (N,) on the line of inputs or poses followed straight to end (N,).

    Once this share of them is at its end, the others are given up.
    """
    state, count = state.copy(), state.shape[1]
    way, share, step = end - start, np.zeros(count), np.full(count, FIRST)
    infinite = np.zeros(count, dtype=bool)
    for _ in range(MOST_STEPS):
        left = np.flatnonzero((share < 1.0) & (step > SHORTEST) & ~infinite)
        if not len(left) or np.sum(share >= 1.0) >= enough * count:
            break
        length = np.minimum(step[left], 1.0 - share[left])
        t, dt = start[left] + share[left] * way[left], length * way[left]
        with np.errstate(all="ignore"):
            new, largest, kept = _stepped(loops, state[:, left], t, dt)
        good = left[kept]
        state[:, good] = new[:, kept]
        share[good] = np.where(length[kept] == 1.0 - share[good], 1.0, share[good] + length[kept])
        step[left] = np.where(kept, np.where(largest < EASY, GROWTH, 1.0) * length, 0.5 * length)
        infinite[good] = np.max(np.abs(state[:, good]), axis=0, initial=0.0) > FAR
    return ComplexPaths(state, (share >= 1.0) & ~infinite, infinite)


def _stepped(
    loops: ComplexLoops, state: ComplexArray, t: ComplexArray, dt: ComplexArray
) -> tuple[ComplexArray, FloatArray, BoolArray]:
    """States after one step, their largest corrections (N,), and whether (N,) these were small."""
    half = loops.moved(state, state, 0.5 * dt[:, None] * loops.tangent(state, t))
    half = loops.at(half, t + 0.5 * dt)
    new = loops.at(loops.moved(state, half, dt[:, None] * loops.tangent(half, t + 0.5 * dt)), t + dt)
    largest = np.zeros(len(t))
    for _ in range(CORRECTIONS):
        rates = loops.step(new, t + dt)
        last = np.max(np.abs(rates), axis=1)
        largest = np.maximum(largest, last)
        new = loops.at(loops.moved(new, new, rates), t + dt)
        if not np.any((last > CLOSED) & (largest <= CLOSE)):
            break
    return new, largest, (largest <= CLOSE) & (last <= CLOSED)
