"""A screw beside at most two turns or slides: all values that take a point to where it is to be.

What the others leave as it is of a point, its distance from where their axes meet or its place along what is across all
of them, changes along the screw by c0 + c1 t + c2 t^2 + a cos(t - b). Its zeros are where the polynomial is no larger
than a; there they are told apart by bounds of the second derivative, so that none is missing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.limbs.point_closure import CLOSE, MovingLimbError, PointClosure, point_closure
from assur.kinematics.limbs.serial import ElementaryMotion, NotSerialError, applied
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
NOTHING = 1e-12
"""Part of the largest coefficient below which a further one is rounding."""
MEETING = 1e-9
"""Distance of axes in sizes of the limb, and cosine, up to which they meet, or are across."""
FIRST, LAST = 0.5, 1e-9
"""Width in rad of the parts in which zeros are sought, and of those that are not parted further."""
MOST = 1e5
"""Radians along which a screw is looked at; no drive has so many turns."""
STEPS = 60
"""Halvings from the first width to rounding."""
TOUCHING = 1e-5
"""By how much a zero is taken as bent where it may be double, or none."""


@dataclass(frozen=True)
class _Wave:
    """c0 + c1 t + c2 t^2 + across cos t + beside sin t."""

    powers: tuple[float, float, float]
    across: float
    beside: float

    @property
    def height(self) -> float:
        return float(np.hypot(self.across, self.beside))

    def __call__(self, t: FloatArray) -> FloatArray:
        c0, c1, c2 = self.powers
        return np.asarray(c0 + t * (c1 + t * c2) + self.across * np.cos(t) + self.beside * np.sin(t))

    def slope(self, t: FloatArray) -> FloatArray:
        _, c1, c2 = self.powers
        return np.asarray(c1 + 2.0 * c2 * t - self.across * np.sin(t) + self.beside * np.cos(t))


def screw_closure(
    motions: Sequence[ElementaryMotion], number: int, point: FloatArray, place: FloatArray, size: float
) -> PointClosure:
    """Values of three motions or fewer, that with a number a screw, which take a point (3,) to its place (3,).

    `roots` counts the real zeros that were looked at: there are infinitely many complex ones.

    Errors:
        NotSerialError: the screw is between two others, or what these leave as it is is no distance and no height.
        MovingLimbError: there are infinitely many.

    Example: a nut with a rod of length 2 to a ball that is 1 beside the screw.

    >>> up, across = np.eye(3)[2], np.eye(3)[0]
    >>> screw = ElementaryMotion("screw", up, np.zeros(3), 0, 1, advance=0.5)
    >>> turns = [ElementaryMotion("turn", axis, np.zeros(3), k + 1, 1) for k, axis in enumerate((across, np.eye(3)[1]))]
    >>> closure = screw_closure([screw, *turns], 0, 2.0 * up, np.array([1.0, 0.0, 0.0]), 1.0)
    >>> np.unique((0.5 * closure.values[:, 0]).round(6)).tolist()  # heights of the nut
    [-1.732051, 1.732051]
    """
    screw = motions[number]
    others = [motion for k, motion in enumerate(motions) if k != number]
    if 0 < number < len(motions) - 1:
        raise NotSerialError("a screw between two other motions moves a point beside its axis")
    last = number > 0
    moving, still, sense = (point, place, screw.sense) if last else (place, point, -screw.sense)
    angles, bent = _zeros_of_one(_waves(replace(screw, sense=sense), others, moving, still, size))
    pieces = [(np.zeros((0, len(motions))), np.zeros(0))]
    for angle, own in zip(angles, bent, strict=True):
        moved = applied(replace(screw, sense=sense), np.asarray(angle), moving)
        rest = point_closure(others, *((moved, place) if last else (point, moved)), size)
        pieces.append((np.insert(rest.values, number, angle, axis=1), np.maximum(rest.bent, own)))
    values, off = (np.concatenate(part) for part in zip(*pieces, strict=True))
    return PointClosure(values, off, len(angles))


def _waves(
    screw: ElementaryMotion, others: Sequence[ElementaryMotion], moving: FloatArray, still: FloatArray, size: float
) -> list[_Wave]:
    """What is zero where the others lead from a point on the screw's way to one that stands still."""
    foot = screw.point + screw.axis * (screw.axis @ (moving - screw.point))
    across = (moving - foot) / size
    beside, advance = screw.sense * cross(screw.axis, across), screw.sense * screw.advance * screw.axis / size
    waves = []
    for normal in _normals(others):
        height = float(normal @ (foot - still)) / size
        waves.append(_Wave((height, float(normal @ advance), 0.0), float(normal @ across), float(normal @ beside)))
    for centre in _centres(others, size):
        start = (foot - centre) / size
        square = float(start @ start + across @ across) - float(np.sum((still - centre) ** 2)) / size**2
        powers = (square, 2.0 * float(start @ advance), float(advance @ advance))
        waves.append(_Wave(powers, 2.0 * float(start @ across), 2.0 * float(start @ beside)))
    if not waves:
        raise NotSerialError("a screw moves a point beside its axis")
    return waves


def _normals(others: Sequence[ElementaryMotion]) -> Iterator[FloatArray]:
    """Directions along which none of the motions moves a point."""
    turns = [motion.axis for motion in others if motion.kind == "turn"]
    slides = [motion.axis for motion in others if motion.kind == "slide"]
    if not turns:
        yield from np.linalg.svd(np.array(slides).reshape(-1, 3), full_matrices=True)[2][len(slides) :]
    elif all(np.linalg.norm(cross(turns[0], axis)) < MEETING for axis in turns) and all(
        abs(turns[0] @ axis) < MEETING for axis in slides
    ):
        yield turns[0]


def _centres(others: Sequence[ElementaryMotion], size: float) -> Iterator[FloatArray]:
    """Points from which none of the motions moves a point away."""
    if not others or any(motion.kind != "turn" for motion in others):
        return
    first, last = others[0], others[-1]
    rows = np.concatenate([np.eye(3) - np.outer(motion.axis, motion.axis) for motion in (first, last)])
    sides = np.concatenate([motion.point - motion.axis * (motion.axis @ motion.point) for motion in (first, last)])
    centre = np.linalg.lstsq(rows, sides, rcond=MEETING)[0]
    if np.linalg.norm(rows @ centre - sides) < MEETING * size:
        yield centre


def _zeros_of_one(waves: Sequence[_Wave]) -> tuple[FloatArray, FloatArray]:
    """Zeros (K,) of the first wave that has finitely many, and by how much (K,) they are bent."""
    for wave in waves:
        if max(abs(power) for power in wave.powers[1:]) > NOTHING * max(wave.height, abs(wave.powers[0])):
            return _zeros(wave)
    if any(abs(wave.powers[0]) > wave.height + CLOSE for wave in waves):
        return np.zeros(0), np.zeros(0)
    raise MovingLimbError


def _zeros(wave: _Wave) -> tuple[FloatArray, FloatArray]:
    """All zeros (K,) of a wave whose polynomial is no constant, and by how much (K,) they are bent."""
    cells = [np.linspace(*ends, 2 + int((ends[1] - ends[0]) / FIRST)) for ends in _where_small(wave)]
    low = np.concatenate([np.zeros(0), *(own[:-1] for own in cells)])
    high = np.concatenate([np.zeros(0), *(own[1:] for own in cells)])
    bound = wave.height + 2.0 * abs(wave.powers[2])
    simple, touching = [np.zeros((2, 0))], [np.zeros(0)]
    while len(low):
        middle, radius = (low + high) / 2.0, (high - low) / 2.0
        value, slope = np.abs(wave(middle)), np.abs(wave.slope(middle))
        near = value <= slope * radius + bound * radius**2 / 2.0
        steep = slope > bound * radius
        change = wave(low) * wave(high) <= 0.0
        simple.append(np.array([low, high])[:, near & steep & change])
        ended = near & ~steep & (radius < LAST)
        touching.append(middle[ended])
        left = near & ~steep & ~ended
        low, high = np.concatenate([low[left], middle[left]]), np.concatenate([middle[left], high[left]])
    known = _halved(wave, *np.concatenate(simple, axis=1))
    double = np.concatenate(touching)
    zeros, bent = np.concatenate([known, double]), np.repeat([0.0, TOUCHING], [len(known), len(double)])
    order = np.argsort(zeros)
    kept = order[np.diff(zeros[order], prepend=-np.inf) > 10.0 * LAST]  # ends of two parts, parts beside each other
    return zeros[kept], bent[kept]


def _halved(wave: _Wave, low: FloatArray, high: FloatArray) -> FloatArray:
    """The zero (N,) between each two places (N,), between which the wave only rises, or only falls."""
    rising = wave(high) >= wave(low)
    for _ in range(STEPS):
        middle = (low + high) / 2.0
        below = (wave(middle) < 0.0) == rising
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return (low + high) / 2.0


def _where_small(wave: _Wave) -> list[tuple[float, float]]:
    """Intervals in which the polynomial is no larger than the wave is high; a little wider than they are."""
    c0, c1, c2 = wave.powers
    height = wave.height + CLOSE * NOTHING
    ends = [np.roots([c2, c1, c0 - level] if abs(c2) > 0.0 else [c1, c0 - level]) for level in (height, -height)]
    places = np.sort(np.concatenate([own.real[np.abs(own.imag) < LAST] for own in ends]))
    if len(places) and max(abs(places[0]), abs(places[-1])) > MOST:
        raise NotSerialError("a screw that advances too little by a turn for its ways to be listed")
    wider = LAST * max(1.0, float(np.max(np.abs(places), initial=0.0)))
    own = [(float(a) - wider, float(b) + wider) for a, b in pairwise(places)]
    inside = [abs(c0 + m * (c1 + m * c2)) <= height for m in ((a + b) / 2.0 for a, b in own)]
    return [ends for ends, small in zip(own, inside, strict=True) if small]
