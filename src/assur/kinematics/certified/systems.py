"""Direct problems that are polynomial systems: every complex solution in a box of its own, as many as there can be.

Real and imaginary parts are the unknowns of a Krawczyk test, the homogeneous unknowns being scaled by one linear
equation with real factors. A box that is symmetric about the real space and holds one solution holds a real one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.given import inputs_meant, joint_inputs, number, parameters
from assur.kinematics.certified.result import CertifiedSolutions, Doubt, ProvedSolution
from assur.kinematics.closed_form.systems import ends
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import PolynomialSystem
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION
from assur.numerics.intervals.complex import Complex
from assur.numerics.intervals.interval import Interval, as_interval, common
from assur.numerics.intervals.shapes import empty
from assur.numerics.krawczyk import image, parts, proves, stacked
from assur.numerics.number_types import Intervals
from assur.work import stage

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
NEARLY_REAL = 1e-6
"""Imaginary part, the largest unknown being 1, below which a solution in floats is tried as a real one."""
RADII = (1e-11, 1e-9, 1e-7)
"""Half widths of the boxes that are tried, against the largest unknown."""
SCALING = (0.61, -0.37, 0.53, 0.29, -0.43, 0.31, 0.59, -0.47)
"""Factors of the equation that scales the unknowns: any that no solution is across to will do."""
HOW = "Krawczyk on the system of polynomials"


class _Scaled:
    """The equations over real and imaginary parts (2 n) of the unknowns in units of the characteristic length."""

    def __init__(self, record: MechanismRecord, system: PolynomialSystem, inputs: FloatArray) -> None:
        self.system, self.p, self.given = system, parameters(record), joint_inputs(record, inputs)
        self.units = [characteristic_length(record) ** unit for unit in system.units]
        self.factors = np.resize(SCALING, len(self.units))

    def __call__(self, ns: Any, numbers: Sequence[Any]) -> list[Any]:
        x = self.unknowns(numbers)
        scaling: Any = -1.0
        for factor, value in zip(self.factors.tolist(), x, strict=True):
            scaling = scaling + value * factor
        own = tuple(value * unit for value, unit in zip(x, self.units, strict=True))
        values = [scaling, *self.system.equations(ns, self.p, self.given, own)]
        return [part for value in values for part in (value.real, value.imaginary)]

    def unknowns(self, numbers: Sequence[Any]) -> tuple[Complex, ...]:
        """Complex unknowns of their parts, one after the other."""
        return tuple(Complex(*pair) for pair in zip(numbers[::2], numbers[1::2], strict=True))


@stage("proof by the polynomial system")
def direct_by_system(record: MechanismRecord, system: PolynomialSystem, inputs: FloatArray) -> CertifiedSolutions:
    """Every pose at printed inputs (n,): complete where as many solutions are proved as `system.degree`.

    That there can be no more is the file's claim, for the reason that it gives; nothing here proves it.
    """
    equations = _Scaled(record, system, inputs)
    points = ends(record, system, inputs[None])[0][0]
    with np.errstate(all="ignore"):
        points = points / (points @ equations.factors)[:, None]
    points = points[np.all(np.isfinite(points), axis=1)]
    size = np.max(np.abs(points), axis=1)
    nearly = np.max(np.abs(points.imag), axis=1) <= NEARLY_REAL * size
    points = np.where(nearly[:, None], points.real, points)
    flat = np.stack([points.real, points.imag], axis=-1).reshape(len(points), -1)
    box, proved = _boxes(equations, flat, size)
    x = equations.unknowns(parts(box))
    proved &= _finite(system, x)
    complex_ = np.zeros(len(flat), dtype=bool)
    for value in x:
        complex_ |= value.imaginary.nonzero
    proved &= nearly | complex_
    kept = _apart(box, np.flatnonzero(proved))
    floats = position.direct(record, inputs)
    rows = [k for k in kept if nearly[k]]
    poses, inside = _poses(record, equations, box[rows])
    solutions = tuple(_solution(floats, poses[k], inputs) for k in np.flatnonzero(inside))
    complete = len(kept) == system.degree and bool(np.all(inside))
    form = closed_form_of(record)
    right = f"{len(kept)} complex solutions of the system are proved, each in a box of its own, "
    right += f"of {system.degree} that there can be, which the mechanism's file claims ({system.because})"
    return CertifiedSolutions(
        record, "direct", inputs, solutions, _missing(system, len(kept)), complete, form.complete_for, right
    )


def _boxes(equations: _Scaled, points: FloatArray, size: FloatArray) -> tuple[Interval, BoolArray]:
    """Narrow boxes (K, 2 n) of solutions about points, and which of them are proved."""
    low, high = points.copy(), points.copy()
    proved = np.zeros(len(points), dtype=bool)
    for radius in RADII:
        rows = np.flatnonzero(~proved)
        if not len(rows):
            break
        half = radius * size[rows, None]
        box = Interval.of(points[rows] - half, points[rows] + half)
        found = image(equations, box)
        one = proves(found, box)
        low[rows[one]], high[rows[one]], proved[rows[one]] = found.low[one], found.high[one], True
    return Interval.of(low, high), proved


def _finite(system: PolynomialSystem, x: tuple[Complex, ...]) -> BoolArray:
    """Where (K,) a solution is certainly not at infinity."""
    value = system.finite(x)
    return np.asarray(as_interval(value.real).nonzero | as_interval(value.imaginary).nonzero)


def _apart(box: Interval, rows: NDArray[np.intp]) -> list[int]:
    """Those of some boxes that certainly hold different solutions."""
    kept: list[int] = []
    for k in rows.tolist():
        if not kept or np.all(np.any(common(box[kept], box[k])[1], axis=-1)):
            kept.append(k)
    return kept


def _poses(record: MechanismRecord, equations: _Scaled, box: Interval) -> tuple[Interval, BoolArray]:
    """Bounds (k, m) of the poses of real solutions, and where they are defined; of q and -q the one with qw >= 0."""
    size = len(record.platform.pose)
    if not len(box.low):
        return empty(size), np.zeros(0, dtype=bool)
    real = tuple(part * unit for part, unit in zip(parts(box)[::2], equations.units, strict=True))
    branch = equations.system.back(Intervals(), equations.p, equations.given, real)
    poses = stacked([number(value) for value in branch.pose], len(box.low))
    if QUATERNION[0] in record.platform.pose:
        columns = np.isin(record.platform.pose, QUATERNION)
        turned = columns & (poses.middle[:, [record.platform.pose.index(QUATERNION[0])]] < 0)
        low, high = np.where(turned, -poses.high, poses.low), np.where(turned, -poses.low, poses.high)
        poses = Interval(low, high, poses.defined)
    return poses, np.asarray(np.all(poses.defined, axis=-1))


def _solution(floats: SolutionSet, pose: Interval, inputs: FloatArray) -> ProvedSolution:
    rows = np.flatnonzero(floats.exists)
    mode = working = ""
    if len(rows):
        row = rows[np.argmin(np.linalg.norm(floats.poses[rows] - pose.middle, axis=-1))]
        mode, working = str(floats.labels[row]), str(floats.other_labels[row])
    return ProvedSolution(pose, inputs_meant(floats.record, inputs), mode, working, mode, HOW)


def _missing(system: PolynomialSystem, count: int) -> tuple[Doubt, ...]:
    if count == system.degree:
        return ()
    whole = np.array([-np.inf]), np.array([np.inf])
    meaning = "solutions that nobody can tell apart, from complex ones, or from infinity"
    return (Doubt(", ".join(system.unknowns), *whole, meaning, branches=system.degree - count),)
