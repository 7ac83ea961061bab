"""Random assembled configurations of the joint graph, and a random motion through each of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.border import in_range
from assur.kinematics.closure import assemble, closure_jacobian
from assur.kinematics.home import home_values
from assur.kinematics.modes import all_modes
from assur.kinematics.position import inverse
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
COUNT = 60
DRAWN = 600
SHAKE = 1e-2
STARTS = 600
AROUND = 3.0


@dataclass(frozen=True, eq=False)
class Configurations:
    """N regular configurations near which the closed form says that there is one, closed by the joint graph.

    Attributes:
        values: (N, n) joint values, closed by least squares on every loop.
        rates: (N, n) joint rates with which all loops stay closed, drawn from their null space; angles turn
            at about 1 rad, lengths move at about the characteristic length per unit of time.
        modes: the working mode of each.
    """

    values: FloatArray
    rates: FloatArray
    modes: tuple[str, ...]


@lru_cache(maxsize=8)
def configurations(record: MechanismRecord, seed: int = 0) -> Configurations:
    """The configurations on which equations and ranks are tried, in all working modes that are regular there.

    The closed form says only where to start: its joint values are shaken by about a hundredth of a radian
    and of the characteristic length, and the loops of the joint graph are closed anew.

    >>> from assur.model.registry import load_record
    >>> configurations(load_record("zeng2019")).values.shape
    (60, 17)
    """
    rng = np.random.default_rng(seed)
    poses = random_poses(record, DRAWN, rng)
    solutions = inverse(record, poses)
    rows, branches = np.nonzero(solutions.exists & (solutions.status == Status.regular))
    if len(rows) < COUNT:
        raise UsageError(f"{record.name}: no {COUNT} regular configurations were found near home")
    chosen = rng.choice(len(rows), size=COUNT, replace=False)
    rows, branches = rows[chosen], branches[chosen]
    start = solutions.joints[rows, branches]
    closed = assemble(record, start + rng.normal(size=start.shape) * SHAKE * joint_scales(record))
    kept = closed.closed
    values = closed.values[kept]
    names = all_modes(record, "inverse")
    modes = [names[branch] for branch in branches[kept]]
    return Configurations(values, _motions(record, values, rng), tuple(modes))


def random_poses(record: MechanismRecord, count: int, rng: np.random.Generator) -> FloatArray:
    """Poses (count, m) around the home pose, lengths within three characteristic lengths, angles at will."""
    placed = frames(record, home_values(record))[record.platform.link]
    point = placed[0] @ record.platform.point + placed[1]
    length = AROUND * characteristic_length(record)
    columns = []
    for name in record.platform.pose:
        if name in ("x", "y", "z"):
            columns.append(point["xyz".index(name)] + rng.uniform(-length, length, count))
        else:
            columns.append(rng.uniform(-np.pi, np.pi, count))
    return in_range(record, np.stack(columns, axis=-1))


@lru_cache(maxsize=8)
def random_assemblies(record: MechanismRecord, inputs: tuple[float, ...], seed: int = 0) -> FloatArray:
    """Joint values (N, n) of assemblies of the whole joint graph at given inputs, from random starts.

    Nothing but the loop closure is asked, so that assemblies which the closed form leaves out are found too;
    that all are found is not certain.
    """
    rng = np.random.default_rng(seed)
    start = rng.uniform(-np.pi, np.pi, size=(STARTS, len(record.coordinates))) * joint_scales(record)
    start[:, record.input_indices] = inputs
    assemblies = assemble(record, start, held=record.input_indices)
    return np.asarray(assemblies.values[assemblies.closed])


def null_space(matrix: FloatArray, relative: float = 1e-8) -> FloatArray:
    """Orthonormal basis (n, F) of the null space of a matrix (r, n).

    >>> null_space(np.array([[1.0, 0.0], [2.0, 0.0]])).T.round(6) + 0.0
    array([[0., 1.]])
    """
    _, singular, rows = np.linalg.svd(matrix)
    rank = int(np.sum(singular > relative * max(singular[0], np.finfo(float).tiny)))
    return np.asarray(rows[rank:].T)


def scaled_closure(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Closure Jacobian (..., 6v, n) in numbers of one size: lengths in units of the characteristic length."""
    return np.asarray(closure_jacobian(record, values) * joint_scales(record))


def freedoms_with_inputs_locked(record: MechanismRecord, values: FloatArray, threshold: float = 1e-7) -> int:
    """Freedoms that the joint graph keeps at joint values (n,) when every input is locked: 0 where regular."""
    matrix = scaled_closure(record, values)
    free = [index for index in range(matrix.shape[-1]) if index not in record.input_indices]
    singular = np.linalg.svd(matrix[:, free], compute_uv=False)
    return len(free) - int(np.sum(singular > threshold * singular[0]))


def _motions(record: MechanismRecord, values: FloatArray, rng: np.random.Generator) -> FloatArray:
    """A random direction (N, n) in which the loops stay closed, at each configuration."""
    scales = joint_scales(record)
    rates = []
    for matrix in scaled_closure(record, values):
        basis = null_space(matrix)
        rates.append(scales * (basis @ rng.normal(size=basis.shape[1])))
    return np.array(rates)
