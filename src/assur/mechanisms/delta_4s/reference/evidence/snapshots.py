"""Evidence on the snapshot examples: E1 and E2."""

from __future__ import annotations

import math

import numpy as np

from assur.audit.audit import reference_entry
from assur.audit.rows import Evidence
from assur.audit.tables import solve
from assur.kinematics.modes import Problem

EXAMPLES: tuple[tuple[Problem, str], ...] = (
    ("inverse", "Nominal"),
    ("inverse", "General"),
    ("direct", "Nominal"),
    ("direct", "General"),
)


def chosen(record):
    """E1: in which modes the printed solutions are, and how many there are."""
    modes, counts = [], []
    for problem, place in EXAMPLES:
        table = reference_entry(record, problem, f"{place} position, {problem}")
        row = np.array([item.value for item in table.rows[0].values])
        solutions = solve(record, problem, table.given)
        results = [np.degrees(item.inputs) if problem == "inverse" else item.pose for item in solutions]
        nearest = int(np.argmin([np.linalg.norm(result - row) for result in results]))
        modes.append(solutions[nearest].mode)
        counts.append(len(solutions))
    return Evidence(
        modes == ["+++", "+++", "+", "+"] and counts == [8, 8, 2, 2],
        f"The four printed solutions are in the modes {', '.join(modes)}; there are {counts} of them.",
        {"modes": modes, "counts": counts},
    )


def rounded_dimensions(record):
    """E2: height at horizontal arms and angle at z = -0.9, by the triangle of a leg, with two sizes of the platform."""
    p = record.values
    heights = [-math.sqrt(p.l**2 - (p.L + p.wB - corner) ** 2) for corner in (p.uP, 0.044)]
    angles = [_angle(p, p.wB - corner, 0.9) for corner in (p.uP, 0.044)]
    return Evidence(
        [round(value, 3) for value in heights] == [-1.064, -1.065]
        and [round(value, 1) for value in angles] == [-20.5, -20.6],
        f"With uP = {p.uP:.5f} m the height is {heights[0]:.5f} m and the angle {angles[0]:.3f} deg; "
        f"with uP = 0.044 m they are {heights[1]:.5f} m and {angles[1]:.3f} deg.",
        {"heights": heights, "angles": angles},
    )


def _angle(p, inwards, depth):
    """Angle of an arm in deg by the law of cosines, the rods' lower end lying inwards of the motor and below it."""
    far = math.hypot(inwards, depth)
    corner = math.acos((p.L**2 + far**2 - p.l**2) / (2 * p.L * far))
    return math.degrees(math.atan2(depth, -inwards) - corner)
