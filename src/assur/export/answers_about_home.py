"""Problems about home with what NumPy answers, by which a file that is written tests itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
COUNT = 8
"""Poses about home."""
DOUBTFUL = {
    "direct": (Status.self_motion, Status.not_closed, Status.undecided),
    "inverse": (Status.not_closed, Status.undecided),
}
"""What no branch of an answer by which a file is tested may be."""


def answers_about_home(record: MechanismRecord, problem: Problem) -> Iterator[tuple[FloatArray, list[FloatArray]]]:
    """What is given, inputs (n,) or a pose (m,), and all answers: poses (m,) or inputs (n,).

    >>> from assur.model.registry import load_record
    >>> [len(answers) for _, answers in answers_about_home(load_record("fivebar"), "direct")]
    [2, 2, 2, 2, 2, 2, 2, 2]
    """
    home, random = pose_of(record, home_values(record)), np.random.default_rng(0)
    poses = home + 0.02 * np.maximum(np.abs(home), 0.1) * random.uniform(-1.0, 1.0, (COUNT, len(home)))
    solve: Any = direct if problem == "direct" else inverse
    for pose in checked_poses(record, poses):
        given = np.asarray(pose)
        if problem == "direct":
            inputs = inverse(record, pose, method="closed form")
            if not len(inputs):
                continue
            given = np.asarray(next(iter(inputs)).inputs)
        answers = solve(record, given, method="closed form")
        if not np.any(np.isin(answers.status, DOUBTFUL[problem])):
            yield given, [np.asarray(own.pose if problem == "direct" else own.inputs) for own in answers]
