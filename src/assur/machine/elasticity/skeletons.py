"""Skeletons: the nodes and bars that an elastic link consists of, and at which node each of its joints is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.beams import Beam, beam, given_beam
from assur.machine.masses.bars import joint_points, link_bars
from assur.model.file.place import entry_hint
from assur.model.machine_data import Material
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SAME = 1e-9
"""Share of a link's size within which points are one."""
PLATFORM = ""
"""Stands for the platform's point among joints: no joint has this name."""


@dataclass(frozen=True, eq=False)
class SkeletonBar:
    """A beam between two nodes, the axes (3, 3) of which are columns in the link's frame."""

    nodes: tuple[int, int]
    beam: Beam
    axes: FloatArray


@dataclass(frozen=True, eq=False)
class BarSkeleton:
    """The nodes (K, 3) of a link in its frame, in m, its bars, and the node of each joint; the platform's point too.

    A joint that is on no bar is tied rigidly to the nearest point of one, which is a node. The nodes of a link whose
    compliance is given are the points of the two joints that it is between.
    """

    nodes: FloatArray
    bars: tuple[SkeletonBar, ...]
    ties: Mapping[str, int]


def elastic(record: MechanismRecord, link: str) -> bool:
    """Whether a link bends: it has a profile or a compliance, and is not said to be rigid."""
    own = record.machine.links.get(link)
    if own is None or own.rigid or link == record.base:
        return False
    return own.profile is not None or own.compliance is not None


def skeleton(record: MechanismRecord, link: str, *, shear: bool = True) -> BarSkeleton:
    """The skeleton of an elastic link.

    Errors:
        UsageError: its bars are not known, do not hang together or have no length; its material says no E or nu.

    >>> from assur.model.registry import load_record
    >>> own = skeleton(load_record("zeng2019"), "link11")  # D1 is in the middle of C1C2
    >>> len(own.bars), own.ties
    (2, {'C1': 0, 'C2': 1, 'D1': 2})
    """
    data, metre = record.machine.links[link], METRES[record.unit]
    if data.compliance is not None:
        return _given(record, link, data.compliance)
    material = _material(record, link)
    profile = record.machine.profiles[data.profile or ""]
    ends = metre * np.array([bar.ends for bar in link_bars(record, link)])  # (B, 2, 3)
    points = _points(record, link)
    size = float(np.max(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)))
    if size == 0.0:
        raise UsageError(
            f"link {link} of {record.name}: its bars have no length",
            hint=entry_hint(record, "links", link, "rigid = true"),
        )
    nodes = _Nodes(SAME * size)
    for point in ends.reshape(-1, 3):
        nodes.place(point)
    ties = {name: nodes.place(_nearest(ends, point)) for name, point in points.items()}
    for first, second in combinations(ends, 2):
        crossing = _crossing(first, second, SAME * size)
        if crossing is not None:
            nodes.place(crossing)
    pairs = [pair for bar in ends for pair in nodes.along(bar)]
    _connected(record, link, pairs, len(nodes.points))
    up = data.up if data.up is not None else profile.up
    bars = []
    for pair in pairs:
        along = nodes.points[pair[1]] - nodes.points[pair[0]]
        length = float(np.linalg.norm(along))
        axes = _axes(along / length, up)
        if axes is None:
            raise UsageError(
                f"link {link} of {record.name}: up of {profile.name} is along its bar",
                hint=f"{entry_hint(record, 'links', link, 'up = [0, 0, 1]')}, a direction across it",
            )
        bars.append(SkeletonBar(pair, beam(profile, material, length, shear=shear), axes))
    return BarSkeleton(np.array(nodes.points), tuple(bars), ties)


def _points(record: MechanismRecord, link: str) -> dict[str, FloatArray]:
    """Points (3,) of a link's joints in its frame, in m, and the platform's."""
    points = {name: METRES[record.unit] * point for name, point in joint_points(record, link).items()}
    if link == record.platform.link:
        points[PLATFORM] = METRES[record.unit] * np.asarray(record.platform.point)
    return points


def _given(record: MechanismRecord, link: str, compliance: FloatArray) -> BarSkeleton:
    """Of a link whose compliance (6, 6) is given: what is no end of it is tied to the nearer one."""
    points = _points(record, link)
    pair = record.machine.links[link].bars[:1] or [tuple(joint_points(record, link))]
    names = pair[0] if len(pair[0]) == 2 else link_bars(record, link)[0].joints
    ends = np.array([points[name] for name in names])
    length = float(np.linalg.norm(ends[1] - ends[0]))
    axes = _axes((ends[1] - ends[0]) / length, None) if length else None
    axes = np.eye(3) if axes is None else axes
    turned = np.kron(np.eye(2), axes)
    bar = SkeletonBar((0, 1), given_beam(turned.T @ compliance @ turned, length), axes)
    nearest = {name: int(np.argmin(np.linalg.norm(ends - point, axis=1))) for name, point in points.items()}
    return BarSkeleton(ends, (bar,), nearest | {names[0]: 0, names[1]: 1})


class _Nodes:
    """Points that are more than a distance apart, in the order in which they come."""

    def __init__(self, distance: float) -> None:
        self.distance = distance
        self.points: list[FloatArray] = []

    def place(self, point: FloatArray) -> int:
        for number, known in enumerate(self.points):
            if np.linalg.norm(known - point) <= self.distance:
                return number
        self.points.append(point)
        return len(self.points) - 1

    def along(self, bar: FloatArray) -> list[tuple[int, int]]:
        """Pairs of neighbours among the points on a bar (2, 3)."""
        way = bar[1] - bar[0]
        size = float(way @ way)
        if size <= self.distance**2:
            return []
        shares = [float((point - bar[0]) @ way) / size for point in self.points]
        on = [
            (share, number)
            for number, (share, point) in enumerate(zip(shares, self.points, strict=True))
            if np.linalg.norm(bar[0] + min(max(share, 0.0), 1.0) * way - point) <= self.distance
        ]
        order = [number for _, number in sorted(on)]
        return [(min(pair), max(pair)) for pair in pairwise(order)]


def _material(record: MechanismRecord, link: str) -> Material:
    name = record.machine.links[link].material
    if name is None:
        said = 'material = "steel"'
        raise UsageError(
            f"link {link} of {record.name}: a profile without a material",
            hint=f"{entry_hint(record, 'links', link, said)}; or rigid = true",
        )
    material = record.machine.materials[name]
    lacking = [key for key, value in (("E", material.elasticity), ("nu", material.poisson)) if value is None]
    if lacking:
        raise UsageError(
            f"material {name} of {record.name}: no {' and no '.join(lacking)}, and link {link} is made of it",
            hint=f"{entry_hint(record, 'materials', name, 'E = 210e9, nu = 0.3')}, E in Pa",
        )
    return material


def _nearest(ends: FloatArray, point: FloatArray) -> FloatArray:
    """The point of bars (B, 2, 3) that is nearest."""
    ways = ends[:, 1] - ends[:, 0]
    sizes = np.einsum("bi,bi->b", ways, ways)
    shares = np.einsum("bi,bi->b", point - ends[:, 0], ways) / np.where(sizes > 0, sizes, 1.0)
    nearest = ends[:, 0] + np.clip(shares, 0.0, 1.0)[:, None] * ways
    return np.asarray(nearest[np.argmin(np.linalg.norm(nearest - point, axis=1))])


def _crossing(first: FloatArray, second: FloatArray, distance: float) -> FloatArray | None:
    """Where two bars (2, 3) cross: bars of one link are welded there."""
    ways = np.array([first[1] - first[0], second[0] - second[1]]).T
    shares, _, rank, _ = np.linalg.lstsq(ways, second[0] - first[0], rcond=1e-9)
    if rank < 2 or np.any(shares < 0.0) or np.any(shares > 1.0):
        return None
    point = first[0] + shares[0] * ways[:, 0]
    gap = point - (second[0] - shares[1] * ways[:, 1])
    return np.asarray(point) if np.linalg.norm(gap) <= distance else None


def _connected(record: MechanismRecord, link: str, pairs: list[tuple[int, int]], count: int) -> None:
    reached, grown = {0}, True
    while grown:
        more = {node for pair in pairs for node in pair if reached & set(pair)}
        grown = not more <= reached
        reached |= more
    if len(reached) < count:
        raise UsageError(
            f"link {link} of {record.name}: its bars do not hang together",
            hint=f"add one between them to its bars; or {entry_hint(record, 'links', link, 'rigid = true')}",
        )


def _axes(along: FloatArray, up: FloatArray | None) -> FloatArray | None:
    """Axes (3, 3) of a bar as columns: along it, `up`, and across both; None where `up` is along it."""
    given = np.eye(3)[int(np.argmin(np.abs(along)))] if up is None else np.asarray(up, dtype=float)
    across = given - (given @ along) * along
    size = float(np.linalg.norm(across))
    if size < 1e-6 * float(np.linalg.norm(given)):
        return None
    y = across / size
    return np.array([along, y, np.cross(along, y)]).T
