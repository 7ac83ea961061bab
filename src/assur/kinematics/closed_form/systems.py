"""Direct problems that are polynomial systems: every solution is followed from those of a start mechanism.

On the way from the start to the mechanism in question dimensions and inputs run on straight lines in the complex
numbers. With probability one no solutions meet before the end; the limits of the paths are then all isolated
solutions that there are (Morgan, Sommese 1989).
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.closed_form.roots import RootBranches
from assur.kinematics.closed_form.start_system import dimensions, family, start_system
from assur.model.closed_form import Branch, Margin, PolynomialSystem
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION
from assur.numerics.homotopy import SAME, PathEnd, solve
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
BoolArray = NDArray[np.bool_]
REAL = 1e-7
"""Largest imaginary part of a real solution, its largest unknown being 1; two that merge miss it by a square root."""
INFINITE = 1e-9
ROOT = Margin("root", "1", "the system has fewer real solutions than complex ones", unit=0)
AT_ONCE = 256
"""Problems that are followed together; more would only need more memory."""


@dataclass(frozen=True, eq=False, repr=False)
class SystemBranches(RootBranches):
    """The real solutions of a polynomial system, in the order of their pose.

    Attributes:
        end: (..., K) how each path ended, `PathEnd`.
        infinite: (..., K) whether it ended at infinity.
    """

    end: NDArray[np.int8] = dataclasses.field(kw_only=True)
    infinite: BoolArray = dataclasses.field(kw_only=True)

    @property
    def complete(self) -> bool:
        """Whether every path ended at a regular finite solution, of which there can be no more."""
        return not self.only and bool(np.all((self.end == PathEnd.regular) & ~self.infinite))

    @property
    def right(self) -> str:
        """By what right the answer is complete, or what became of the paths."""
        system = _system(self.record)
        if np.all((self.end == PathEnd.regular) & ~self.infinite):
            return f"all {system.degree} complex solutions were found: there are no more ({system.because})"
        parts = {
            "at a single solution": (self.end == PathEnd.regular) & ~self.infinite,
            "at infinity": self.infinite & (self.end != PathEnd.lost),
            "where solutions meet": (self.end == PathEnd.singular) & ~self.infinite,
            "nowhere known": self.end == PathEnd.lost,
        }
        ends = ", ".join(f"{int(np.sum(rows))} {where}" for where, rows in parts.items() if np.any(rows))
        return f"not proved: of {self.end.size} paths ended {ends}"


def solutions_of(
    record: MechanismRecord, system: PolynomialSystem, given: FloatArray, only: str = ""
) -> SystemBranches:
    """Every solution of a polynomial system at inputs (..., n), or that of one mode."""
    flat = given.reshape(int(np.prod(given.shape[:-1], dtype=int)), given.shape[-1])
    blocks = [ends(record, system, flat[start : start + AT_ONCE]) for start in range(0, len(flat), AT_ONCE)]
    empty = np.zeros((0, system.degree, len(system.unknowns)), dtype=complex), np.zeros((0, system.degree), np.int8)
    x, end = (np.concatenate([empty[k], *(block[k] for block in blocks)]) for k in (0, 1))
    infinite = np.abs(system.finite(tuple(np.moveaxis(x, -1, 0)))) <= INFINITE  # (N, K)
    gap = np.where(infinite | (end == PathEnd.lost), 1.0, np.max(np.abs(x.imag), axis=-1))
    gap = np.where(gap <= REAL, 0.0, gap)
    real = x.real * characteristic_length(record) ** np.array(system.units)
    order = _order(_poses(record, system, flat, real), gap)
    gap, end, infinite = (np.take_along_axis(item, order, axis=1) for item in (gap, end, infinite))
    real = np.take_along_axis(real, order[..., None], axis=1)
    copy = np.zeros(gap.shape, dtype=bool)
    even = real / characteristic_length(record) ** np.array(system.units)
    near = np.max(np.abs(np.diff(even, axis=1)), axis=-1) < SAME**0.5
    copy[:, 1:] = near & (end[:, 1:] == PathEnd.singular) & (gap[:, 1:] == 0)
    branch = _poses(record, system, flat, real)
    shape = (*given.shape[:-1], system.degree)
    return SystemBranches(
        record=record,
        problem="direct",
        given=given,
        modes_asked=np.zeros((system.degree, len(record.modes.assembly)), dtype=np.int8),
        sign_shape=(system.degree,),
        branch=dataclasses.replace(branch, margins={ROOT.name: -gap.T, **branch.margins}),
        dropped=copy.reshape(shape),
        unsure=np.zeros(shape, dtype=bool),
        only=only,
        end=end.reshape(shape),
        infinite=infinite.reshape(shape),
    )


def ends(
    record: MechanismRecord, system: PolynomialSystem, inputs: FloatArray
) -> tuple[ComplexArray, NDArray[np.int8]]:
    """Ends (N, K, n) of all paths at inputs (N, m), the largest unknown 1, and what they are (N, K)."""
    start, solutions = start_system(record, system)
    own = np.broadcast_to(dimensions(record), (len(inputs), len(record.parameters)))
    joint = np.stack([item.joint_value(inputs[:, k]) for k, item in enumerate(record.inputs)], axis=-1)
    target = np.concatenate([own, joint / characteristic_length(record)], axis=1)
    found = solve(family(record, system, start, target), solutions)
    largest = np.take_along_axis(found.x, np.argmax(np.abs(found.x), axis=1)[:, None], axis=1)
    shape = (len(inputs), len(solutions))
    return (found.x / largest).reshape(*shape, -1), found.end.reshape(shape)


def _order(branch: Branch, gap: FloatArray) -> NDArray[np.intp]:
    """Places (N, K) of solutions: the real ones first, in the order of their poses."""
    keys = [np.round(border.scalar(value).T, 9) for value in branch.pose[::-1]]
    return np.lexsort((*keys, gap > 0), axis=-1)


def _poses(record: MechanismRecord, system: PolynomialSystem, inputs: FloatArray, x: FloatArray) -> Branch:
    """The branch at real unknowns (N, K, n); of a quaternion and its opposite the one with positive scalar."""
    components = border.input_components(record, inputs)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        branch = system.back(Floats(), kernel_dimensions(record), components, tuple(np.moveaxis(x, (2, 1), (0, 1))))
        if QUATERNION[0] in record.platform.pose:
            scalar = np.asarray(branch.pose[record.platform.pose.index(QUATERNION[0])])
            x = np.where(scalar.T[..., None] < 0, -x, x)
            branch = system.back(Floats(), kernel_dimensions(record), components, tuple(np.moveaxis(x, (2, 1), (0, 1))))
    return branch


def _system(record: MechanismRecord) -> PolynomialSystem:
    form = record.closed_form
    if form is None or not isinstance(form.direct, PolynomialSystem):
        raise AssertionError("no polynomial system")
    return form.direct
