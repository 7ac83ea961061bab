"""Example configurations, one for each factor of the determinants, found and not written down.

A factor that changes sign in a working mode is followed to its zero between two poses; one that is the
root of a margin is met where that margin ends the mode. So are factors that divide neither determinant where they
alone make a constraint singularity. Without a closed form paths from home are followed until they stop, then ways on
which a map of the workspace shows that something vanishes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.border import in_range
from assur.kinematics.closed_form.mode_reading import mode_reading_at
from assur.kinematics.following.following import follow
from assur.kinematics.home import home_values
from assur.kinematics.modes import all_modes
from assur.kinematics.position import inverse
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.status import FACTOR_TOLERANCE, Status, closed_form_of, relative_factors
from assur.model.closed_form import ClosedForm, Factor
from assur.model.mechanism import MechanismRecord
from assur.singularity.loci import OUTPUT

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
SAMPLES = 400
AGAIN_SAMPLES = 2**14
"""Poses in the box at which a factor that has no example yet is looked at once more, in the default mode."""

SEGMENTS = 60
BISECTIONS = 70
GROWTH = 3.0
PATHS = 8
"""Paths that are followed from home at most, as many in the box as in the wider one."""

AGAIN = 4
"""A box is left when so many paths in a row met nothing new."""

STOPPED = 1e-12
"""Share of a path within which it stops before a singularity, which is then within what counts as one."""

INPUT = Factor("input", "serial", "1", "the platform stands and an input can move", r"\det J_q", unit=0)
CLOSURE = Factor("closure", "other", "1", "the loops lose a constraint", r"\sigma_\mathrm{min}(J_c)", unit=0)
MET = {"serial": INPUT, "parallel": OUTPUT, "constraint": CLOSURE}
"""What a path that stops has met."""


@dataclass(frozen=True, eq=False)
class SingularExample:
    """A configuration at which one factor vanishes: pose (m,), inputs (n,), every joint's value, and its status.

    `in_box` says whether the pose lies in the workspace box of the mechanism's file.
    """

    factor: Factor
    mode: str
    pose: FloatArray
    inputs: FloatArray
    joints: FloatArray
    status: Status
    in_box: bool


@dataclass(frozen=True, eq=False)
class _Samples:
    """Poses (N, m) of one working mode: which are real, and every factor divided by its scale."""

    poses: FloatArray
    real: BoolArray
    factors: dict[str, FloatArray]

    def others(self, name: str) -> NDArray[np.int_]:
        """How many other factors vanish (N,)."""
        rest = [np.abs(value) <= FACTOR_TOLERANCE for key, value in self.factors.items() if key != name]
        return np.sum(rest, axis=0, dtype=int) if rest else np.zeros(len(self.poses), dtype=int)


Way = tuple[FloatArray, FloatArray]
"""Joint values (n,) of home's mode, and a pose (m,) to which they are followed."""


def singular_examples(
    record: MechanismRecord,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    ways: Callable[[], Iterable[Way]] | None = None,
) -> tuple[SingularExample, ...]:
    """One example per factor: the pose at its zero at which the fewest others vanish, the default mode first.

    Poses are drawn from the workspace box of the file, where a factor has no zero between these from a box three
    times as wide, and more of them from the first in the default mode. A factor that vanishes between none of these
    has no example: that proves nothing. Without a closed form there is one example per kind that is met (input, output,
    closure) on straight paths from home to such poses, then on `ways`, which are only asked for where the paths met no
    serial or no parallel singularity (`assur.workspace.sign_changes`); `progress`, where given, is called with (paths
    done, paths at most).

    >>> from assur.model.registry import load_record
    >>> [example.factor.name for example in singular_examples(load_record("zeng2019"))][:4]
    ['u1_minus_u2', 'w', 'v', 'sin_alpha_minus_beta']
    """
    missing_box = [name for name in record.platform.pose if name not in record.box]
    if missing_box:
        raise UsageError(
            f"{record.name}: no box to look for singular configurations in",
            hint=f"give the file [workspace] box = {{ {missing_box[0]} = [low, high], .. }}",
        )
    if record.closed_form is not None:
        return _of_closed_form(record, seed)
    low, high = _box(record)
    return _met_on_ways(record, _met_on_paths(record, low, high, np.random.default_rng(seed), progress), ways)


def _box(record: MechanismRecord) -> tuple[FloatArray, FloatArray]:
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    return low, high


@lru_cache(maxsize=16)
def _of_closed_form(record: MechanismRecord, seed: int) -> tuple[SingularExample, ...]:
    """One example per factor; figures and the evidence of errata ask for the same."""
    low, high = _box(record)
    rng = np.random.default_rng(seed)
    middle, half = (low + high) / 2, (high - low) / 2
    spans = [(middle - grown * half, middle + grown * half) for grown in (1, GROWTH)]
    boxes = [in_range(record, rng.uniform(*span, (SAMPLES, len(low)))) for span in spans]
    factors = _sought(closed_form_of(record))
    modes = list(dict.fromkeys([record.modes.default_working, *all_modes(record, "inverse")]))
    more = in_range(record, rng.uniform(*spans[0], (AGAIN_SAMPLES, len(low))))
    best: dict[str, _Candidate] = {}
    for poses, among in ((boxes[0], modes), (boxes[1], modes), (more, modes[:1])):
        missing = [factor for factor in factors if factor.name not in best]
        for mode in among:
            unclear = [factor.name for factor in missing if factor.name not in best or best[factor.name].others]
            for candidate in _zeros_in_mode(record, mode, poses, unclear):
                if candidate.name not in best or candidate.others < best[candidate.name].others:
                    best[candidate.name] = candidate
    return tuple(_example(record, factor, best[factor.name]) for factor in factors if factor.name in best)


def brought_to(record: MechanismRecord, pose: FloatArray, example: SingularExample) -> SingularExample:
    """The example moved to a pose (m,) in as many of its coordinates as leave it what it is.

    So examples differ where they have to alone, as in y of a mechanism of which nothing depends on y. Without a closed
    form an example stays where a path stopped.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> found = [brought_to(record, np.array([0.0, 7.0, 400.0]), item) for item in singular_examples(record)]
    >>> {float(item.pose[1]) for item in found}
    {7.0}
    """
    if record.closed_form is None:
        return example
    size = len(example.pose)
    for count in range(size, 0, -1):
        for chosen in combinations(range(size), count):
            there = example.pose.copy()
            there[list(chosen)] = pose[list(chosen)]
            here = inverse(record, there, example.mode)
            value = relative_factors(record, here.factors)[example.factor.name][0]
            same = bool(here.exists[0]) and Status(int(here.status[0])) == example.status
            if same and abs(float(value)) <= FACTOR_TOLERANCE:
                inside = _in_box(record, there)
                return replace(example, pose=there, inputs=here.inputs[0], joints=here.joints[0], in_box=inside)
    return example


def _sought(form: ClosedForm) -> list[Factor]:
    """The factors of the determinants, and those that alone make a constraint singularity."""
    alone = {group[0] for group in form.constraint_singular if len(group) == 1}
    return [item for item in form.factor_list if item.kind != "other" or item.name in alone]


def _met_on_paths(
    record: MechanismRecord,
    low: FloatArray,
    high: FloatArray,
    rng: np.random.Generator,
    progress: Callable[[int, int], None] | None,
) -> dict[str, SingularExample]:
    """The first configuration of each kind before which a path from home to a pose by chance stops."""
    home = home_values(record)
    middle, half = (low + high) / 2, (high - low) / 2
    best: dict[str, SingularExample] = {}
    last = {1.0: -1, GROWTH: PATHS - 1}
    for k in range(2 * PATHS):
        grown = 1.0 if k < PATHS else GROWTH
        if k - last[grown] > AGAIN:
            continue
        if progress is not None:
            progress(k, 2 * PATHS)
        target = in_range(record, rng.uniform(middle - grown * half, middle + grown * half))
        if _meet(record, best, home, target):
            last[grown] = k
        if len(best) == len(MET):
            break
    return best


def _met_on_ways(
    record: MechanismRecord, best: dict[str, SingularExample], ways: Callable[[], Iterable[Way]] | None
) -> tuple[SingularExample, ...]:
    """Those and the first of each further kind that the ways meet; no way says anything of the closure."""
    if ways is not None and not {"serial", "parallel"} <= set(best):
        for joints, target in ways():
            _meet(record, best, joints, target)
            if {"serial", "parallel"} <= set(best):
                break
    return tuple(best[kind] for kind in MET if kind in best)


def _meet(record: MechanismRecord, best: dict[str, SingularExample], joints: FloatArray, target: FloatArray) -> bool:
    """Whether a path from joint values (n,) to a pose (m,) stops before a singularity of a new kind, which is kept."""
    stop = follow(record, joints, poses=target, use_limits=False, tolerance=STOPPED).stopped
    if stop is None or stop.kind not in MET or stop.kind in best:
        return False
    status = Status(int(classify_at(record, stop.joints)))
    if status in (Status.regular, Status.near_singular):
        return False
    mode, inside = record.modes.default_working, _in_box(record, stop.pose)
    best[stop.kind] = SingularExample(MET[stop.kind], mode, stop.pose, stop.inputs, stop.joints, status, inside)
    return True


@dataclass(frozen=True, eq=False)
class _Candidate:
    """A real pose at the zero of a factor, and how many other factors vanish there: the fewer, the clearer."""

    name: str
    mode: str
    pose: FloatArray
    others: int


def _example(record: MechanismRecord, factor: Factor, candidate: _Candidate) -> SingularExample:
    solutions = inverse(record, candidate.pose, candidate.mode)
    status, inside = Status(int(solutions.status[0])), _in_box(record, candidate.pose)
    return SingularExample(
        factor, candidate.mode, solutions.given, solutions.inputs[0], solutions.joints[0], status, inside
    )


def _in_box(record: MechanismRecord, pose: FloatArray) -> bool:
    """Whether a pose (m,) lies in the file's box."""
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    return bool(np.all((pose >= low) & (pose <= high)))


def _zeros_in_mode(record: MechanismRecord, mode: str, poses: FloatArray, names: list[str]) -> list[_Candidate]:
    """The clearest pose at the zero of each factor that has one in this mode."""
    if not names:
        return []
    samples = _evaluate(record, mode, poses)
    border = _evaluate(record, mode, _border_poses(record, mode, samples))
    found = []
    for name in names:
        crossing = _evaluate(record, mode, _crossing_poses(record, mode, samples, name))
        candidates = [item for where in (crossing, border, samples) for item in _zeros(where, name, mode)]
        if candidates:
            found.append(min(candidates, key=lambda candidate: candidate.others))
    return found


def _zeros(samples: _Samples, name: str, mode: str) -> list[_Candidate]:
    others = samples.others(name)
    zero = samples.real & (np.abs(samples.factors[name]) <= FACTOR_TOLERANCE)
    return [_Candidate(name, mode, samples.poses[k], int(others[k])) for k in np.flatnonzero(zero)]


def _evaluate(record: MechanismRecord, mode: str, poses: FloatArray) -> _Samples:
    read, shape = mode_reading_at(record, mode, poses), (len(poses),)
    factors = {
        item.name: np.broadcast_to(read.relative_factors[item.name], shape) for item in _sought(closed_form_of(record))
    }
    return _Samples(poses, np.broadcast_to(read.exists, shape), factors)


def _border_poses(record: MechanismRecord, mode: str, samples: _Samples) -> FloatArray:
    """Last real poses on the way from real samples to others that are not."""
    real, unreal = np.flatnonzero(samples.real), np.flatnonzero(~samples.real)
    return _last_inside(lambda poses: _evaluate(record, mode, poses).real, samples.poses, real, unreal)


def _crossing_poses(record: MechanismRecord, mode: str, samples: _Samples, name: str) -> FloatArray:
    """Poses at which a factor changes sign, on the way between real samples of opposite signs."""

    def positive(poses: FloatArray) -> BoolArray:
        here = _evaluate(record, mode, poses)
        return here.real & (here.factors[name] > 0)

    plus = np.flatnonzero(samples.real & (samples.factors[name] > 0))
    minus = np.flatnonzero(samples.real & (samples.factors[name] < 0))
    return _last_inside(positive, samples.poses, plus, minus)


def _last_inside(
    holds: Callable[[FloatArray], BoolArray], poses: FloatArray, inside: NDArray[np.intp], outside: NDArray[np.intp]
) -> FloatArray:
    """The last poses (k, m) at which a property holds, on segments between two sets of samples."""
    count = min(SEGMENTS, len(inside), len(outside))
    here, there = poses[inside[:count]], poses[outside[:count]]
    for _ in range(BISECTIONS if count else 0):
        middle = 0.5 * (here + there)
        keep = holds(middle)[:, None]
        here, there = np.where(keep, middle, here), np.where(keep, there, middle)
    return here
