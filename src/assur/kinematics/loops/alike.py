"""Links that the loops themselves keep from turning against each other, as equal cranks on two bodies that do not turn.

Their circles are one: else they are a set of as many equations as unknowns, of which half say the same.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np

from assur.kinematics.loops.circles import UNUSED, System
from assur.kinematics.loops.equations import independent, without
from assur.kinematics.loops.orientations import EXACT
from assur.kinematics.loops.unknowns import UnknownGroup
from assur.numerics import rotations


def alike_merged(system: System) -> System:
    """The same equations, circles that are one by the linear equations alone taken as one."""
    used = [group.circle for group in system.groups if group.kind != "circle"]
    circles = [group for group in system.groups if group.kind == "circle" and group.circle not in used]
    for first, second in combinations(circles, 2):
        if first in system.groups and second in system.groups:
            ratio = _ratio(system, first, second)
            system = system if ratio is None else _merged(system, first, second, ratio)
    return system


def _ratio(system: System, first: UnknownGroup, second: UnknownGroup) -> complex | None:
    """The ratio z' / z of two circles about one direction, where the equations in which nothing else occurs give it."""
    axes = {turning.circle: turning.axis for turning in system.turnings.values()}
    near, far = axes[first.circle // 2], axes[second.circle // 2]
    if near is None or far is None or near @ far < 1.0 - EXACT:
        return None
    own = [0, *first.columns, *second.columns]
    rows = without(system.matrix, [k for k in range(system.matrix.shape[1]) if k not in own])
    rows = independent(rows[:, own])
    if len(rows) != 2 or np.max(np.abs(rows[:, 0])) > UNUSED or np.linalg.cond(rows[:, 3:]) > 1 / UNUSED:
        return None
    both = -np.linalg.solve(rows[:, 3:], rows[:, 1:3])  # (z', z~') from (z, z~)
    off = abs(both[0, 1]) + abs(both[1, 0]) + abs(abs(both[0, 0]) - 1.0)
    return complex(both[0, 0]) if off < UNUSED else None


def _merged(system: System, first: UnknownGroup, second: UnknownGroup, ratio: complex) -> System:
    matrix = system.matrix.copy()
    matrix[:, list(first.columns)] += matrix[:, list(second.columns)] * [ratio, np.conj(ratio)]
    matrix[:, list(second.columns)] = 0.0
    turnings = dict(system.turnings)
    for link, turning in system.turnings.items():
        if turning.circle == second.circle // 2 and turning.axis is not None:
            more = rotations.about_axis(turning.axis, np.asarray(np.angle(ratio)))
            turnings[link] = replace(turning, circle=first.circle // 2, rotation=more @ turning.rotation)
    groups = tuple(group for group in system.groups if group is not second)
    return replace(system, matrix=matrix, groups=groups, turnings=turnings)
