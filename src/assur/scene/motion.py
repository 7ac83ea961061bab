"""A closed motion from home and back, in one mode: every input swings, each a little behind the one before.

It is followed from frame to frame, so that no frame stands in another mode; where it cannot be followed, or a limit of
the file is passed, all swings are made smaller.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.following.course import course
from assur.kinematics.following.following import walked
from assur.kinematics.following.locked import general_ranks
from assur.kinematics.following.ranks import RankGuard
from assur.kinematics.following.stepping import Pace
from assur.kinematics.home import home_values
from assur.kinematics.limits import limits
from assur.kinematics.near_home import distances
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SWING, SLIDE = 0.8, 0.4
"""Swing of an input that is tried first, from end to end: in rad, and of a slide in characteristic lengths."""

SMALLER, TIMES = 0.7, 16
"""What the swings are multiplied by where a motion is stopped, and how often."""

SHORTEST = 0.25
"""Steps between two frames are a quarter of the way at least: what needs shorter ones is nearly singular."""

ROUND, SAME = 1e-6, 1e-6
"""By how much, in rad or lengths, a limit may be passed; and how far from home, in characteristic lengths, home is."""


def closed_motion(record: MechanismRecord, frames: int = 60) -> FloatArray:
    """Joint values (frames + 1, n) of a closed motion through home, the mode kept; inputs end where they began.

    What the inputs do not hold, as the spin of a rod between two ball joints, may end a little off.

    Errors: `UsageError` for fewer than 8 frames, and where not even a small swing is possible.

    >>> from assur.model.registry import load_record
    >>> found = closed_motion(load_record("fivebar"), 12)
    >>> found.shape, bool(np.allclose(found[0], found[-1], atol=1e-9))
    ((13, 5), True)
    """
    if frames < 8:
        raise UsageError(f"closed_motion: {frames} frames; at least 8")
    home = home_values(record)
    ranks = general_ranks(record, home)
    for k in range(TIMES):
        inputs = inputs_of(record, home) + SMALLER**k * _swing(record, frames)
        values = _run(record, home, inputs, ranks)
        if values is not None:
            return values
    raise UsageError(
        f"{record.name}: no closed motion of all inputs from home, not even a small one",
        hint=f"see what is singular or limited at home: assur show {record.name}",
    )


def _run(record: MechanismRecord, home: FloatArray, inputs: FloatArray, ranks: dict[str, int]) -> FloatArray | None:
    """Joint values (k, n) at inputs (k, n), followed from the first; None where a frame is out of the mode."""
    way, guard = course(record, "inputs", inputs[0], inputs[1:], "given"), RankGuard("inputs", lambda *_: (), ranks)
    if not walked(record, way, home, guard, Pace(SHORTEST / len(inputs))):
        return None
    places = np.searchsorted([point.share for point in guard.points], way.shares)
    values = np.array([guard.points[k].joints for k in places])
    if len(values) < len(inputs) or any(np.min(limit.margin(values)) < -ROUND for limit in limits(record, home)):
        return None
    # inputs may come home with another pose, round a cusp
    return values if float(distances(record, values[-1:])[0]) <= SAME else None


def _swing(record: MechanismRecord, frames: int) -> FloatArray:
    """How far the inputs (frames + 1, n) are from home: sines that begin at zero, each with its own phase."""
    length = characteristic_length(record)
    size = np.array([SWING if actuated.coordinate.kind == "angle" else SLIDE * length for actuated in record.inputs])
    phase = np.pi * np.arange(len(size)) / len(size)
    turn = 2 * np.pi * np.arange(frames + 1) / frames
    swings = size * (np.sin(turn[:, None] + phase) - np.sin(phase)) / 2
    swings[-1] = 0.0
    return np.asarray(swings)
