"""Example configurations, one for each factor of the determinants, found and not written down.

A factor that changes sign in a working mode is followed to its zero between two poses; one that is the
root of a margin is met where that margin ends the mode.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.modes import all_modes
from assur.kinematics.position import inverse
from assur.kinematics.solutions import SolutionSet
from assur.kinematics.status import FACTOR_TOLERANCE, Status, closed_form_of, relative_factors
from assur.model.closed_form import Factor
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SAMPLES = 400
BISECTIONS = 80


@dataclass(frozen=True, eq=False)
class SingularExample:
    """A configuration at which one factor vanishes: pose (m,), inputs (n,), every joint's value, and its status."""

    factor: Factor
    mode: str
    pose: FloatArray
    inputs: FloatArray
    joints: FloatArray
    status: Status


def singular_examples(record: MechanismRecord, seed: int = 0) -> tuple[SingularExample, ...]:
    """One example per factor, in the default working mode where it has one, else in the first that does.

    Poses are drawn from the file's workspace box. A factor that never vanishes in it has no example.
    """
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(seed).uniform(low, high, size=(SAMPLES, len(low)))
    dividing = [factor for factor in closed_form_of(record).factor_list if factor.kind != "other"]
    found = (_example(record, factor, poses) for factor in dividing)
    return tuple(example for example in found if example is not None)


def _example(record: MechanismRecord, factor: Factor, poses: FloatArray) -> SingularExample | None:
    modes = [record.modes.default_working, *all_modes(record, "inverse")]
    candidates: list[tuple[int, int, str, FloatArray, SolutionSet]] = []
    for mode in dict.fromkeys(modes):
        solved = inverse(record, poses, mode)
        real = np.flatnonzero(solved.exists[:, 0])
        for pose in _zeros(record, factor, mode, poses, solved, real):
            here = inverse(record, pose, mode)
            if _size(record, factor, here) <= FACTOR_TOLERANCE:
                candidates.append((_others(record, factor, here), len(candidates), mode, pose, here))
        if candidates and candidates[0][2] == mode:
            break
    if not candidates:
        return None
    _, _, mode, pose, here = min(candidates, key=lambda item: item[:2])
    return SingularExample(factor, mode, pose, here.inputs[0], here.joints[0], Status(int(here.status[0])))


def _zeros(
    record: MechanismRecord,
    factor: Factor,
    mode: str,
    poses: FloatArray,
    solved: SolutionSet,
    real: NDArray[np.intp],
) -> list[FloatArray]:
    """Poses at which the factor may vanish: where it does already, between opposite signs, at the mode's border."""
    value = solved.factors[factor.name][:, 0]

    def positive(pose: FloatArray) -> bool:
        here = inverse(record, pose, mode)
        return bool(here.exists[0]) and float(here.factors[factor.name][0]) > 0.0

    def real_at(pose: FloatArray) -> bool:
        return bool(inverse(record, pose, mode).exists[0])

    found = [poses[k] for k in real[np.abs(value[real]) <= 1e-12][:1]]
    plus, minus = real[value[real] > 0], real[value[real] < 0]
    found += [_border(positive, poses[i], poses[k]) for i, k in zip(plus[:12], minus[:12], strict=False)]
    unreal = np.setdiff1d(np.arange(len(poses)), real)
    found += [_border(real_at, poses[i], poses[k]) for i, k in zip(real[:12], unreal[:12], strict=False)]
    return found


def _border(holds: Callable[[FloatArray], bool], inside: FloatArray, outside: FloatArray) -> FloatArray:
    """The last pose between two at which a property holds."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (inside + outside)
        if holds(middle):
            inside = middle
        else:
            outside = middle
    return inside


def _size(record: MechanismRecord, factor: Factor, here: SolutionSet) -> float:
    if not here.exists[0]:
        return float("inf")
    return abs(float(relative_factors(record, here.factors)[factor.name][0]))


def _others(record: MechanismRecord, factor: Factor, here: SolutionSet) -> int:
    """How many other factors vanish too: the fewer, the clearer the example."""
    sizes = relative_factors(record, here.factors)
    return sum(abs(float(size[0])) <= FACTOR_TOLERANCE for name, size in sizes.items() if name != factor.name)
