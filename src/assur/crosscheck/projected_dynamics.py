"""Forces of actuators by an engine's own mass matrix, bias and constraint Jacobian, projected on what closes the loops.

The engine itself cannot tell them: where constraints hold a mechanism, its inverse dynamics gives them the forces.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.crosscheck import engine as engines
from assur.crosscheck.engine import Engine
from assur.export.bodies import CARRIER_INERTIA
from assur.export.names import link_name
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names

FloatArray = NDArray[np.float64]
STEP = 1e-4
"""Seconds on either side at which, and at twice of which, Jacobians are compared."""
NULL = 1e-8
"""Singular values below this share of the largest count as zero."""


@dataclass(frozen=True, eq=False)
class BareBodies:
    """The bodies of an engine as the file has them: without what the export adds, and without constraints.

    The engine would not divide by such a mass matrix, and is not asked to.
    """

    mujoco: Any
    model: Any
    data: Any

    def mass_matrix(self, place: FloatArray) -> FloatArray:
        """(nv, nv) where the engine's own coordinates are `place`."""
        self.data.qpos[:] = place
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_comPos(self.model, self.data)
        self.mujoco.mj_crb(self.model, self.data)
        columns = np.zeros((self.model.nv, self.model.nv))
        for column, unit in zip(columns, np.eye(self.model.nv), strict=True):
            self.mujoco.mj_mulM(self.model, self.data, column, unit)
        return columns

    def bias(self, velocity: FloatArray) -> FloatArray:
        """Centrifugal forces, and gravity (nv,), where the mass matrix was asked for last."""
        self.data.qvel[:] = velocity
        self.mujoco.mj_comVel(self.model, self.data)
        forces = np.zeros(self.model.nv)
        self.mujoco.mj_rne(self.model, self.data, 0, forces)
        return forces


def bare_bodies(engine: Engine) -> BareBodies:
    """Without what carriers weigh, and without some inertia of each body."""
    model, links = copy.copy(engine.model), {link_name(link) for link in engine.record.links}
    added = CARRIER_INERTIA * engine.bodies.size**2
    for number in range(1, model.nbody):
        if model.body(number).name in links:
            model.body_inertia[number] -= added
        else:
            model.body_mass[number], model.body_inertia[number] = 0.0, 0.0
    return BareBodies(engine.mujoco, model, engine.mujoco.MjData(model))


def projected_forces(
    record: MechanismRecord,
    engine: Engine,
    own: BareBodies,
    joints: FloatArray,
    motion: tuple[FloatArray, FloatArray],
    wrench: FloatArray,
) -> FloatArray:
    """Forces (d,) of drives at joint values (n,) of ours, under the engine's gravity; of too many those of least norm.

    Args:
        record: whose drives exert them.
        engine: what closes the loops.
        own: what weighs.
        joints: (n,) joint values.
        motion: velocity and acceleration (k,) of the pose, in SI units.
        wrench: (6,) force and moment on the platform at its point.
    """
    model = engine.model
    velocity, acceleration = motion
    engines.put(engine, joints)
    matrix = own.mass_matrix(engine.data.qpos)
    rows, count = _rows(engine)
    scaled = rows * engine.units
    idle = engine.units[:, None] * _null_space(scaled)
    held = np.concatenate([scaled, idle.T @ matrix * engine.units])  # what nothing drives moves with the least energy

    def moves(of_rows: FloatArray, of_idle: FloatArray) -> FloatArray:
        goal = np.concatenate([of_rows, of_idle])
        return np.asarray(engine.units * np.linalg.lstsq(held, goal, rcond=1e-10)[0])

    speed = moves(np.concatenate([np.zeros(count), velocity]), np.zeros(idle.shape[1]))
    turning = _rates_of_rows(engine, speed) @ speed
    passive = own.bias(speed) - _pushed(engine, wrench)
    second = moves(np.concatenate([np.zeros(count), acceleration]) - turning, -idle.T @ passive)
    free = engine.units[:, None] * _null_space(scaled[:count])
    dofs = [model.joint(record.coordinate_label(item.coordinate)).dofadr[0] for item in record.drives]
    signs = np.array([item.sign for item in record.drives])
    needed = free.T @ (matrix @ second + passive)
    return np.asarray(np.linalg.lstsq(free[dofs].T * signs, needed, rcond=1e-10)[0])


def _rows(engine: Engine) -> tuple[FloatArray, int]:
    """Rates (r + k, nv) of the loops and of the pose per velocity, in SI units; and how many are of the loops."""
    size = engine.bodies.size
    loops = engines.constraints(engine)[1] / engine.units
    lengths = np.array([size if name in LENGTHS else 1.0 for name in rate_names(engine.record.platform.pose)])
    return np.concatenate([loops, engines.pose_rates(engine) * lengths[:, None]]), len(loops)


def _rates_of_rows(engine: Engine, velocity: FloatArray) -> FloatArray:
    """How fast the rows change, to the fourth order."""
    near, far = (_rows_after(engine, velocity, h) - _rows_after(engine, velocity, -h) for h in (STEP, 2 * STEP))
    return np.asarray((8 * near - far) / (12 * STEP))


def _rows_after(engine: Engine, velocity: FloatArray, seconds: float) -> FloatArray:
    start = engine.data.qpos.copy()
    engine.mujoco.mj_integratePos(engine.model, engine.data.qpos, velocity, seconds)
    engines.positions(engine)
    moved, _ = _rows(engine)
    engine.data.qpos[:] = start
    engines.positions(engine)
    return moved


def _pushed(engine: Engine, wrench: FloatArray) -> FloatArray:
    """A wrench on the platform per velocity (nv,)."""
    body = engine.data.body(link_name(engine.record.platform.link))
    point = body.xpos + body.xmat.reshape(3, 3) @ (engine.bodies.metre * engine.record.platform.point)
    platform = np.zeros((2, 3, engine.model.nv))
    engine.mujoco.mj_jac(engine.model, engine.data, *platform, point, body.id)
    return np.asarray(np.einsum("akv,ak->v", platform, np.reshape(wrench, (2, 3))))


def _null_space(matrix: FloatArray) -> FloatArray:
    _, sizes, right = np.linalg.svd(matrix)
    return np.asarray(right[int(np.sum(sizes > NULL * np.max(sizes, initial=0.0))) :].T)
