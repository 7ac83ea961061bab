"""Where a platform settles whose links do not fit: the elastic structure with errors in its joints, under no load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure
from assur.machine.motion.joint_motion import at_point
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
CLOSED = 1e-9
"""What rigid loops leave open, as a share of the error, below which they close."""


def elastic_errors(record: MechanismRecord, values: FloatArray, twists: FloatArray) -> FloatArray:
    """Displacement, in the mechanism's unit, and rotation (6, k) of the platform at joint values (n,).

    NaN where the actuators do not hold it, and where rigid links alone do not fit.

    Args:
        record: the mechanism.
        values: (n,) of the joints.
        twists: (J, 6, k) of the joints' children against their parents: angular, then at the base's origin, in the
            mechanism's unit.

    Errors:
        UsageError: what `structure` refuses.

    Example: three limbs that are longer by one are that, whether links bend or not.

    >>> from assur.kinematics.home import home_values
    >>> from assur.machine.accuracy.geometry_errors import geometry_errors
    >>> from assur.model.registry import load_record
    >>> record = load_record("orthoglide")
    >>> errors = geometry_errors(record, home_values(record))
    >>> moved = elastic_errors(record, home_values(record), errors.twists[errors.names.index("L")][..., None])
    >>> (moved[:3, 0].round(6) + 0.0).tolist()
    [-1.0, -1.0, -1.0]
    """
    own = structure(record)
    state = strains(own, values[None])
    count = twists.shape[-1]
    metre, slices = METRES[record.unit], joint_graph(record).slices
    si = twists * np.repeat([1.0, metre], 3)[:, None]
    about = at_point(si, state.point[0], state.length)  # (J, 6, k)
    starts = [slices[name].start for name in record.joints]
    bodies = np.einsum("bj,jik->bik", own.paths[:, starts], about)
    first = np.zeros((own.unknowns, count))
    fits = np.full(count, bool(state.held[0]))
    if len(own.loops):
        closing = (own.loops[:, None] * state.screws[0]).reshape(-1, len(state.scales))
        gaps = np.einsum("lj,jik->lik", own.loops[:, starts], about).reshape(-1, count)
        first[own.coordinates] = -np.linalg.pinv(closing, rcond=CLOSED) @ gaps
        left = np.linalg.norm(closing @ first[own.coordinates] + gaps, axis=0)
        fits &= left <= CLOSED * np.linalg.norm(gaps, axis=0)
    ends = np.array([beam.bodies for beam in own.beams], dtype=int).reshape(-1, 2)
    strained = state.in_axes((bodies[ends[:, 1]] - bodies[ends[:, 0]])[None])[0]  # (E, 6, k)
    load = state.stiffness[0] @ first
    for beam, strain, initial in zip(own.beams, state.of_beams[0], strained, strict=True):
        stiffness = beam.beam.stiffness * state.units * state.units[:, None]
        load += strain.T @ stiffness @ initial
    moved = first - state.displaced(load[None])[0]
    platform = bodies[own.platform]
    shift = state.platform[0] @ moved + np.concatenate([state.length * platform[3:], platform[:3]])
    return np.where(fits, shift / np.repeat([metre, 1.0], 3)[:, None], np.nan)
