"""Motion and force transmission: how well each input drives its limb, and how well the limb drives the platform.

Of input i with the transmission wrench W_i: the input transmission index is the power coefficient of W_i and the twist
of the driven joint; the output transmission index is that of W_i and the platform's twist T_i where all other inputs
are locked. The local transmission index is the least of all; from sin 45 deg = 0.7 on, transmission is called good
(Wang, Wu and Liu 2010, see `assur.performance.power`). All lie between 0 and 1 and depend on no frame and no unit.

W_i is found on the whole joint graph (see `assur.performance.statics`): reciprocal to all passive joints of the limb.
The characteristic points are the joint by which the limb holds the platform, and the one after the driven link; of
several, their centre, each counted by the wrench that it passes. A platform of which the pose tells the place of a
point alone is that point, driven by a force through it.

In a hybrid chain with several inputs the branches of the slack ones share the load across the driven joint: there the
input index is of what passes this joint. The output index does not depend on how.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.border import checked_joints
from assur.kinematics.closure import CLOSED, closure_error
from assur.model.mechanism import MechanismRecord
from assur.performance.power import power_coefficient
from assur.performance.statics import Transmitted, is_point, transmitted

FloatArray = NDArray[np.float64]
BLOCK = 512
GOOD = 0.7
"""From this local transmission index on, transmission is called good: sin 45 deg as the paper rounds it."""


@dataclass(frozen=True, eq=False)
class Transmission:
    """Transmission indices at configurations (...), each between 0 and 1; NaN where there is no configuration.

    Attributes:
        inputs: (..., F) input transmission index of each input; 0 where it cannot push.
        outputs: (..., F) output transmission index of each input; 0 where it cannot move alone.
    """

    inputs: FloatArray
    outputs: FloatArray

    @property
    def local(self) -> FloatArray:
        """The local transmission index (...): the least of all."""
        return np.asarray(np.minimum(np.min(self.inputs, axis=-1), np.min(self.outputs, axis=-1)))

    @property
    def good(self) -> NDArray[np.bool_]:
        """Whether transmission is good (...)."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self.local >= GOOD)


def transmission_at(record: MechanismRecord, joints: ArrayLike) -> Transmission:
    """Transmission indices at joint values (..., n), of any mechanism; NaN where they do not close the loops.

    Example: the output transmission index of a five-bar is the sine of the angle between its rods.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)  # A1, A2, B1, B2, P
    >>> bool(np.allclose(transmission_at(record, home).outputs, np.abs(np.sin(home[4])), rtol=0, atol=1e-9))
    True
    """
    values = checked_joints(record, joints)
    flat = values.reshape(-1, values.shape[-1])
    closed = closure_error(record, flat) <= CLOSED * characteristic_length(record)
    inputs, outputs = (np.full((len(flat), len(record.inputs)), np.nan) for _ in range(2))
    rows = np.flatnonzero(closed)
    for start in range(0, len(rows), BLOCK):
        block = rows[start : start + BLOCK]
        passed = transmitted(record, flat[block])
        inputs[block], outputs[block] = _inputs(record, passed), _outputs(record, passed)
    shape = (*values.shape[:-1], len(record.inputs))
    return Transmission(inputs.reshape(shape), outputs.reshape(shape))


def _inputs(record: MechanismRecord, transmitted: Transmitted) -> FloatArray:
    """Input transmission indices (N, F)."""
    names = list(record.joints)
    coefficients = np.zeros(transmitted.pushes.shape)
    for k, (driven, after) in enumerate(zip(record.inputs, _after(record), strict=True)):
        wrench = transmitted.wrenches[:, k, names.index(driven.coordinate.joint)]
        coefficients[:, k] = power_coefficient(wrench, transmitted.input_twists[:, k], _centre(transmitted, k, after))
    return np.where(transmitted.pushes, coefficients, 0.0)


def _outputs(record: MechanismRecord, transmitted: Transmitted) -> FloatArray:
    """Output transmission indices (N, F)."""
    coefficients = np.zeros(transmitted.moves.shape)
    at_platform = _joints_of(record, record.platform.link)
    for k in range(len(record.inputs)):
        centre = (
            np.zeros_like(transmitted.at_platform[:, k, 3:])
            if is_point(record)
            else _centre(transmitted, k, at_platform)
        )
        coefficients[:, k] = power_coefficient(transmitted.at_platform[:, k], transmitted.twists[:, k], centre)
    return np.where(transmitted.moves, coefficients, 0.0)


def _centre(transmitted: Transmitted, index: int, joints: tuple[int, ...]) -> FloatArray:
    """Centre (N, 3) of some joints, each counted by the wrench that passes through it when an input pushes."""
    chosen = list(joints)
    about = transmitted.wrenches[:, index, chosen].copy()
    about[..., :3] -= np.cross(transmitted.centres[:, chosen], about[..., 3:])
    weights = np.linalg.norm(about, axis=-1)
    total = np.maximum(np.sum(weights, axis=-1, keepdims=True), np.finfo(float).tiny)
    return np.asarray(np.einsum("nj,nja->na", weights / total, transmitted.centres[:, chosen]))


@lru_cache(maxsize=64)
def _after(record: MechanismRecord) -> tuple[tuple[int, ...], ...]:
    """Per input, the joints by which the driven link, of the two the one farther from the base, passes the push on."""
    depth = {link: len(path) for link, path in joint_graph(record).paths.items()}
    places = []
    for driven in record.inputs:
        joint = record.joints[driven.coordinate.joint]
        link = max(joint.child, joint.parent, key=lambda name: depth[name])
        own = list(record.joints).index(joint.name)
        places.append(tuple(place for place in _joints_of(record, link) if place != own))
    return tuple(places)


def _joints_of(record: MechanismRecord, link: str) -> tuple[int, ...]:
    """Places of the joints that a link has."""
    return tuple(k for k, joint in enumerate(record.joints.values()) if link in (joint.parent, joint.child))
