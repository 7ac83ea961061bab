"""At which poses to measure: drawn anywhere in the workspace's box, and of many the set that shows most.

Poses are exchanged one at a time, each for the one that raises an index most, until none does (Mitchell 1974).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.calibration.identification import INDICES, Identification, indices
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
DRAWN = 40
"""Poses that are tried for each that is wanted."""
ROUNDS = 20
BETTER = 1e-6
"""Share by which an exchange must raise the index."""


def chosen(known: Identification, count: int, index: str = "O1") -> NDArray[np.int64]:
    """Which `count` of the poses show best what all of them tell, by O1 to O5; the first ones where so few tell less.

    Errors:
        UnknownNameError: an index that there is not.

    >>> from assur.machine.calibration.identification import identification
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> drawn = random_poses(record, 12)
    >>> sets = chosen(identification(record, drawn), 4), range(4)
    >>> best, first = (identification(record, drawn[rows]) for rows in sets)
    >>> best.observability["O1"] > 1.05 * first.observability["O1"]
    True
    """
    if index not in INDICES:
        raise UnknownNameError("index of observability", index, INDICES)
    total = len(known.poses)
    right = np.linalg.svd(known.matrix * known.scales, full_matrices=False)[2][: known.rank]
    rows = ((known.matrix * known.scales) @ right.T).reshape(total, -1, known.rank)
    squares = np.einsum("nki,nkj->nij", rows, rows)  # of each pose, in the combinations that are told
    own = list(range(count))
    if count * rows.shape[1] < known.rank:
        return np.array(own)
    best = _index(squares[own].sum(axis=0), count, index)
    for _ in range(ROUNDS):
        before = best
        for place in range(count):
            others = [k for k in range(total) if k not in own]
            if not others:
                break
            rest = squares[own].sum(axis=0) - squares[own[place]]
            tried = _index(rest + squares[others], count, index)
            if tried.max() > best * (1.0 + BETTER):
                own[place], best = others[int(np.argmax(tried))], tried.max()
        if best <= before * (1.0 + BETTER):
            break
    return np.sort(np.array(own))


def _index(squares: FloatArray, poses: int, index: str) -> FloatArray:
    """An index (...) of sums (..., r, r) of squares."""
    sizes = np.sqrt(np.maximum(np.linalg.eigvalsh(squares)[..., ::-1], 0.0))
    return indices(sizes, poses)[index]


def random_poses(record: MechanismRecord, count: int, mode: str | None = None, seed: int = 0) -> FloatArray:
    """Poses (count, m) that a working mode reaches and its inputs hold, anywhere in the file's box, else about home.

    Errors:
        UsageError: so many are not met.
    """
    random = np.random.default_rng(seed)
    home = pose_of(record, home_values(record))
    size = 0.2 * characteristic_length(record)
    kept: list[FloatArray] = []
    for _ in range(DRAWN):
        drawn = np.tile(home, (count, 1))
        for place, name in enumerate(record.platform.pose):
            about = (home[place] - size, home[place] + size)
            low, high = record.box.get(name, about if name in LENGTHS else (home[place], home[place]))
            drawn[:, place] = random.uniform(low, high, size=count)
        joints = joints_in_mode(record, drawn, mode)
        for pose, values in zip(drawn, joints, strict=True):
            if np.all(np.isfinite(values)) and pose_errors_at(record, values, bent=False).status == Status.regular:
                kept.append(pose)
        if len(kept) >= count:
            return np.array(kept[:count])
    raise UsageError(f"{record.name}: {len(kept)} of {count} poses are met", hint="give poses in a file: --poses FILE")
