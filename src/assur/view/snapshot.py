"""Snapshots: what is shown, one configuration, and how a change of an input, a coordinate or a dimension moves it.

Every change keeps the mode: it is followed (`assur.kinematics.following.following`), and where it cannot go on it stops
there and says why. Nothing here knows of a window.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import AssurError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import CLOSED, assemble, closure_error
from assur.kinematics.following.course import Prescribed, Turns
from assur.kinematics.following.following import follow
from assur.kinematics.following.locked import general_ranks
from assur.kinematics.home import home_values
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.view.dials import dials, pose_with, read
from assur.view.explain import Reason, explain
from assur.view.resizing import resized

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-5
"""Share of a change within which it stops before what stops it: what can be seen, and no more."""

OPEN = 1e-6
"""Joint values whose loops are open by more, in characteristic lengths, are no assembly."""

HELD: dict[Prescribed, str] = {"inputs": "with the inputs held", "poses": "with the pose held"}
"""What stays where a dimension changes, in the order in which it is tried."""


@dataclass(frozen=True, eq=False)
class Snapshot:
    """What is shown.

    Attributes:
        record: the mechanism with its dimensions.
        values: (n,) joint values, an assembly, in rad or lengths.
        reason: why the last change stopped short; None where it did not.
        ranks: those in general on this branch (`assur.kinematics.following.locked`); None where they are not known yet.
    """

    record: MechanismRecord
    values: FloatArray
    reason: Reason | None = None
    ranks: dict[str, int] | None = None

    @property
    def inputs(self) -> FloatArray:
        """Printed inputs (k,), in lengths and rad."""
        return inputs_of(self.record, self.values)

    @property
    def pose(self) -> FloatArray:
        """Pose (m,) of the platform, in lengths and rad."""
        return pose_of(self.record, self.values)

    @property
    def residual(self) -> float:
        """Closure error of the whole joint graph, in length units."""
        return float(closure_error(self.record, self.values))

    @property
    def modes(self) -> tuple[str, str]:
        """Working and assembly mode by the signs of the file; "" where it names none."""
        return mode_names(self.record, self.values)


def start(record: MechanismRecord) -> Snapshot:
    """The assembled home.

    >>> from assur.model.registry import load_record
    >>> start(load_record("fivebar")).pose.round(0) + 0.0
    array([  0., 224.])
    """
    return Snapshot(record, np.array(home_values(record)))


def with_input(snapshot: Snapshot, index: int, value: float) -> Snapshot:
    """One input moved to a printed value, in lengths or rad, the others held, the mode kept.

    >>> from assur.model.registry import load_record
    >>> moved = with_input(start(load_record("fivebar")), 0, 2.0)
    >>> float(moved.inputs[0].round(9)), moved.reason is None
    (2.0, True)
    """
    inputs = snapshot.inputs
    inputs[index] = value
    return to_inputs(snapshot, inputs)


def with_dial(snapshot: Snapshot, index: int, value: float) -> Snapshot:
    """One of `assur.view.dials.dials` of the platform moved to a value, in lengths or rad, the mode kept.

    >>> from assur.model.registry import load_record
    >>> moved = with_dial(start(load_record("fivebar")), 1, 400.0)
    >>> str(moved.reason).split("; ")[::2]
    ['serial singularity: A1, B1, P are collinear', 'leg1 is 112 mm too short, leg2 is 112 mm too short']
    """
    record = snapshot.record
    names = [dial.name for dial in dials(record)]
    targets = dict(zip(names, read(record, snapshot.values).tolist(), strict=True))
    return to_poses(snapshot, pose_with(record, {**targets, names[index]: value}))


def to_inputs(snapshot: Snapshot, inputs: ArrayLike) -> Snapshot:
    """Straight to printed inputs (k,)."""
    return _followed(snapshot, "inputs", np.asarray(inputs, dtype=float), "given")


def to_poses(snapshot: Snapshot, pose: ArrayLike) -> Snapshot:
    """Straight to a pose (m,)."""
    return _followed(snapshot, "poses", np.asarray(pose, dtype=float), "short")


def with_values(snapshot: Snapshot, values: ArrayLike) -> Snapshot:
    """Another assembly (n,), as of another mode. Errors: UsageError where its loops are open."""
    record, given = snapshot.record, np.asarray(values, dtype=float)
    if given.shape != snapshot.values.shape or not np.all(np.isfinite(given)):
        raise UsageError(f"{record.name} has {len(snapshot.values)} joint values, each a finite number")
    gap = float(closure_error(record, given))
    if gap > OPEN * characteristic_length(record):
        raise UsageError(f"{record.name}: these joint values are no assembly, a gap of {gap:.3g} {record.unit} remains")
    assembly = assemble(record, given, near=True)
    return Snapshot(record, assembly.values if bool(assembly.closed) else given)


def with_parameter(snapshot: Snapshot, name: str, value: float) -> Snapshot:
    """Another dimension, in the unit of the file: with the inputs held as far as both modes are kept, else the pose.

    Where neither can be, nothing changes, and the reason says at which dimension a mode ends.

    >>> from assur.model.registry import load_record
    >>> longer = with_parameter(start(load_record("fivebar")), "l1", 110.0)
    >>> longer.record.parameters["l1"].value, longer.residual < 1e-9
    (110.0, True)
    >>> print(with_parameter(longer, "l1", -1.0).reason)
    parameter 'l1' of fivebar (cranks) cannot be -1; allowed: a positive number in mm
    """
    ranks = _ranks(snapshot)
    ends = []
    for held in HELD:
        try:
            change = resized(snapshot.record, snapshot.values, name, value, held, ranks)
        except AssurError as error:
            return replace(snapshot, reason=Reason("dimension", error.message))
        if not change.why:
            return Snapshot(change.record, change.values)
        ends.append(f"{HELD[held]} it ends at {change.reached:.4g} ({change.why})")
    return replace(snapshot, reason=Reason("dimension", f"{name} = {value:g} leaves the mode: {', '.join(ends)}"))


def _followed(snapshot: Snapshot, prescribed: Prescribed, target: FloatArray, turns: Turns) -> Snapshot:
    record = snapshot.record
    present = snapshot.inputs if prescribed == "inputs" else snapshot.pose
    if np.max(np.abs(target - present)) <= CLOSED * characteristic_length(record):
        return replace(snapshot, reason=None)
    ranks = _ranks(snapshot)
    inputs, poses = (target if prescribed == kind else None for kind in ("inputs", "poses"))
    try:
        path = follow(
            record, snapshot.values, inputs=inputs, poses=poses, turns=turns, tolerance=TOLERANCE, largest_step=1.0,
            ranks=ranks,
        )  # fmt: skip
    except AssurError as error:
        return replace(snapshot, reason=Reason("input", error.message))
    return Snapshot(record, path.joints[-1], explain(path, target), ranks)


def _ranks(snapshot: Snapshot) -> dict[str, int]:
    """Ranks in general; a change that is followed keeps them, so that they are found once on a branch."""
    return general_ranks(snapshot.record, snapshot.values) if snapshot.ranks is None else snapshot.ranks
