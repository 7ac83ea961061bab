"""What an error of a dimension does to the joints: by how much each child is off, as its parent sees it.

A dimension has copies. `L` is off wherever it is written; `leg1.L` in the joints of one limb alone; `leg1.rod.L` in one
link alone: where that link has its joints. Axes, turns and pitches belong to the parents of their joints. Dimensions
that a file computes from others count by themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import cos, pi, sin, sqrt
from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames
from assur.joint_graph.geometry import JointGeometry, characteristic_length, written_joint
from assur.joint_graph.state import joint_state
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.written import NumberReading, WrittenVector

FloatArray = NDArray[np.float64]
FUNCTIONS = SimpleNamespace(sqrt=sqrt, sin=sin, cos=cos, pi=pi)
STEP = 1e-5
"""Share of its size, or of the characteristic length, by which a dimension is moved to either side."""


@dataclass(frozen=True, eq=False)
class GeometryErrors:
    """Errors of dimensions at one configuration, in the mechanism's unit and rad.

    Attributes:
        names: of the copies (P).
        units: what each is in.
        joints: names (J).
        twists: (P, J, 6) angular, then at the base's origin, of each joint's child against its parent, along the base's
            axes, per unit of the dimension.
        point: (P, 3) of the platform's point in the platform, along the base's axes.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    joints: tuple[str, ...]
    twists: FloatArray
    point: FloatArray


def geometry_errors(record: MechanismRecord, values: FloatArray) -> GeometryErrors:
    """Every copy of every dimension that a joint or the platform's point is written with, at joint values (n,).

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("orthoglide")
    >>> errors = geometry_errors(record, home_values(record))
    >>> errors.names[:6]
    ('L', 'leg1.L', 'leg2.L', 'leg3.L', 'leg1.rod_a.L', 'leg1.rod_b.L')
    """
    names = list(record.joints)
    twists: dict[str, FloatArray] = {}
    points: dict[str, FloatArray] = {}

    def copies(parameter: str, limb: str, link: str) -> Iterator[str]:
        kept = dict.fromkeys([parameter, *([f"{limb}.{parameter}"] if limb else []), f"{link}.{parameter}"])
        for copy in kept:
            twists.setdefault(copy, np.zeros((len(names), 6)))
            points.setdefault(copy, np.zeros(3))
            yield copy

    placed = {link: (turn[0], origin[0]) for link, (turn, origin) in frames(record, values[None]).items()}
    for place, (name, joint) in enumerate(record.joints.items()):
        for parameter, link, twist in _of_joint(record, joint, values, placed[joint.parent]):
            for copy in copies(parameter, name.rpartition(".")[0], link):
                twists[copy][place] += twist
    turn, _ = placed[record.platform.link]
    for parameter, shift in _of_point(record):
        for copy in copies(parameter, "", record.platform.link):
            points[copy] += turn @ shift
    order = {name: place for place, name in enumerate(record.parameters)}
    sorted_names = sorted(twists, key=lambda copy: (order[_parameter(copy)], copy.count("."), _of_link(record, copy)))
    return GeometryErrors(
        names=tuple(sorted_names),
        units=tuple(record.parameters[_parameter(copy)].unit for copy in sorted_names),
        joints=tuple(names),
        twists=np.array([twists[copy] for copy in sorted_names]).reshape(-1, len(names), 6),
        point=np.array([points[copy] for copy in sorted_names]).reshape(-1, 3),
    )


def _parameter(copy: str) -> str:
    return copy.rpartition(".")[2]


def _of_link(record: MechanismRecord, copy: str) -> bool:
    return copy.rpartition(".")[0] in record.links


def _of_joint(
    record: MechanismRecord, joint: Joint, values: FloatArray, parent: Frame
) -> Iterator[tuple[str, str, FloatArray]]:
    """Dimension, link and twist (6,) of a joint's child, for each dimension in either link, its parent standing so."""
    own = joint.written
    if own is None:
        return
    start = joint_graph(record).slices[joint.name]
    state = joint_state(joint.type, values[start][:, None])[:, 0].tolist()
    turn, origin = parent
    in_parent = _names_in([own.at, *own.axes, *([own.child_axis] if own.child_axis else [])])
    in_parent |= own.pitch.names if own.pitch else frozenset()
    in_child = _names_in([own.child_at])
    for link, names in ((joint.parent, in_parent), (joint.child, in_child)):
        for parameter in record.parameters:
            if parameter in names:
                below, above, size = _moved(record, joint.name, parameter, link == joint.child)
                (first, at_first), (second, at_second) = (_child(joint, part, state) for part in (below, above))
                spin = (second - first) @ (0.5 * (first + second)).T / size
                angular = 0.5 * np.array([spin[2, 1] - spin[1, 2], spin[0, 2] - spin[2, 0], spin[1, 0] - spin[0, 1]])
                shift = (at_second - at_first) / size - np.cross(angular, 0.5 * (at_first + at_second))
                turned = turn @ angular
                yield parameter, link, np.concatenate([turned, turn @ shift + np.cross(origin, turned)])


def _names_in(vectors: Sequence[WrittenVector]) -> frozenset[str]:
    """What is written in vectors, and in the turns of their limbs."""
    formulas = [part for vector in vectors for part in vector.parts]
    formulas += [part for vector in vectors if vector.limb for part in (*vector.limb.about, vector.limb.angle)]
    return frozenset().union(*(part.names for part in formulas))


@lru_cache(maxsize=1024)  # many poses of one mechanism ask
def _moved(
    record: MechanismRecord, name: str, parameter: str, in_child: bool
) -> tuple[JointGeometry, JointGeometry, float]:
    """A joint with a dimension a little less and a little more in one of its links, and how far these are apart."""
    joint = record.joints[name]
    step = STEP * max(abs(record.parameters[parameter].inside), _size(record, parameter))
    as_written = written_joint(joint, _reading(vars(record.values)))
    below, above = (
        written_joint(joint, _reading({**vars(record.values), parameter: record.parameters[parameter].inside + sense}))
        for sense in (-step, step)
    )
    if in_child:
        below, above = (replace(as_written, child_at=part.child_at) for part in (below, above))
    else:
        below, above = (replace(part, child_at=as_written.child_at) for part in (below, above))
    return below, above, 2.0 * step / _inside_unit(record, parameter)


def _of_point(record: MechanismRecord) -> Iterator[tuple[str, FloatArray]]:
    """Dimension, and how the platform's point moves (3,) in its frame."""
    written = record.platform.written
    for parameter in record.parameters if written else ():
        if written and parameter in _names_in([written]):
            step = STEP * max(abs(record.parameters[parameter].inside), _size(record, parameter))
            ends = [
                np.array(
                    written.vector(
                        _reading({**vars(record.values), parameter: record.parameters[parameter].inside + sense})
                    ),
                    dtype=float,
                )
                for sense in (-step, step)
            ]
            yield parameter, (ends[1] - ends[0]) / (2.0 * step) * _inside_unit(record, parameter)


def _size(record: MechanismRecord, parameter: str) -> float:
    """What moves joints about as far as they are apart: shares and angles are of size 1."""
    return characteristic_length(record) if record.parameters[parameter].unit == record.unit else 1.0


def _inside_unit(record: MechanismRecord, parameter: str) -> float:
    """What one of a dimension's unit is as formulas take it."""
    return float(np.radians(1.0)) if record.parameters[parameter].unit == "deg" else 1.0


def _reading(names: Mapping[str, float]) -> NumberReading:
    return NumberReading(names, FUNCTIONS, float)


def _child(joint: Joint, own: JointGeometry, state: Sequence[float]) -> tuple[FloatArray, FloatArray]:
    """Frame of the child in its parent's: orientation (3, 3) and origin (3,)."""
    turned, shift = joint.type.motion(own.axes, own.advance, state)
    orientation = np.array(turned, dtype=float) @ np.array(own.turn, dtype=float)
    at, child_at = (np.array(vector, dtype=float) for vector in (own.at, own.child_at))
    return orientation, at + np.array(shift, dtype=float) - orientation @ child_at
