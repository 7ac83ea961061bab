"""Evidence on the inverse problem and Table 2: E6."""

from __future__ import annotations

import numpy as np

from assur.audit.audit import reference_entry
from assur.audit.configurations import freedoms_with_inputs_locked, random_poses
from assur.audit.rows import Evidence
from assur.audit.tables import solve
from assur.kinematics.closure import closure_error
from assur.kinematics.modes import all_modes
from assur.kinematics.position import direct, inverse

CLOSE = 1e-6


def self_motion_rows(record):
    """E6: which rows of Table 2 move with every input locked, and which need P1 and P2 to pass each other."""
    table = reference_entry(record, "inverse", "Table 2")
    solutions = solve(record, "inverse", table.given)
    moving, passed, buildable = [], [], []
    for line in table.rows:
        row = np.array([item.value for item in line.values])
        solution = min(solutions, key=lambda item: np.linalg.norm(item.inputs - row))
        joints = np.array(list(solution.joints.values()))
        free = freedoms_with_inputs_locked(record, joints)
        if free:
            moving.append(line.row)
        if solution.inputs[0] <= solution.inputs[1]:
            passed.append(line.row)
        if not free and solution.inputs[0] > solution.inputs[1]:
            buildable.append(line.row)
    curves = direct(record, np.array([item.value for item in table.rows[0].values])).curves
    gaps = [float(np.max(closure_error(record, curve.joints()))) for curve in curves]
    lengths = [float(np.sum(np.linalg.norm(np.diff(curve.poses(), axis=0), axis=1))) for curve in curves]
    gap, length = max(gaps, default=0.0), max(lengths, default=0.0)
    in_motion, others = _modes_in_self_motion(record)
    return Evidence(
        moving == ["1", "2", "7", "8"]
        and passed == ["5", "6"]
        and buildable == ["3", "4"]
        and gap < CLOSE
        and length > 1
        and in_motion == (16, 16)
        and others == (0, 16),
        f"With every input locked the joint graph keeps a freedom at rows {', '.join(moving)} and none at "
        f"the others. From row 1 the platform runs along curves of up to {length:.0f} {record.unit} that "
        f"close the whole joint graph. yA1 < yA2 at rows {' and '.join(passed)}. Rows "
        f"{' and '.join(buildable)} are left. On random poses the joint graph keeps a freedom in all "
        f"{in_motion[0]} working modes with sign u1 = sign u2, and in {others[0]} of the {others[1]} "
        "others.",
        {"moving": moving, "passed": passed, "buildable": buildable, "length": length},
    )


def _modes_in_self_motion(record):
    """(modes that move with locked inputs, modes) for sign u1 = sign u2, and for the other modes."""
    found = inverse(record, random_poses(record, 400, np.random.default_rng(0)))
    regular = np.min([np.abs(found.factors[name]) for name in ("w", "v", "u1", "u2", "u3")], axis=0) > 5
    regular &= np.min([np.abs(found.factors[name]) for name in ("sin_alpha", "sin_beta")], axis=0) > 0.05
    regular &= np.abs(found.factors["sin_alpha_minus_beta"]) > 0.05
    names = list(record.modes.working)
    first, second = names.index("u1"), names.index("u2")
    tally = {True: [0, 0], False: [0, 0]}
    for branch, signs in enumerate(all_modes(record, "inverse")):
        rows = np.flatnonzero(found.exists[:, branch] & regular[:, branch])[:4]
        free = [freedoms_with_inputs_locked(record, found.joints[row, branch]) for row in rows]
        same = bool(signs[first] == signs[second])
        tally[same][0] += bool(free) and all(free)
        tally[same][1] += bool(free)
    return tuple(tally[True]), tuple(tally[False])
