"""MuJoCo as a second opinion: the exported file loaded, put where our joint values say, and asked for its own numbers.

What is ours here ends with the file and the joint values. Frames, constraint rows, Jacobians and the steps of its
Newton iteration come from the engine.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError, extra_hint
from assur.export.bodies import Bodies, bodies
from assur.export.mjcf import mjcf, printed
from assur.export.names import link_name
from assur.joint_graph.frames import Frame
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, rate_names
from assur.numerics import rotations

FloatArray = NDArray[np.float64]

RANK_GAP = 1e-8
"""Singular values below this share of the largest count as zero."""

MOST_STEPS = 40
"""Of the engine's Newton iteration."""


@dataclass(frozen=True, eq=False)
class Engine:
    """A mechanism in MuJoCo. Its `data` is what the functions here set and read; lengths in m.

    Attributes:
        dofs: (n,) the degree of freedom of each input.
        units: (nv,) the size of each degree of freedom: the characteristic length for a slide, 1 for a turn.
        rows: what a constraint row is measured by, the characteristic length.
    """

    record: MechanismRecord
    bodies: Bodies
    mujoco: Any
    model: Any
    data: Any
    dofs: NDArray[np.intp]
    units: FloatArray

    @property
    def version(self) -> str:
        """Version of MuJoCo."""
        return str(self.mujoco.__version__)


def engine(record: MechanismRecord, text: str | None = None) -> Engine:
    """The exported mechanism in MuJoCo, at home; `text`: another MJCF file of it.

    Raises `UsageError` where MuJoCo is not installed.
    """
    try:
        import mujoco
    except ImportError as error:
        raise UsageError(f"MuJoCo cannot be loaded: {error}", hint=extra_hint("sim")) from error
    model = mujoco.MjModel.from_xml_string(mjcf(record) if text is None else text)
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
    dofs = [model.joint(record.coordinate_label(item.coordinate)).dofadr[0] for item in record.inputs]
    found = printed(record, bodies(record))
    slides = model.jnt_type[model.dof_jntid] == mujoco.mjtJoint.mjJNT_SLIDE
    units = np.where(slides, found.size, 1.0)
    return Engine(record, found, mujoco, model, mujoco.MjData(model), np.array(dofs, dtype=np.intp), units)


def put(engine: Engine, joint_values: FloatArray) -> None:
    """Set the engine's configuration from our joint values (n,), and let it compute positions and constraints."""
    for step in engine.bodies.steps.values():
        address = engine.model.joint(step.name).qposadr[0]
        if step.kind == "ball":
            quaternion = rotations.to_quaternion(step.rotation(joint_values))
            engine.data.qpos[address : address + 4] = quaternion
        else:
            engine.data.qpos[address] = step.value(joint_values)
    positions(engine)


def positions(engine: Engine) -> None:
    """Let the engine compute positions and constraints where it stands."""
    engine.mujoco.mj_fwdPosition(engine.model, engine.data)


def link_frames(engine: Engine) -> Mapping[str, Frame]:
    """Frame of every link in the base frame: orientation (3, 3) and origin (3,) in m."""
    found = {}
    for link in engine.record.links:
        body = engine.data.body(link_name(link))
        found[link] = (body.xmat.reshape(3, 3).copy(), body.xpos.copy())
    return found


def printed_inputs(engine: Engine) -> FloatArray:
    """The lengths (n,) of the actuators, in m and rad: the printed inputs here."""
    order = [engine.model.actuator(item.name).id for item in engine.record.inputs]
    lengths: FloatArray = engine.data.actuator_length[order]
    return lengths


def constraints(engine: Engine) -> tuple[FloatArray, FloatArray]:
    """Residual (r,) of the loops and its derivative (r, nv), in units of the characteristic length."""
    data, size = engine.data, engine.bodies.size
    rows = data.efc_type == engine.mujoco.mjtConstraint.mjCNSTR_EQUALITY
    jacobian = data.efc_J.reshape(-1, engine.model.nv)[rows]
    return data.efc_pos[rows] / size, jacobian * engine.units / size


def freedoms(engine: Engine) -> int:
    """Nullity of the constraint Jacobian: all freedoms, internal ones too."""
    _, jacobian = constraints(engine)
    return int(engine.model.nv - np.linalg.matrix_rank(jacobian, rtol=RANK_GAP))


def platform_jacobian(engine: Engine) -> tuple[FloatArray, float, float]:
    """Rates (k, n) of the pose per rate of each printed input, what they miss, and what they leave open.

    Lengths count in units of the characteristic length. The second number is the part of the constraints that no
    motion with these input rates can satisfy, the third the largest rate of the pose with every input locked.
    """
    _, jacobian = constraints(engine)
    free = np.setdiff1d(np.arange(engine.model.nv), engine.dofs)
    signs = np.array([item.sign for item in engine.record.inputs])
    driven = jacobian[:, engine.dofs] * signs  # (r, n)
    inverse = np.linalg.pinv(jacobian[:, free], rcond=RANK_GAP)
    moves = np.zeros((engine.model.nv, len(signs)))
    moves[free], moves[engine.dofs] = -inverse @ driven, np.diag(signs)
    rates = pose_rates(engine) * engine.units  # (k, nv)
    locked = rates[:, free] @ (np.eye(len(free)) - inverse @ jacobian[:, free])
    missed = float(np.max(np.abs(jacobian @ moves), initial=0.0))
    return rates @ moves, missed, float(np.max(np.abs(locked), initial=0.0))


def pose_rates(engine: Engine) -> FloatArray:
    """Rates (k, nv) of the pose per rate of each degree of freedom, lengths in the characteristic length."""
    record, model, data = engine.record, engine.model, engine.data
    body = data.body(link_name(record.platform.link))
    rotation = body.xmat.reshape(3, 3)
    point = body.xpos + rotation @ (engine.bodies.metre * record.platform.point)
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    engine.mujoco.mj_jac(model, data, linear, angular, point, body.id)
    named = dict(zip((*LENGTHS, "wx", "wy", "wz"), (*(linear / engine.bodies.size), *angular), strict=True))
    if any(name in ANGLES for name in record.platform.pose):
        named |= zip(ANGLES, np.linalg.solve(_turning(rotation), angular), strict=True)
    return np.stack([named[name] for name in rate_names(record.platform.pose)])


def _turning(rotation: FloatArray) -> FloatArray:
    """Angular velocities (3, 3), in columns, of the rates of phi, theta, psi: about z, the turned y, the turned x."""
    level = np.array([-rotation[1, 0], rotation[0, 0], 0.0])
    return np.stack([np.array([0.0, 0.0, 1.0]), level / np.linalg.norm(level), rotation[:, 0]], axis=1)


def settle(engine: Engine, push: FloatArray) -> bool:
    """Push every degree of freedom but the inputs by (nv,), then close the loops by Newton with inputs locked.

    Returns whether it closed; the engine stands where it ended.
    """
    free = np.setdiff1d(np.arange(engine.model.nv), engine.dofs)
    step = np.zeros(engine.model.nv)
    step[free] = push[free] * engine.units[free]
    for _ in range(MOST_STEPS):
        engine.mujoco.mj_integratePos(engine.model, engine.data.qpos, step, 1.0)
        positions(engine)
        residual, jacobian = constraints(engine)
        change = np.linalg.lstsq(jacobian[:, free], -residual, rcond=RANK_GAP)[0]
        step[free] = change * engine.units[free]
        if np.max(np.abs(residual), initial=0.0) < 1e-13 or np.max(np.abs(change), initial=0.0) < 1e-14:
            break
    return bool(np.max(np.abs(residual), initial=0.0) < 1e-11)
