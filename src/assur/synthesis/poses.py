"""A limb at random poses of the required motion, as twists: the second route's data, computed once for each limb.

Links have random lengths and joints random values, subject to one thing only: the platform is turned as the
required motion says. Where a limb stands on the base is free, so each can be put at a common pose of the platform,
and limbs that were computed apart can be joined.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.least_squares import IndexArray, minimise
from assur.numerics.rotations import about_axis, to_vector
from assur.topology.chains import Chain, ChainJoint, Parallelogram
from assur.topology.screws.edges import rank

FloatArray = NDArray[np.float64]

SPREAD = 0.8
"""Joints turn by up to this many rad from the configuration as written before the platform is brought to its pose."""

TOLERANCE = 1e-12
TRIES = 4
"""Random starts for each pose."""

_Step = tuple[str, FloatArray]
"""An elementary motion: "R", "P", "A" (a P(4R)) with its axis (3,), or "link" (a link of random length)."""


def twists_at_poses(chain: Chain, orientations: FloatArray, generator: np.random.Generator) -> FloatArray | None:
    """Twists (N, 6, f) of a limb at N poses of its platform, columns (omega, v at the base's origin) in the base frame.

    Args:
        chain: R, P, C, U, S and P(4R) in series.
        orientations: (N, 3, 3) of the platform, near the one as written.
        generator: of the links' lengths and the joints' values.

    Returns:
        None where the limb does not reach these orientations.

    Errors:
        UsageError: a joint of another type.

    Example: the twists of R‖R‖R have rank 3.

    >>> from assur.topology.notation import parse_chains
    >>> (chain,) = parse_chains(["R[z] R[z] R[z]"])
    >>> found = twists_at_poses(chain, np.broadcast_to(np.eye(3), (2, 3, 3)), np.random.default_rng(1))
    >>> found.shape, np.linalg.matrix_rank(found).tolist()
    ((2, 6, 3), [3, 3])
    """
    steps = _steps(chain)
    axes = [axis for kind, axis in steps if kind == "R"]
    angles = _angles(axes, orientations, generator)
    return None if angles is None else _twists(steps, angles, generator)


def is_special(chain: Chain) -> bool:
    """Whether the limb as written has fewer independent freedoms than when it is displaced.

    >>> from assur.topology.notation import parse_chain
    >>> is_special(parse_chain("P[x] R[z] P[x]")), is_special(parse_chain("P[x] R[z] P[y]"))
    (True, False)
    """
    steps = _steps(chain)
    turns = sum(kind == "R" for kind, _ in steps)
    generator = np.random.default_rng(turns)
    written, displaced = np.zeros((1, turns)), generator.uniform(-SPREAD, SPREAD, (1, turns))
    at_home, away = (rank(_twists(steps, angles, generator)) for angles in (written, displaced))
    return at_home < away


def _steps(chain: Chain) -> list[_Step]:
    steps: list[_Step] = []
    for element in chain.elements:
        steps.append(("link", np.zeros(3)))
        if isinstance(element, Parallelogram) and element.kind == "4R":
            steps.append(("A", np.array(element.axis)))
        elif isinstance(element, ChainJoint) and not element.point and element.type.letter in _ELEMENTARY:
            axes = np.array(element.axes) if element.axes else np.eye(3)
            steps += [(kind, axes[place]) for kind, place in _ELEMENTARY[element.type.letter]]
        else:
            raise UsageError("only R, P, C, U, S and P(4R) without points in common can be placed here")
    return [*steps, ("link", np.zeros(3))]


_ELEMENTARY: dict[str, tuple[tuple[str, int], ...]] = {
    "R": (("R", 0),),
    "P": (("P", 0),),
    "C": (("P", 0), ("R", 0)),
    "U": (("R", 0), ("R", 1)),
    "S": (("R", 0), ("R", 1), ("R", 2)),
}


def _angles(axes: Sequence[FloatArray], rotations: FloatArray, generator: np.random.Generator) -> FloatArray | None:
    """Angles (N, number of R) with which the platform has the wanted orientations."""
    if not axes:
        at_rest = np.allclose(rotations, np.eye(3))
        return np.zeros((len(rotations), 0)) if at_rest else None

    def system(angles: FloatArray, rows: IndexArray) -> tuple[FloatArray, FloatArray]:
        turned, columns = np.broadcast_to(np.eye(3), (len(rows), 3, 3)), []
        for index, axis in enumerate(axes):
            columns.append(turned @ axis)
            turned = turned @ about_axis(axis, angles[:, index])
        error = to_vector(turned @ np.swapaxes(rotations[rows], -1, -2))
        return error, np.stack(columns, axis=-1)

    for _ in range(TRIES):
        start = generator.uniform(-SPREAD, SPREAD, (len(rotations), len(axes)))
        minimum = minimise(system, start, tolerance=TOLERANCE)
        if minimum.converged.all():
            return minimum.x
    return None


def _twists(steps: Sequence[_Step], angles: FloatArray, generator: np.random.Generator) -> FloatArray:
    count = len(angles)
    turned: FloatArray = np.broadcast_to(np.eye(3), (count, 3, 3))
    point = np.zeros((count, 3))
    columns, place = [], 0
    for kind, axis in steps:
        if kind == "link":
            point = point + generator.normal(size=(count, 3))
            continue
        if kind == "A":
            inside = np.cross(axis, generator.normal(size=(count, 3)))
            line = (turned @ (inside / np.linalg.norm(inside, axis=1, keepdims=True))[..., None])[..., 0]
        else:
            line = turned @ axis
        if kind == "R":
            columns.append(np.concatenate([line, np.cross(point, line)], axis=1))
            turned = turned @ about_axis(axis, angles[:, place])
            place += 1
        else:
            columns.append(np.concatenate([np.zeros((count, 3)), line], axis=1))
    return np.stack(columns, axis=-1)
