"""What is shown: one configuration, and how a change of an input, a coordinate or a dimension moves it.

Every change keeps the mode: it is followed (`assur.kinematics.paths.following`), and where it cannot go on the state
stops there and says why. Nothing here knows of a window.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import AssurError, UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import CLOSED, assemble, characteristic_length, closure_error
from assur.kinematics.home import home_values
from assur.kinematics.paths.course import Prescribed
from assur.kinematics.paths.following import follow, mode_names
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.registry import with_parameters
from assur.view.dials import dials, pose_with, read
from assur.view.explain import Reason, explain

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-5
"""Share of a change within which it stops before what stops it: what can be seen, and no more."""

OPEN = 1e-6
"""Joint values whose loops are open by more, in characteristic lengths, are no assembly."""

PARTS = 8
"""A dimension that cannot be changed at once is changed in so many parts."""


@dataclass(frozen=True, eq=False)
class State:
    """What is shown.

    Attributes:
        record: the mechanism with its dimensions.
        values: (n,) joint values, an assembly, in rad or lengths.
        reason: why the last change stopped short; None where it did not.
    """

    record: MechanismRecord
    values: FloatArray
    reason: Reason | None = None

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


def start(record: MechanismRecord) -> State:
    """The assembled home.

    >>> from assur.model.registry import load_record
    >>> start(load_record("fivebar")).pose.round(0) + 0.0
    array([  0., 224.])
    """
    return State(record, np.array(home_values(record)))


def with_input(state: State, index: int, value: float) -> State:
    """One input moved to a printed value, in lengths or rad, the others held, the mode kept.

    >>> from assur.model.registry import load_record
    >>> moved = with_input(start(load_record("fivebar")), 0, 2.0)
    >>> float(moved.inputs[0].round(9)), moved.reason is None
    (2.0, True)
    """
    wanted = state.inputs
    wanted[index] = value
    return to_inputs(state, wanted)


def with_dial(state: State, index: int, value: float) -> State:
    """One of `assur.view.dials.dials` of the platform moved to a value, in lengths or rad, the mode kept.

    >>> from assur.model.registry import load_record
    >>> moved = with_dial(start(load_record("fivebar")), 1, 400.0)
    >>> str(moved.reason)
    'serial singularity: A1, B1, P are collinear; A2, B2, P are collinear; leg1 is 112 mm too short'
    """
    item = dials(state.record)[index]
    wanted = {
        name: float(here) for name, here in zip(_names(state.record), read(state.record, state.values), strict=True)
    }
    return to_poses(state, pose_with(state.record, {**wanted, item.name: value}))


def to_inputs(state: State, inputs: ArrayLike) -> State:
    """Straight to printed inputs (k,)."""
    return _followed(state, "inputs", np.asarray(inputs, dtype=float), "given")


def to_poses(state: State, pose: ArrayLike) -> State:
    """Straight to a pose (m,)."""
    return _followed(state, "poses", np.asarray(pose, dtype=float), "short")


def with_values(state: State, values: ArrayLike) -> State:
    """Another assembly (n,), as of another mode. Errors: UsageError where its loops are open."""
    given = np.asarray(values, dtype=float)
    if given.shape != state.values.shape or not np.all(np.isfinite(given)):
        raise UsageError(f"{state.record.name} has {len(state.values)} joint values, each a finite number")
    gap = float(closure_error(state.record, given))
    if gap > OPEN * characteristic_length(state.record):
        raise UsageError(
            f"{state.record.name}: these joint values are no assembly, a gap of {gap:.3g} {state.record.unit} remains"
        )
    found = assemble(state.record, given, near=True)
    return State(state.record, found.values if bool(found.closed) else given)


def with_parameter(state: State, name: str, value: float) -> State:
    """Another dimension, in the unit of the file, the mode kept: the inputs held where that closes, else the pose.

    >>> from assur.model.registry import load_record
    >>> longer = with_parameter(start(load_record("fivebar")), "l1", 110.0)
    >>> longer.record.parameters["l1"].value, longer.residual < 1e-9
    (110.0, True)
    >>> print(with_parameter(longer, "l1", -1.0).reason)
    parameter 'l1' of fivebar (cranks) cannot be -1; allowed: a positive number in mm
    """
    try:
        changed = with_parameters(state.record, **{name: value})
    except AssurError as error:
        return replace(state, reason=Reason("dimension", error.message))
    for held in ("inputs", "poses"):
        values = _carried(state, name, value, held)
        if values is not None:
            return State(changed, values)
    why = f"{name} = {value:g}: the loops do not close in this mode"
    return replace(state, reason=Reason("dimension", why))


def _carried(state: State, name: str, value: float, held: str) -> FloatArray | None:
    """Joint values (n,) with the changed dimension, followed in parts; None where a loop opens or the mode changes."""
    before = state.record.parameters[name].value
    for parts in (1, PARTS):
        values: FloatArray | None = state.values
        for share in np.arange(1, parts + 1) / parts:
            try:
                record = with_parameters(state.record, **{name: before + float(share) * (value - before)})
            except AssurError:
                values = None
            values = None if values is None else _closed(record, values, state, held)
            if values is None:
                break
        if values is not None and mode_names(record, values) == state.modes:
            return values
    return None


def _closed(record: MechanismRecord, values: FloatArray, state: State, held: str) -> FloatArray | None:
    if held == "inputs":
        found = assemble(record, values, held=record.input_indices, near=True)
    else:
        found = assemble(record, values, poses=state.pose, near=True)
    return found.values if bool(found.closed) else None


def _followed(state: State, prescribed: Prescribed, wanted: FloatArray, turns: str) -> State:
    record = state.record
    here = state.inputs if prescribed == "inputs" else state.pose
    if np.max(np.abs(wanted - here)) <= CLOSED * characteristic_length(record):
        return replace(state, reason=None)
    asked = {"inputs" if prescribed == "inputs" else "poses": wanted}
    try:
        path = follow(record, state.values, turns=turns, tolerance=TOLERANCE, largest_step=1.0, **asked)  # type: ignore[arg-type]
    except AssurError as error:
        return replace(state, reason=Reason("input", error.message))
    return State(record, path.joints[-1], explain(path, wanted))


def _names(record: MechanismRecord) -> tuple[str, ...]:
    return tuple(item.name for item in dials(record))
