"""Points that axes have in common: where the axes of a limb's end meet, and which limbs end in the same point.

The axes at a limb's first end are fixed in the base, or turn about a point of it; those at its last end belong to the
platform in the same way. So what two limbs have in common there at home they have in common everywhere. Points in
the middle of limbs may coincide at home by chance, and are no common points.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from assur.joints.joint_type import JointType
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop
from assur.topology.directions import parallel
from assur.topology.screws.linkage import Linkage, LinkageJoint

FloatArray = NDArray[np.float64]
Line = tuple[FloatArray, FloatArray]
"""A point in the base frame, and the direction of an axis or zero where every axis through it counts."""

MEETING = 1e-9
"""Axes of one limb that are nearer than this share of the size of the linkage meet."""

SAME = 1e-7
"""Points of different limbs that are nearer than this share of it are one; the loops are closed less exactly."""


def pivoted(joint_type: JointType) -> bool:
    """Whether a joint may share a point with a neighbour: it turns, and slides nowhere."""
    return joint_type.turning and not joint_type.slides


def line_of(joint: LinkageJoint) -> Line:
    """An R or H joint's axis at home; of a U or S its centre alone, which no line describes."""
    return joint.point, joint.screws[0, :3] if pivoted(joint.type) and joint.type.turns == 1 else np.zeros(3)


def size_of(linkage: Linkage) -> float:
    """The size that gaps are compared with: a length of the linkage, or how far from the origin it stands."""
    return max(linkage.length, *(float(np.max(np.abs(joint.point))) for joint in linkage.joints.values()))


def meet(lines: Sequence[Line], size: float) -> bool:
    """Whether some axes and centres have a point in common: the least-squares point misses none of them.

    >>> x, y, origin = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.zeros(3)
    >>> meet([(origin, x), (4 * y, y)], 4.0), meet([(origin, x), (np.array([0.0, 0.0, 1e-3]), y)], 4.0)
    (True, False)
    """
    rows, offsets = _equations(lines)
    point = np.linalg.lstsq(rows, offsets, rcond=None)[0]
    return bool(np.max(np.abs(rows @ point - offsets)) < MEETING * size)


def common_place(lines: Sequence[Line]) -> Line:
    """Where axes that meet do so: a point with a zero direction, or the one line that they are.

    >>> x, y = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    >>> point, direction = common_place([(np.zeros(3), x), (x + y, y)])
    >>> bool(np.allclose(point, x)), bool(direction.any())
    (True, False)
    """
    rows, offsets = _equations(lines)
    point, _, rank, _ = np.linalg.lstsq(rows, offsets, rcond=1e-6)
    return np.asarray(point), np.zeros(3) if int(rank) == 3 else lines[0][1]


def with_shared_points(
    chains: Sequence[Chain], lines: Mapping[str, Line], labels: Iterator[str], size: float, point: FloatArray
) -> tuple[Chain, ...]:
    """The limbs with one label where they end in one point (or on one axis) of the base, or of the platform.

    Args:
        chains: with labels of their own.
        lines: axis of each turning joint at home.
        labels: new ones.
        size: of the linkage, in the unit of its points.
        point: (3,) O' at home; a limb that ends there alone has a label too.
    """
    naming = _Naming(lines, labels, size, {joint.name: _label(joint) for chain in chains for joint in chain.joints})
    both = [
        [_Run(run, common_place([lines[name] for name in run])) for chain in chains if (run := _end_run(chain, end))]
        for end in (0, -1)
    ]
    naming.centre(both)
    for ends in both:
        naming.one_end(ends)
    uses = Counter(naming.called.values())
    at = {run.names[-1] for run in both[-1] if not run.is_line and _off(point, run.place) < SAME * size}
    kept = {name: label if uses[label] > 1 or name in at else "" for name, label in naming.called.items()}
    return tuple(Chain(_renamed(chain.elements, kept)) for chain in chains)


def common_end(chains: Sequence[Chain]) -> str:
    """The label of the point of the platform in which every limb ends that can resist anything; empty without one.

    A limb of six freedoms or more is taken to resist nothing.

    >>> from assur.topology.notation import parse_chains
    >>> common_end(parse_chains(["R[x]@O R[y]@O", "U P S", "P[x] S@O"])), common_end(parse_chains(["S@O", "R[x] R[y]"]))
    ('O', '')
    """
    resisting = [chain for chain in chains if sum(joint.freedoms for joint in chain.joints) < 6]
    ends = [chain.elements[-1] for chain in resisting]
    labels = [end.points_on(-1) if isinstance(end, ChainJoint) and pivoted(end.type) else () for end in ends]
    return next((label for label in labels[0] if all(label in others for others in labels)), "") if labels else ""


def point_of_platform(linkage: Linkage, chains: Sequence[Chain]) -> str:
    """The label of the limbs' common end if O' is there at home; empty where it is not, or where they have none."""
    label = common_end(chains)
    if not label:
        return ""
    ending = [chain for chain in chains if label in _labels(chain.elements[-1])]
    runs = [_end_run(chain, -1) or (chain.joints[-1].name,) for chain in ending]  # of a C, which slides, its axis alone
    places = [common_place([line_of(linkage.joints[name]) for name in run]) for run in runs]
    beside = [chain.joints[-1].name for chain in chains if label in _beside_centre(chain.elements[-1])]
    places += [(linkage.joints[name].point, linkage.joints[name].screws[-1, :3]) for name in beside]
    size = size_of(linkage)
    return label if all(_off(linkage.point, place) < SAME * size for place in places) else ""


def end_point(linkage: Linkage, chain: Chain) -> FloatArray | None:
    """The one point (3,) at home in which a limb's last axes meet; None where there are fewer than two, or one line."""
    run = _end_run(chain, -1)
    point, along = common_place([line_of(linkage.joints[name]) for name in run]) if run else (None, np.ones(3))
    return None if along.any() else point


@dataclass(frozen=True, eq=False)
class _Run:
    """Joints at the end of a limb whose axes meet, and where they do."""

    names: tuple[str, ...]
    place: Line

    @property
    def is_line(self) -> bool:
        return bool(self.place[1].any())


@dataclass
class _Naming:
    """Labels of joints, `called`, that become one where places are."""

    lines: Mapping[str, Line]
    labels: Iterator[str]
    size: float
    called: dict[str, str]

    def centre(self, ends: Sequence[Sequence[_Run]]) -> None:
        """One label for a point in which axes of several limbs meet at both ends: the platform turns about it."""
        met = [[self._crossing(*pair) for pair in combinations(runs, 2)] for runs in ends]
        first, last = ([point for point in points if point is not None] for points in met)
        centre = next((p for p, q in product(first, last) if np.max(np.abs(p - q)) < SAME * self.size), None)
        if centre is None:
            return
        label = next(self.labels)
        for run in (run for runs in ends for run in runs if _off(centre, run.place) < SAME * self.size):
            before = self.called[run.names[0]]
            self.called.update({name: label for name, other in self.called.items() if before and other == before})
            self.called.update(dict.fromkeys(run.names, label))

    def _crossing(self, run: _Run, other: _Run) -> FloatArray | None:
        """The one point (3,) in which the axes of two runs meet."""
        places = [run.place, other.place]
        point, along = common_place(places)
        met = all(_off(point, place) < SAME * self.size for place in places)
        return None if along.any() or not met else point

    def one_end(self, runs: Sequence[_Run]) -> None:
        """One label for one place at this end: first the points, then the lines through a point or on one line."""
        known: list[tuple[str, _Run]] = []
        for run in sorted(runs, key=lambda run: run.is_line):
            label_before = self.called[run.names[0]]
            same = next((label for label, other in known if self._one_place(run, other)), "")
            if same and same != label_before:
                self._rename(run, label_before, same)
            label = self.called[run.names[0]] or next(self.labels)
            self.called.update(dict.fromkeys(run.names, label))
            known.append((label, run))

    def _rename(self, run: _Run, before: str, label: str) -> None:
        """A point that is another one is so wherever it is named; a line may run through several points."""
        if not run.is_line:
            self.called.update({name: label for name, other in self.called.items() if before and other == before})
        elif before and sum(other == before for other in self.called.values()) > len(run.names):
            return
        self.called.update(dict.fromkeys(run.names, label))

    def _one_place(self, run: _Run, other: _Run) -> bool:
        """Whether a run is at the place of another: a point that is it, or a line that runs through it or is it."""
        axis, along = run.place[1], other.place[1]
        near = _off(other.place[0], run.place) < SAME * self.size
        return near and (not along.any() or float(np.max(np.abs(np.cross(axis, along)))) < SAME)


def _off(point: FloatArray, place: Line) -> float:
    """How far a point is from a place, in its largest coordinate."""
    away = point - place[0]
    return float(np.max(np.abs(away - place[1] * (place[1] @ away))))


def _equations(lines: Sequence[Line]) -> tuple[FloatArray, FloatArray]:
    """The linear equations of a point on all lines."""
    planes = [np.eye(3) - np.outer(axis, axis) for _, axis in lines]
    offsets = [plane @ point for plane, (point, _) in zip(planes, lines, strict=True)]
    return np.vstack(planes), np.concatenate(offsets)


def _end_run(chain: Chain, end: int) -> tuple[str, ...]:
    """Names of the joints at an end of a limb whose axes meet there; empty where it does not end in such a joint.

    A slide along the one axis behind it is passed over: the axis stays on its line.
    """
    ordered = list(chain.elements if end == 0 else chain.elements[::-1])
    while len(ordered) > 1 and _slides_along(ordered):
        del ordered[0]
    first = ordered[0]
    if not isinstance(first, ChainJoint) or not pivoted(first.type):
        return ()
    names, shared = [first.name], set(_labels(first))
    for element in ordered[1:]:
        shared &= set(_labels(element))
        if not shared:
            break
        names.append(element.name)
    return tuple(names)


def _slides_along(ordered: Sequence[Element]) -> bool:
    """Whether a limb begins with a slide along the axis behind it, which stays where it is as a line."""
    slide = ordered[0]
    behind = next(
        (element for element in ordered if not (isinstance(element, ChainJoint) and not element.type.turning)), slide
    )
    if not (isinstance(slide, ChainJoint) and not slide.type.turning and isinstance(behind, ChainJoint)):
        return False
    return pivoted(behind.type) and behind.type.turns == 1 and parallel(slide.axes[0], behind.axes[0])


def _label(joint: Element) -> str:
    return joint.point if isinstance(joint, ChainJoint) else ""


def _beside_centre(joint: Element) -> tuple[str, ...]:
    """Labels of the points on a joint's last axis that are not its centre."""
    if not isinstance(joint, ChainJoint) or len(joint.axes) < 2:
        return ()
    return joint.points_on(-1)[bool(joint.point) :]


def _labels(joint: Element) -> list[str]:
    """Labels of the points that all axes of a joint run through."""
    if not isinstance(joint, ChainJoint):
        return []
    return [*joint.points_on(0)] if len(joint.axes) == 1 else [joint.point] if joint.point else []


def _renamed(elements: Sequence[Element], labels: Mapping[str, str]) -> tuple[Element, ...]:
    renamed: list[Element] = []
    for element in elements:
        if isinstance(element, InnerLoop):
            branches = tuple(_renamed(branch, labels) for branch in element.branches)
            renamed.append(dataclasses.replace(element, branches=branches))
        elif isinstance(element, ChainJoint):
            renamed.append(dataclasses.replace(element, point=labels[element.name]))
        else:
            renamed.append(element)
    return tuple(renamed)
