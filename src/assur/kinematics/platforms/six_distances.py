"""A platform with six points at known distances from points of the base: forty poses, complex ones counted.

All are followed from those of six generic complex legs. There can be no more than forty (F. Ronga, T. Vust 1995;
D. Lazard 1993; B. Mourrain 1993); where base or platform is special, some of the paths end at infinity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.platforms.distances import PointDistance
from assur.kinematics.platforms.soma import equations, norm_of, poses_of, soma_of
from assur.model.file.toml_source import read_toml
from assur.numerics.expanded import ExpandedSystem, expand, unknowns
from assur.numerics.homotopy import PathEnd, solve
from assur.numerics.monodromy import all_solutions, random_complex
from assur.numerics.path_tracking import polished
from assur.results.reading import file_text

ComplexArray = NDArray[np.complex128]
FILE = Path(__file__).parent / "six_distances.toml"
DIGITS = 5
LEGS, MOST = 6, 40
REAL = 1e-6
"""Largest imaginary part of a pose that is tried as a real one, its largest coordinate being 1."""
DOUBTFUL = 1e-8
"""The same, above which it may be a real one or not."""
INFINITE = 1e-9


@dataclass(frozen=True, eq=False)
class SixDistancePoses:
    """All poses of a platform.

    Attributes:
        poses: frames of the real ones.
        complex: how many complex poses there are, the real ones among them.
        infinite: how many paths ended at infinity.
        unknown: paths of which it is not known where they end, or whether that is real.
    """

    poses: tuple[Frame, ...]
    complex: int
    infinite: int
    unknown: int


def six_distance_poses(legs: Sequence[PointDistance], size: float) -> SixDistancePoses:
    """All poses at which six distances hold; `size` is a length to which they compare.

    >>> rng = np.random.default_rng(0)
    >>> points = rng.normal(size=(2, 6, 3))
    >>> legs = [PointDistance(a, b, float(np.linalg.norm(a - b))) for a, b in zip(*points)]
    >>> solved = six_distance_poses(legs, 1.0)
    >>> solved.complex, min(float(np.abs(place).max()) for _, place in solved.poses) < 1e-9
    (40, True)
    """
    first, starts = start()
    last = _numbers(legs, size)
    ends = solve(_way(first, last), starts)
    x = ends.x / np.take_along_axis(ends.x, np.argmax(np.abs(ends.x), axis=1)[:, None], axis=1)
    infinite = (np.abs(norm_of(x)) <= INFINITE) & (ends.end != PathEnd.lost)
    finite = (ends.end == PathEnd.regular) & ~infinite
    off = np.max(np.abs(x.imag), axis=1)
    real = finite & (off <= REAL)
    unknown = ~finite & ~infinite | finite & (off > DOUBTFUL) & (off <= REAL)
    rotations, places = poses_of(x[real].real)
    poses = tuple(zip(rotations, places * size, strict=True))
    return SixDistancePoses(poses, int(np.sum(finite)), int(np.sum(infinite)), int(np.sum(unknown)))


def _numbers(legs: Sequence[PointDistance], size: float) -> ComplexArray:
    """Points of the base, of the platform, and distances (42,), in sizes."""
    parts = [np.ravel([leg.base for leg in legs]), np.ravel([leg.platform for leg in legs])]
    numbers = np.concatenate([*parts, [leg.distance for leg in legs]]) / size
    return numbers.astype(np.complex128)


def _way(first: ComplexArray, last: ComplexArray) -> ExpandedSystem:
    """The legs on the straight way from t = 1 to t = 0."""
    *x, t = unknowns(9)
    ways = [b + (a - b) * t for a, b in zip(first, last, strict=True)]
    points = [(ways[3 * k], ways[3 * k + 1], ways[3 * k + 2]) for k in range(2 * LEGS)]
    return expand(equations(points[:LEGS], points[LEGS:], ways[6 * LEGS :], x))


@lru_cache(maxsize=1)
def start() -> tuple[ComplexArray, ComplexArray]:
    """Generic complex legs (42,), and all their poses (40, 8)."""
    data = read_toml(file_text(FILE), str(FILE)).data
    legs = np.array(data["legs"]) @ [1, 1j]
    rough = np.array(data["poses"]).reshape(-1, 8, 2) @ [1, 1j]
    return legs, polished(_way(legs, legs), rough, np.ones(len(rough)), np.zeros(len(rough), dtype=int))[0]


def start_from_nothing(seed: int) -> tuple[ComplexArray, ComplexArray]:
    """What the file holds, by monodromy: points and a pose by chance, distances of that pose, then all the others."""
    rng = np.random.default_rng(seed)
    points = random_complex(rng, 6 * LEGS).round(DIGITS)
    quaternion, place = random_complex(rng, 4), random_complex(rng, 3)
    quaternion = quaternion / np.sqrt(quaternion @ quaternion)
    soma = np.array(soma_of(tuple(quaternion), tuple(place)))
    triples = [tuple(part) for part in points.reshape(2 * LEGS, 3)]
    open_ = equations(triples[:LEGS], triples[LEGS:], [0.0] * LEGS, soma)[1:]  # N(e) is 1
    legs = np.concatenate([points, np.sqrt(open_)])
    return legs, all_solutions(_way, legs, soma, MOST, rng)


def write_start(seed: int) -> None:
    """The file anew. Its numbers are rounded; Newton's method brings them back."""
    legs, poses = start_from_nothing(seed)
    lines = [
        f"# By write_start of six_distances.py, seed {seed}: generic complex legs and all poses, parts of numbers."
    ]
    lines += ["legs = [", *(f"  [{part.real!r}, {part.imag!r}]," for part in legs.tolist()), "]", "poses = ["]
    for row in poses:
        parts = [f"{part:.{DIGITS}f}" for number in row for part in (number.real, number.imag)]
        lines.append(f"  [{', '.join(parts)}],")
    FILE.write_text("\n".join([*lines, "]", ""]))
