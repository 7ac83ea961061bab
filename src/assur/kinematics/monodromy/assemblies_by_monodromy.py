"""All assemblies of a position problem, real and complex, from some that are known.

At complex inputs, or poses, assemblies change places round a loop of them: followed round loops by chance, one leads to
all of its component. That they are all is told by a trace test: the sum over all of a function of the assembly is a
rational function of the place on a line of inputs, and over some of them it is none (A. Leykin, J. I. Rodriguez,
F. Sottile 2018). Of a component of which nothing is known nothing is said.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.state import state_of, values_of
from assur.joint_graph.turns import screws_among
from assur.kinematics.border import held_inputs
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion
from assur.kinematics.modes import Problem
from assur.kinematics.monodromy.complex_loops import ComplexLoops, NoMonodromyError
from assur.kinematics.monodromy.paths import followed
from assur.kinematics.pose import pose_error
from assur.model.mechanism import MechanismRecord
from assur.model.pose import has_quaternion
from assur.numerics.monodromy import random_complex
from assur.numerics.rational_functions import rational_degree, scattered
from assur.work import stage

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SAME = 1e-6
"""Largest difference of places, in characteristic lengths, of assemblies that are one."""
REAL = 1e-6
"""Imaginary part of a state, its numbers being of size 1, of an assembly that is tried as a real one."""
AS_GIVEN = 1e-5
"""Largest difference of a pose, in lengths and rad, from the one that is asked."""
REGULAR = 1e-7
"""Ratio of singular values from which on an assembly can be followed."""
SIZES = 4.0
"""Logarithm of how much farther away, or nearer, than 1 corners of loops are. With half of it one five-bar in ten was
called complete with one of its two assemblies: no way went round where these meet."""
ENOUGH = 0.9
"""Share of the ways round loops after which the others, which come near to where assemblies meet, are given up."""
TOGETHER, ROUNDS = 16, 12
"""Loops that are gone round at once, until none of them leads to anything new; and how often at most."""
LINES = 4
"""Lines of inputs, one after the other, while the trace says that some are missing: what only few loops of one line
lead to is near on another."""
NEARLY_ALL, ENOUGH_PLACES = 0.995, 0.8
"""The same share of the ways to places of the trace, and the share of the places that all assemblies reach."""
FEW_PLACES = 20
"""Places at which the trace is asked first: enough for one of a low degree, as most are."""
MOST = 4000
"""Assemblies times the square of the joint coordinates up to which all are followed: with more it takes minutes."""
LONGEST = 500_000
"""The same times the places of a trace of any degree, up to which it is asked: ten seconds. Where it is not,
nothing says that some are missing, and no other line is gone along."""


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
    record: MechanismRecord, problem: Problem, given: FloatArray, known: FloatArray, seed: int = 0
) -> MonodromySolutions | None:
    """From known assemblies (K, n) at joint values (k,) of the inputs, or at a pose (k,); None where none is regular.

    At a pose there may be some of another pose among them, whose angles have the same tangents.

    Errors:
        NoMonodromyError: the loops have fewer equations than free joints.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rpr")
    >>> home = home_values(record)
    >>> solutions = assemblies_by_monodromy(record, "direct", home[list(record.input_indices)], home[None])
    >>> solutions.complex, solutions.complete
    (6, True)
    """
    rng = np.random.default_rng(seed)
    state = state_of(record, known.T).astype(complex)
    for _ in range(LINES):
        loops = ComplexLoops(record, problem, given, random_complex(rng, len(given)))
        base = np.exp(2j * np.pi * rng.uniform())
        start = np.zeros(state.shape[1], dtype=complex)
        regular = loops.regularity(state) > REGULAR
        state = _led(loops, state[:, regular], start[regular], start[regular] + base)
        if not state.shape[1]:
            return None
        state, degree = _along_line(loops, state, base, rng)
        ends = followed(loops, state, np.full(state.shape[1], base), np.zeros(state.shape[1], dtype=complex))
        if degree is not None or _too_many(record, state.shape[1]) or _too_long(record, state.shape[1]):
            break
        state = ends.state[:, ends.arrived]
    real = ends.arrived & (np.max(np.abs(ends.state.imag), axis=0) < REAL)
    joints = values_of(record, ends.state[:, real].real).T
    lost = int(np.sum(~ends.arrived & ~ends.infinite))
    return MonodromySolutions(joints, len(real), int(np.sum(ends.infinite)), degree, lost)


def _along_line(
    loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator
) -> tuple[ComplexArray, int | None]:
    """All assemblies (k, N) at the base that loops lead to from some, and the degree of their trace."""
    for _ in range(ROUNDS):
        more = _round_loops(loops, state, base, rng)
        quiet, state = more.shape[1] == state.shape[1], more
        if _too_many(loops.record, state.shape[1]):
            break
        degree = _trace_degree(loops, state, base, rng, thorough=quiet)
        if quiet or degree is not None:
            return state, degree
    return state, None


@stage("assemblies followed round loops of complex inputs")
def solved_by_monodromy(
    record: MechanismRecord, problem: Problem, given: FloatArray, known: FloatArray
) -> LoopSolutions | None:
    """All assemblies at printed inputs (k,) or a pose (k,), with those that a search knows (K, n); None where that is
    not known.

    >>> from assur.kinematics.search import search
    >>> from assur.model.registry import load_record
    >>> record, inputs = load_record("fivebar"), np.radians([127.0, 53.0])
    >>> print(solved_by_monodromy(record, "direct", inputs, search(record, "direct", inputs).joints).right)
    2 complex assemblies, to which loops of complex inputs lead from those of a search, with a trace of degree 4
    """
    question = PositionQuestion(record, problem, given)
    if not len(known) or _too_many(record, len(known)) or np.any(screws_among(record)):
        return None
    if problem == "inverse" and has_quaternion(record.platform.pose):
        return None
    held = held_inputs(record, home_values(record), given)[list(record.input_indices)] if problem == "direct" else given
    try:
        solutions = assemblies_by_monodromy(record, problem, held, known)
    except NoMonodromyError:
        return None
    if solutions is None or not solutions.complete:
        return None
    joints = solutions.joints
    if problem == "inverse":
        joints = joints[np.max(np.abs(pose_error(record, joints, given, 1.0)), axis=1, initial=0.0) < AS_GIVEN]
    joints = question.closed(joints)
    if len(distinct(record, np.concatenate([joints, known]))) != len(joints):
        return None  # a known one is singular, so that no path leads there
    lines = "inputs" if problem == "direct" else "poses"
    right = f"{solutions.complex} complex assemblies, to which loops of complex {lines} lead from those of a search, "
    return LoopSolutions(joints, True, f"{right}with a trace of degree {solutions.degree}", solutions.complex)


def _too_many(record: MechanismRecord, count: int) -> bool:
    return count * len(record.coordinates) ** 2 > MOST


def _too_long(record: MechanismRecord, count: int) -> bool:
    return _places(count) * count * len(record.coordinates) ** 2 > LONGEST


def _places(count: int) -> int:
    """How many places tell the degree of a trace of so many assemblies."""
    return 6 * count + 48


def _anywhere(rng: np.random.Generator, count: int) -> ComplexArray:
    """Complex numbers (count,), small ones and large ones."""
    return random_complex(rng, count) * np.exp(rng.uniform(-SIZES, SIZES, count))


def _led(loops: ComplexLoops, state: ComplexArray, *corners: ComplexArray, enough: float = 1.0) -> ComplexArray:
    """The assemblies to which ways (N,) from corner to corner lead, each once; those that are lost are left out."""
    left = np.arange(state.shape[1])
    for start, end in pairwise(corners):
        ends = followed(loops, state, start[left], end[left], enough=enough)
        state, left = ends.state[:, ends.arrived], left[ends.arrived]
    return state[:, _distinct(loops.places(state))]


def _distinct(places: ComplexArray) -> list[int]:
    kept: list[int] = []
    for k, own in enumerate(places):
        size = 1.0 + np.max(np.abs(own), initial=0.0)
        if np.all(np.max(np.abs(own - places[kept]), axis=-1, initial=0.0) > SAME * size):
            kept.append(k)
    return kept


def _round_loops(loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator) -> ComplexArray:
    """The assemblies at the base, and those to which some loops by chance lead from them."""
    count = state.shape[1]
    start = np.full(TOGETHER * count, base)
    first, second = (np.repeat(_anywhere(rng, TOGETHER), count) for _ in range(2))
    led = _led(loops, np.tile(state, (1, TOGETHER)), start, first, second, start, enough=ENOUGH)
    both = np.concatenate([state, led], axis=1)
    return both[:, _distinct(loops.places(both))]


def _trace_degree(
    loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator, *, thorough: bool
) -> int | None:
    """Degree of the sum over assemblies of a function by chance; None where it is no rational function of a low degree.

    With `thorough` of any degree, unless that takes too long.
    """
    count = state.shape[1]
    few = _degree_at(FEW_PLACES, loops, state, base, rng)
    if few is not None or not thorough or _too_long(loops.record, count):
        return few
    return _degree_at(_places(count), loops, state, base, rng)


def _degree_at(
    most: int, loops: ComplexLoops, state: ComplexArray, base: complex, rng: np.random.Generator
) -> int | None:
    """That degree, told by so many places.

    They are led to by ways by chance, so that other assemblies would be missing in each.
    """
    count = state.shape[1]
    ends, by_way = scattered(rng, most), _anywhere(rng, most)
    start = np.tile(state, (1, most))
    half = followed(loops, start, np.full(count * most, base), np.repeat(by_way, count), enough=NEARLY_ALL)
    whole = followed(loops, half.state, np.repeat(by_way, count), np.repeat(ends, count), enough=NEARLY_ALL)
    reached = np.all((half.arrived & whole.arrived).reshape(most, count), axis=1)
    if np.mean(reached) < ENOUGH_PLACES:
        return None
    places = loops.places(whole.state)
    traces = (places @ random_complex(rng, places.shape[1])).reshape(most, count).sum(axis=1)
    return rational_degree(ends[reached], traces[reached])
