"""The linear equations that joint rates obey, over any number type: of the loops, and of the rates of the pose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.programs import Outputs
from assur.kinematics.pose import turning_of
from assur.model.pose import ANGLES, LENGTHS, Pose, rate_names
from assur.numerics import rotations
from assur.numerics.elimination import nothing
from assur.numerics.vectors import Vector, minus, plus, times

FloatArray = NDArray[np.float64]
TURNED = ("cos phi", "sin phi", "cos theta", "sin theta")
"""Given for poses with one or two angles."""


@dataclass(frozen=True)
class Equations:
    """What a configuration is asked for: "entry row,column", lengths in the mechanism's unit."""

    pose: Pose

    @property
    def given(self) -> tuple[str, ...]:
        """Names of what is given beside it."""
        return TURNED if angles_given(self.pose) else ()

    def __call__(self, configuration: Configuration, *numbers: Any) -> Outputs:
        """All entries that are not always zero."""
        given = dict(zip(self.given, numbers, strict=True))
        entries = equations(replace(configuration, rates={}), self.pose, given)
        return {f"entry {row},{column}": number for (row, column), number in entries.items()}


def angles_given(pose: Pose) -> bool:
    """Whether a pose has angles, but not all three."""
    return 0 < sum(name in ANGLES for name in pose) < len(ANGLES)


def equations(configuration: Configuration, pose: Pose, given: Mapping[str, Any]) -> dict[tuple[int, int], Any]:
    """Entries (row, column) of the loops, six rows each, at the points where they are cut, then of the pose's rates."""
    graph = configuration.graph
    entries: dict[tuple[int, int], Any] = {}
    for index, (cut, loop) in enumerate(zip(graph.cut, graph.loops, strict=True)):
        point = configuration.child_point(cut)
        for name, sense in ((cut.name, 1), *loop.items()):
            for row, column, number in configuration.entries(graph.joint(name), sense, point):
                entries[6 * index + row, column] = number
    _, point = configuration.platform
    first = 6 * len(graph.cut)
    for name, sense in graph.paths[graph.platform].items():
        for row, column, number in configuration.entries(graph.joint(name), sense, point):
            for place, own in enumerate(pose_rows(pose, given)):
                if row in own:
                    key = first + place, column
                    entries[key] = plus(entries.get(key, 0), times(own[row], number))
    return {key: number for key, number in entries.items() if not nothing(number)}


def pose_rows(pose: Pose, given: Mapping[str, Any]) -> list[dict[int, Any]]:
    """For each rate of the pose what it is of the platform's twist, angular velocity first.

    Where a pose has phi, theta and psi the rates are wx, wy and wz in their places.
    """
    rows = []
    for name in rate_names(pose):
        if name in LENGTHS:
            rows.append({3 + LENGTHS.index(name): 1})
        elif not angles_given(pose):
            rows.append({(ANGLES.index(name) if name in ANGLES else "xyz".index(name[-1])): 1})
        else:
            rows.append(_angle_row(name, given))
    return rows


def _angle_row(name: str, given: Mapping[str, Any]) -> dict[int, Any]:
    c, s, cosine, sine = (given[each] for each in TURNED)
    if name == "theta":
        return {0: -s, 1: c}
    if name == "psi":
        return {0: c / cosine, 1: s / cosine}
    return {0: c * sine / cosine, 1: s * sine / cosine, 2: 1}


def angle_changes(turning: Vector, given: Mapping[str, Any]) -> dict[str, Any]:
    """Second derivatives of phi, theta, psi at an angular velocity that does not change."""
    c, s, cosine, sine = (given[each] for each in TURNED)
    along = plus(times(c, turning[0]), times(s, turning[1]))
    across = minus(times(c, turning[1]), times(s, turning[0]))
    psi = along / cosine if not nothing(along) else 0
    phi = plus(turning[2], times(sine, psi))
    whole = plus(times(across, phi), times(times(psi, sine), across))
    second = whole / cosine if not nothing(whole) else 0
    return {
        "phi": plus(times(times(cosine, across), psi), times(sine, second)),
        "theta": minus(0, times(along, phi)),
        "psi": second,
    }


def angle_numbers(rotation: FloatArray) -> FloatArray:
    """The numbers (4, N) of `TURNED` at orientations (N, 3, 3)."""
    phi, theta, _ = rotations.to_angles(rotation)
    return np.array([np.cos(phi), np.sin(phi), np.cos(theta), np.sin(theta)])


def angular_motion(
    pose: Pose, rotation: FloatArray, velocity: FloatArray, acceleration: FloatArray
) -> list[FloatArray]:
    """Rates (N, k) of a pose with all three angles, and their rates, as angular velocities and accelerations."""
    phi, theta, _ = rotations.to_angles(rotation)
    turning = turning_of(pose, phi, theta)
    first, second = ((turning @ part[..., None])[..., 0] for part in (velocity, acceleration))
    own = [pose.index(name) for name in ANGLES]
    phi_rate, theta_rate, psi_rate = velocity[:, own].T
    c, s, cosine, sine = angle_numbers(rotation)
    second[:, own] += np.stack(
        [
            -c * phi_rate * theta_rate - (s * cosine * phi_rate + c * sine * theta_rate) * psi_rate,
            -s * phi_rate * theta_rate + (c * cosine * phi_rate - s * sine * theta_rate) * psi_rate,
            -cosine * theta_rate * psi_rate,
        ],
        axis=-1,
    )
    return [first, second]
