"""A limb at random poses of the required motion, as twists: the second route's data, computed once for each limb.

Links have random lengths and joints random values, subject to one thing only: the platform is turned as the
required motion says. Where a limb stands on the base is free, so each can be put at a common pose of the platform,
and limbs that were computed apart can be joined. So are the branches of an inner loop: its output link is turned alike
for all of them, and where they are hinged to it and to the base is free.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.least_squares import IndexArray, minimise
from assur.numerics.rotations import about_axis, to_vector
from assur.topology.chains import BASE, PLATFORM, Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.screws.edges import Edge, rank

FloatArray = NDArray[np.float64]

SPREAD = 0.8
"""Joints turn by up to this many rad from the configuration as written before the platform is brought to its pose."""

TOLERANCE = 1e-12
TRIES = 4
"""Random starts for each pose."""

_Step = tuple[str, FloatArray]
"""An elementary motion: "R", "P", "A" (a P(4R)) with its axis (3,), or "link" (a link of random length)."""

OUTPUT = "output link"
"""The link that the branches of an inner loop lead to."""


def edges_at_poses(chain: Chain, orientations: FloatArray, generator: np.random.Generator) -> tuple[Edge, ...] | None:
    """A limb as edges at N poses of its platform: one if it is a series, else one a branch and one for the rest.

    Args:
        chain: as for `twists_at_poses`; an inner loop may stand first.
        orientations: (N, 3, 3) of the platform, near the one as written.
        generator: of the links' lengths and the joints' values.

    Returns:
        Edges with twists (N, 6, f), in the order of the chain's joints; None where these orientations are not reached.

    Errors:
        UsageError: a joint of another type, or an inner loop that does not stand first.
    """
    loop = chain.elements[0]
    if not isinstance(loop, InnerLoop):
        twists = twists_at_poses(chain, orientations, generator)
        return None if twists is None else (Edge("limb", BASE, PLATFORM, twists),)
    first, rest = loop.branches[0], chain.elements[1:]
    steps = _steps((*first, *rest))
    angles = _angles(_axes(steps), orientations, generator)
    if angles is None:
        return None
    outputs = _orientation(_steps(first), angles)
    whole = _twists(steps, angles, generator)
    width = sum(_COLUMNS[kind] for kind, _ in _steps(first))
    edges = [Edge("branch 1", BASE, OUTPUT, whole[..., :width])]
    for number, branch in enumerate(loop.branches[1:], 2):
        twists = twists_at_poses(Chain(branch), outputs, generator)
        if twists is None:
            return None
        edges.append(Edge(f"branch {number}", BASE, OUTPUT, twists))
    return (*edges, Edge("rest", OUTPUT, PLATFORM, whole[..., width:]))


def twists_at_poses(chain: Chain, orientations: FloatArray, generator: np.random.Generator) -> FloatArray | None:
    """Twists (N, 6, f) of a limb at N poses of its platform, columns (omega, v at the base's origin) in the base frame.

    Args:
        chain: R, P, C, U, S and parallelograms in series.
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
    steps = _steps(chain.elements)
    angles = _angles(_axes(steps), orientations, generator)
    return None if angles is None else _twists(steps, angles, generator)


def twists_at_will(chain: Chain, generator: np.random.Generator, count: int, spread: float = SPREAD) -> FloatArray:
    """Twists (count, 6, f) of a series that nothing holds, with random links; its joints turn by up to a spread.

    Errors:
        UsageError: as `twists_at_poses`.
    """
    steps = _steps(chain.elements)
    return _twists(steps, generator.uniform(-spread, spread, (count, len(_axes(steps)))), generator)


def is_special(chain: Chain) -> bool:
    """Whether the limb as written has fewer independent freedoms than when it is displaced.

    >>> from assur.topology.notation import parse_chain
    >>> is_special(parse_chain("P[x] R[z] P[x]")), is_special(parse_chain("P[x] R[z] P[y]"))
    (True, False)
    """
    steps = _steps(_one_path(chain))
    turns = len(_axes(steps))
    generator = np.random.default_rng(turns)
    written, displaced = np.zeros((1, turns)), generator.uniform(-SPREAD, SPREAD, (1, turns))
    at_home, away = (rank(_twists(steps, angles, generator)) for angles in (written, displaced))
    return at_home < away


def _one_path(chain: Chain) -> tuple[Element, ...]:
    """The joints on the way through the first branch of an inner loop that stands first."""
    first = chain.elements[0]
    return (*first.branches[0], *chain.elements[1:]) if isinstance(first, InnerLoop) else chain.elements


def _axes(steps: Sequence[_Step]) -> list[FloatArray]:
    """Axes about which the steps turn what is behind them."""
    return [axis for kind, axis in steps if kind in _TURNING]


def _orientation(steps: Sequence[_Step], angles: FloatArray) -> FloatArray:
    """Orientation (N, 3, 3) of the link behind some steps, with the first of the angles."""
    turned: FloatArray = np.broadcast_to(np.eye(3), (len(angles), 3, 3))
    for index, axis in enumerate(_axes(steps)):
        turned = turned @ about_axis(axis, angles[:, index])
    return turned


def _steps(elements: Sequence[Element]) -> list[_Step]:
    steps: list[_Step] = []
    for element in elements:
        steps.append(("link", np.zeros(3)))
        if isinstance(element, Parallelogram):
            steps.append((_PARALLELOGRAMS[element.kind], np.array(element.axis)))
        elif isinstance(element, ChainJoint) and not element.point and element.type.letter in _ELEMENTARY:
            axes = np.array(element.axes) if element.axes else np.eye(3)
            steps += [(kind, axes[place]) for kind, place in _ELEMENTARY[element.type.letter]]
        else:
            raise UsageError("only R, P, C, U, S and parallelograms without points in common can be placed here")
    return [*steps, ("link", np.zeros(3))]


_PARALLELOGRAMS = {"4R": "A", "4S": "B", "2US": "B", "4U": "D"}
"""As a step: "A" swings in its plane, "B" and "D" over a sphere and about their short links, "B" about its rods too."""

_COLUMNS = {"link": 0, "R": 1, "P": 1, "A": 1, "B": 4, "D": 3}
"""Freedoms of a step."""

_TURNING = ("R", "B", "D")
"""Steps that turn what is behind them; about its rods a parallelogram turns it at no finite angle."""

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
        line = turned @ axis
        if kind in "ABD":
            columns += _of_parallelogram(kind, line, point, generator.normal(size=(count, 3)))
        elif kind == "P":
            columns.append(_translation(line))
        else:
            columns.append(_rotation(line, point))
        if kind in _TURNING:
            turned = turned @ about_axis(axis, angles[:, place])
            place += 1
    return np.stack(columns, axis=-1)


def _rotation(line: FloatArray, point: FloatArray) -> FloatArray:
    return np.concatenate([line, np.cross(point, line)], axis=1)


def _translation(line: FloatArray) -> FloatArray:
    return np.concatenate([np.zeros_like(line), line], axis=1)


def _of_parallelogram(kind: str, hinge: FloatArray, point: FloatArray, rods: FloatArray) -> list[FloatArray]:
    """Columns of a parallelogram whose rods have some direction (N, 3); hinged R keep it across their axis.

    With hinges it swings in its plane. With S, U and S, or U joints it swings over a sphere, and its far link turns
    about the direction of the near one; only with S at one end of each rod, or both, can it begin to turn about the
    rods.
    """
    if kind == "A":
        swing = np.cross(hinge, rods)
        return [_translation(swing / np.linalg.norm(swing, axis=1, keepdims=True))]
    along = rods / np.linalg.norm(rods, axis=1, keepdims=True)
    across = np.cross(along, hinge)
    columns = [_translation(across), _translation(np.cross(along, across)), _rotation(hinge, point)]
    return [*columns, _rotation(along, point)] if kind == "B" else columns
