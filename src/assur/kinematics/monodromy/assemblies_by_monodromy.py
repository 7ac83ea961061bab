"""All assemblies of a direct problem, real and complex, from some that are known.

At complex inputs assemblies change places round a loop of inputs: followed round loops by chance, one leads to all of
its component. That they are all is told by a trace test: the sum over all of a function of the assembly is a rational
function of the inputs, and over some of them it is none (A. Leykin, J. I. Rodriguez, F. Sottile 2018). Of a component
of which nothing is known nothing is said.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.state import state_of, values_of
from assur.kinematics.monodromy.complex_loops import ComplexLoops
from assur.kinematics.monodromy.paths import followed
from assur.model.mechanism import MechanismRecord
from assur.numerics.monodromy import random_complex
from assur.numerics.rational_functions import rational_degree

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SAME = 1e-6
"""Largest difference of places, in characteristic lengths, of assemblies that are one."""
REAL = 1e-6
"""Imaginary part of a state, its numbers being of size 1, of an assembly that is tried as a real one."""
REGULAR = 1e-7
"""Ratio of singular values from which on an assembly can be followed."""
SIZES = 1.6
"""Logarithm of how much farther than usual, or nearer, the corners of loops are: nobody knows where assemblies meet."""
TOGETHER, ROUNDS = 8, 12
"""Loops that are gone round at once, until none of them leads to anything new; and how often at most."""
MOST = 64
"""Assemblies up to which all are followed: of more a search knows too few, and to go on would take minutes."""


@dataclass(frozen=True, eq=False)
class MonodromySolutions:
    """Assemblies by loops of complex inputs.

    Attributes:
        joints: (K, n) joint values of the real ones.
        complex: how many there are, real ones among them.
        infinite: how many paths to the inputs that are asked went to infinity.
        degree: of the trace as a rational function; None where it is none, so that some are missing.
        lost: how many paths did not arrive at the inputs that are asked.
    """

    joints: FloatArray
    complex: int
    infinite: int
    degree: int | None
    lost: int

    @property
    def complete(self) -> bool:
        """Whether these are all of every component of which one was known."""
        return self.degree is not None and not self.lost


def assemblies_by_monodromy(
    record: MechanismRecord, inputs: FloatArray, known: FloatArray, seed: int = 0
) -> MonodromySolutions | None:
    """From known assemblies (K, n) at joint values (k,) of the inputs; None where no regular one can be followed.

    Errors:
        NoMonodromyError: the loops have fewer equations than free joints.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rrr")
    >>> home = home_values(record)
    >>> solutions = assemblies_by_monodromy(record, home[list(record.input_indices)], home[None])
    >>> solutions.complex, solutions.complete
    (6, True)
    """
    rng = np.random.default_rng(seed)
    loops = ComplexLoops(record, inputs, random_complex(rng, len(inputs)))
    begun = state_of(record, known.T).astype(complex)
    begun = begun[:, loops.regularity(begun) > REGULAR]
    base = np.exp(2j * np.pi * rng.uniform())
    start = np.zeros(begun.shape[1], dtype=complex)
    state = _led(loops, begun, start, start + base)
    if not state.shape[1]:
        return None
    degree = None
    for _ in range(ROUNDS):
        more = _round_loops(loops, state, base, rng)
        if more.shape[1] > MOST:
            break
        quiet, state = more.shape[1] == state.shape[1], more
        degree = _trace_degree(loops, state, base, rng) if quiet else None
        if degree is not None:
            break
    ends = followed(loops, state, np.full(state.shape[1], base), np.zeros(state.shape[1], dtype=complex))
    real = ends.arrived & (np.max(np.abs(ends.state.imag), axis=0) < REAL)
    joints = values_of(record, ends.state[:, real].real).T
    lost = int(np.sum(~ends.arrived & ~ends.infinite))
    return MonodromySolutions(joints, state.shape[1], int(np.sum(ends.infinite)), degree, lost)


def _anywhere(rng: np.random.Generator, count: int) -> ComplexArray:
    """Complex numbers (count,), small ones and large ones."""
    return random_complex(rng, count) * np.exp(rng.uniform(-SIZES, SIZES, count))


def _led(loops: ComplexLoops, state: ComplexArray, *corners: ComplexArray) -> ComplexArray:
    """The assemblies to which ways (N,) from corner to corner lead, each once; those that are lost are left out."""
    left = np.arange(state.shape[1])
    for start, end in pairwise(corners):
        ends = followed(loops, state, start[left], end[left])
        state, left = ends.state[:, ends.arrived], left[ends.arrived]
    return state[:, _distinct(loops.places(state))]


def _distinct(places: ComplexArray) -> list[int]:
    kept: list[int] = []
    for k, own in enumerate(places):
        size = 1.0 + np.max(np.abs(own), initial=0.0)
        if all(np.max(np.abs(own - places[j])) > SAME * size for j in kept):
            kept.append(k)
    return kept


def _round_loops(loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator) -> ComplexArray:
    """The assemblies at the base, and those to which some loops by chance lead from them."""
    count = state.shape[1]
    start = np.full(TOGETHER * count, base)
    first, second = (np.repeat(_anywhere(rng, TOGETHER), count) for _ in range(2))
    both = np.concatenate([state, _led(loops, np.tile(state, (1, TOGETHER)), start, first, second, start)], axis=1)
    return both[:, _distinct(loops.places(both))]


def _trace_degree(loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator) -> int | None:
    """Degree of the sum over assemblies of a function by chance, from its values at places that are led to by ways by
    chance, so that what is missing would be missed in many ways.
    """
    count, most = state.shape[1], 4 * state.shape[1] + 40
    ends, by_way = random_complex(rng, most), _anywhere(rng, most)
    start = np.tile(state, (1, most))
    half = followed(loops, start, np.full(count * most, base), np.repeat(by_way, count))
    whole = followed(loops, half.state, np.repeat(by_way, count), np.repeat(ends, count))
    sure = (half.arrived & whole.arrived).reshape(most, count).all(axis=1)
    places = loops.places(whole.state)
    weights = random_complex(rng, places.shape[1])
    trace = (places @ weights).reshape(most, count).sum(axis=1)
    return rational_degree(ends[sure], trace[sure])
