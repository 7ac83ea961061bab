"""Signs of the quantities by which the file names modes, read off joint values."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantities
from assur.kinematics.modes import Problem, mode_text, written_quantities
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def named_signs(record: MechanismRecord, problem: Problem, joints: FloatArray, zero: float = 0.0) -> NDArray[np.int8]:
    """Signs (..., s) of the quantities that name the modes of a problem in the file, at joint values (..., n).

    0 where one vanishes: within `zero`, in rad or as a share of the characteristic length.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> named_signs(record, "inverse", home_values(record)).tolist()
    [-1, 1]
    """
    formulas = written_quantities(record, problem)
    signs = np.zeros((*joints.shape[:-1], len(formulas)), dtype=np.int8)
    bound = zero * max(1.0, characteristic_length(record))
    for k, values in enumerate(quantities(record, formulas.values(), joints)):
        signs[..., k] = np.where(np.abs(values) > bound, np.sign(values), 0)
    return signs


def written_modes(record: MechanismRecord, joints: FloatArray) -> tuple[str, str]:
    """Working and assembly mode of joint values (n,) by the file's quantities; "" where it names none."""
    return mode_text(named_signs(record, "inverse", joints)), mode_text(named_signs(record, "direct", joints))
