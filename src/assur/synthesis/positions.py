"""Where the limbs of a mechanism stand: each is turned into a position of its own."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import about_axis
from assur.synthesis.required import RequiredMotion
from assur.topology.chains import Chain, ChainJoint, Element, Parallelogram
from assur.topology.directions import NAMED, Vector, parallel, unit

FloatArray = NDArray[np.float64]

CYCLE: FloatArray = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Takes x to y, y to z, z to x."""

SWAP: FloatArray = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""Takes x to y and y to x; a mirror, which to axes without sense is a quarter turn."""

DIGITS = 15
"""Decimals of a direction that is not along x, y or z: enough for parallel axes, and short to read."""

ABOUT_Z = "each limb is as written or turned about z by 90°; three also by 120° from one to the next"
"""How limbs stand whose motion at home counts."""

AS_WRITTEN = "limbs stand as written to the virtual chain, or with x, y, z exchanged where it stays the same"
"""How limbs stand that follow a virtual chain."""


def positions(motion: RequiredMotion, limbs: int) -> tuple[FloatArray, ...]:
    """Rotations (3, 3) that take a limb as written into each of its positions.

    Where the motion singles out no direction, x -> y -> z -> x, as on three walls of a room; otherwise around its axis,
    evenly, but two limbs at a right angle.

    Two limbs that are not as many as the motion's freedoms have further ones to choose from; the last is the first
    again, for limbs side by side.

    >>> from assur.synthesis.required import MOTIONS
    >>> [tuple(map(float, turn @ (1, 0, 0))) for turn in positions(MOTIONS["3T"], 3)]
    [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    """
    choice = _may_choose(motion, limbs)
    if motion.axis is None:
        count = limbs + 2 if choice else limbs
        return tuple(np.linalg.matrix_power(CYCLE, index) for index in range(count))
    step = math.radians(_step(limbs))
    turns = [about_axis(np.array(motion.axis), np.array(step * index)) for index in range(limbs)]
    return tuple(np.round(turn, DIGITS) for turn in [*turns, *turns[:choice]])


def placements(motion: RequiredMotion, limbs: int) -> tuple[tuple[int, ...], ...]:
    """Ways to give each limb one of the positions; the first that gives the motion is taken.

    >>> from assur.synthesis.required import MOTIONS
    >>> placements(MOTIONS["3T"], 3), placements(MOTIONS["3T"], 2)
    (((0, 1, 2),), ((0, 1), (0, 2), (0, 3)))
    """
    if not _may_choose(motion, limbs):
        return (tuple(range(limbs)),)
    return tuple((0, other) for other in range(1, len(positions(motion, limbs))))


def _may_choose(motion: RequiredMotion, limbs: int) -> bool:
    return limbs == 2 < motion.dim


def _step(limbs: int) -> float:
    """Angle in degrees from one position around an axis to the next."""
    return 90.0 if limbs == 2 else 360.0 / limbs


def in_words(motion: RequiredMotion, limbs: int) -> str:
    """How the limbs stand to each other.

    >>> from assur.synthesis.required import MOTIONS
    >>> in_words(MOTIONS["2T1R"], 3)
    'each limb is the one before turned about z by 120°'
    """
    if _may_choose(motion, limbs):
        turned = "with x, y, z turned into y, z, x or z, x, y" if motion.axis is None else "turned about z by 90°"
        return f"the second limb is as written {turned}, or beside the first, whichever first gives the motion"
    if motion.axis is None:
        return "each limb is the one before with x, y, z turned into y, z, x"
    return f"each limb is the one before turned about z by {_step(limbs):g}°"


def turned(chain: Chain, turn: FloatArray) -> Chain:
    """The chain with every direction turned.

    >>> from assur.topology.notation import parse_chains, plain_text
    >>> plain_text(turned(parse_chains(["P[x] U[y,z]"])[0], CYCLE))
    'P[y] U[z,x]'
    """

    def axis(vector: Vector) -> Vector:
        return unit(turn @ np.array(vector))

    return _with_axes(chain, axis)


def upright(chain: Chain, motion: RequiredMotion) -> Chain:
    """A chain along x, y and z written so that limbs of every kind fit together in their positions.

    Where the motion singles out z, the first other direction of its R comes to x. Else the one direction of its R
    comes to x; where it has two, their plane comes to that of x and y; without R, its first joint comes to x. So in the
    next position neither a direction nor a plane is met again.
    """
    axes = _turning_axes(chain)
    if motion.axis is not None:
        others = [axis for axis in axes if not parallel(axis, motion.axis)]
        return turned(chain, SWAP) if others and parallel(others[0], NAMED["y"]) else chain
    if len(axes) == 2:
        target, leading = NAMED["z"], unit(np.cross(axes[0], axes[1]))
    else:
        target, leading = NAMED["x"], axes[0] if len(axes) == 1 else _first_axis(chain)
    for turn in (np.linalg.matrix_power(CYCLE, index) for index in range(3)):
        if parallel(unit(turn @ np.array(leading)), target):
            return turned(chain, turn)
    return chain


def _turning_axes(chain: Chain) -> list[Vector]:
    """Different directions of the joints that turn."""
    axes: list[Vector] = []
    for joint in chain.joints:
        if isinstance(joint, ChainJoint) and joint.type.turning:
            axes += [axis for axis in joint.axes if not any(parallel(axis, other) for other in axes)]
    return axes


def _first_axis(chain: Chain) -> Vector:
    first = chain.joints[0]
    return first.axes[0] if isinstance(first, ChainJoint) else NAMED["x"]


def _with_axes(chain: Chain, changed: Callable[[Vector], Vector]) -> Chain:
    def element(old: Element) -> Element:
        if isinstance(old, Parallelogram):
            return dataclasses.replace(old, axis=changed(old.axis))
        if isinstance(old, ChainJoint):
            return dataclasses.replace(old, axes=tuple(changed(axis) for axis in old.axes))
        return dataclasses.replace(old, branches=tuple(tuple(map(element, branch)) for branch in old.branches))

    return Chain(tuple(element(old) for old in chain.elements))
