"""Calibration: the dimensions and offsets of inputs with which measured poses agree best.

Least squares over all measurements, each pose solved again on the joint graph for the dimensions of every step. What no
measurement tells apart is held: of dimensions that act together the last ones keep their values. Measurements far
beside the others are named and left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import position
from assur.kinematics.closure import assemble
from assur.kinematics.pose import pose_of
from assur.kinematics.status import Status
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.calibration.identification import matrix_rank, reduced
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
STEPS, ENOUGH = 20, 1e-9
"""Steps at most, and the step, as a share of the characteristic length, after which there are no more."""
BESIDE = 5.0
"""Times the spread of the others by which a measurement is off that does not count."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """What measurements say, in the mechanism's unit and rad.

    Attributes:
        parameters: the dimensions as they fit best, and what is to be added to inputs.
        sigma: their standard deviations, of the spread that is left; those that are held are in `held`.
        held: what the measurements do not tell, or was to be held.
        before, after: roots of the mean squares of what is off, outliers left out.
        outliers: numbers of measurements that did not count, from 1.
    """

    parameters: Mapping[str, float]
    sigma: Mapping[str, float]
    held: tuple[str, ...]
    before: float
    after: float
    outliers: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class _Fit:
    """Measurements of a mechanism: printed inputs (N, n), names and values (N, k) of coordinates."""

    record: MechanismRecord
    inputs: FloatArray
    names: Sequence[str]
    measured: FloatArray

    def off(self, record: MechanismRecord, values: FloatArray) -> FloatArray:
        """What is measured less what the joint values (N, n) say (N, k)."""
        poses = dict(zip(record.platform.pose, pose_of(record, values).T, strict=True))
        return np.asarray(self.measured - np.array([poses[name] for name in self.names]).T)

    def near(self) -> FloatArray:
        """Joint values (N, n) with the file's dimensions: of all assemblies those next to what is measured."""
        chosen = []
        for number, (printed, row) in enumerate(zip(self.inputs, self.measured, strict=True), 1):
            answer = position.direct(self.record, printed)
            rows = np.flatnonzero(answer.exists)
            if not len(rows):
                raise UsageError(f"measurement {number}: no pose of {self.record.name} at these inputs")
            poses = answer.poses[rows][:, [self.record.platform.pose.index(name) for name in self.names]]
            chosen.append(answer.joints[rows[np.argmin(np.linalg.norm(poses - row, axis=1))]])
        return np.array(chosen)

    def solved(self, record: MechanismRecord, near: FloatArray, added: FloatArray) -> FloatArray:
        """Joint values (N, n) with other dimensions and `added` (n,) to the inputs."""
        start = near.copy()
        for place, item in enumerate(record.inputs):
            start[:, item.coordinate.index] = item.joint_value(self.inputs[:, place] + added[place])
        assembled = assemble(record, start, held=record.input_indices, near=True)
        if not assembled.closed.all():
            lost = int(np.argmin(assembled.closed)) + 1
            raise UsageError(f"measurement {lost} does not assemble on the way", hint="hold dimensions")
        return assembled.values


def calibration(
    record: MechanismRecord,
    inputs: FloatArray,
    names: Sequence[str],
    measured: FloatArray,
    hold: Sequence[str] = (),
) -> Calibration:
    """The best fit of measured coordinates (N, k) of the pose, by their names, at printed inputs (N, n).

    Errors:
        UsageError: a measurement that is no pose, too few of them, a coordinate that is no length of the pose.
        UnknownNameError: what is to be held is none of the parameters.
    """
    for name in names:
        if name not in LENGTHS or name not in record.platform.pose:
            own = [name for name in LENGTHS if name in record.platform.pose]
            raise UnknownNameError(f"measured length of {record.name}", name, own)
    every = np.arange(len(measured))
    fit = _Fit(record, inputs, names, measured)
    near = fit.near()
    first = fit.off(record, near)
    result, left = _fitted(fit, near, hold)
    spread = 1.4826 * float(np.median(np.linalg.norm(left, axis=1)))
    beside = np.linalg.norm(left, axis=1) > max(BESIDE * spread, 1e-9 * characteristic_length(record))
    if np.any(beside) and np.sum(~beside) * len(names) > len(result[0]):
        kept = every[~beside]
        result, left = _fitted(_Fit(record, inputs[kept], names, measured[kept]), near[kept], hold)
        first = first[kept]
    else:
        beside[:] = False
    parameters, sigma, held = result
    return Calibration(
        parameters=parameters,
        sigma=sigma,
        held=held,
        before=float(np.sqrt(np.mean(first**2))),
        after=float(np.sqrt(np.mean(left**2))),
        outliers=tuple(int(number) + 1 for number in every[beside]),
    )


def _fitted(
    fit: _Fit, near: FloatArray, hold: Sequence[str]
) -> tuple[tuple[dict[str, float], dict[str, float], tuple[str, ...]], FloatArray]:
    """Parameters, their deviations, what is held; and what is left (N, k)."""
    record, length = fit.record.without_closed_form, characteristic_length(fit.record)
    added = np.zeros(len(fit.record.inputs))
    inputs = [item.name for item in fit.record.inputs]
    values = near
    names: tuple[str, ...] = ()
    free: list[int] | None = None
    for _ in range(STEPS):
        names, slopes, scales = _slopes(record, values, fit.names, inputs)
        if free is None:
            free = _told(slopes * scales, names, hold)
        off = fit.off(record, values)
        step = np.zeros(len(names))
        step[free] = scales[free] * np.linalg.lstsq(slopes[:, free] * scales[free], off.ravel())[0]
        own = dict(zip(names, step, strict=True))
        added = added + [own[name] for name in inputs]
        sizes = {name: item.value + own.get(name, 0.0) for name, item in record.parameters.items()}
        wrong = [name for name, size in sizes.items() if name in own and not _allowed(record, name, size)]
        if wrong:  # a length that would be negative stays as it is
            return _fitted(fit, near, [*hold, *wrong])
        record = with_parameters(record, **sizes)
        values = fit.solved(record, values, added)
        if np.max(np.abs(step / scales)) <= ENOUGH * length:
            break
    left = fit.off(record, values)
    if free is None or left.size <= len(free):
        raise UsageError(
            f"{left.size} numbers are measured, {0 if free is None else len(free)} are unknown",
            hint="measure more poses",
        )
    names, slopes, scales = _slopes(record, values, fit.names, inputs)
    narrow = slopes[:, free] * scales[free]
    variance = float(np.sum(left**2)) / (left.size - len(free))
    deviations = scales[free] * np.sqrt(variance * np.diag(np.linalg.inv(narrow.T @ narrow)))
    now = {name: record.parameters[name].value if name in record.parameters else float(added[inputs.index(name)])
           for name in names}  # fmt: skip
    told = [names[k] for k in free]
    held = tuple(name for name in names if name not in told)
    sigma = dict(zip(told, map(float, deviations), strict=True))
    return ({name: now[name] for name in told}, sigma, held), left


def _allowed(record: MechanismRecord, name: str, size: float) -> bool:
    sign = record.parameters[name].sign
    return sign == "any" or size > 0.0 or (sign == "nonnegative" and size == 0.0)


def _slopes(
    record: MechanismRecord, values: FloatArray, coordinates: Sequence[str], inputs: Sequence[str]
) -> tuple[tuple[str, ...], FloatArray, FloatArray]:
    """Names, change (N k, p) of the measured coordinates, and what one is of each parameter."""
    rows: list[FloatArray] = []
    names: tuple[str, ...] = ()
    units: dict[str, str] = {}
    for number, joints in enumerate(values, 1):
        errors = pose_errors_at(record, joints)
        if errors.status != Status.regular:
            raise UsageError(f"measurement {number}: the inputs do not hold the platform")
        names = tuple(name for name in errors.sensitivity if "." not in name or name in inputs)
        units = dict(errors.units)
        whole = np.array([errors.sensitivity[name] for name in names]).T
        rows.append(whole[[LENGTHS.index(name) for name in coordinates]])
    turned = np.array([units[name] in ("rad", "deg") for name in names])
    return names, np.concatenate(rows), np.where(turned, 1.0 / characteristic_length(record), 1.0)


def _told(slopes: FloatArray, names: Sequence[str], hold: Sequence[str]) -> list[int]:
    """Columns that are told once the last of those that act together are held."""
    for name in hold:
        if name not in names:
            raise UnknownNameError("parameter to hold", name, names)
    free = [k for k, name in enumerate(names) if name not in hold]
    _, sizes, right = np.linalg.svd(slopes[:, free], full_matrices=True)
    _, pivots = reduced(right[matrix_rank(sizes) :])
    return [column for place, column in enumerate(free) if place not in pivots]
