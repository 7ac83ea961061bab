"""The direct and the inverse problem in closed form: every branch at once, over any batch."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from numpy.typing import ArrayLike

from assur.kinematics import border
from assur.kinematics.modes import Problem, all_modes, mode_signs, sign_axes, sign_names
from assur.kinematics.solutions import SolutionSet
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats


def direct(record: MechanismRecord, inputs: ArrayLike, mode: str | None = None) -> SolutionSet:
    """Every pose at inputs (..., n), in lengths and rad, in the file's order; or that of one assembly mode.

    Example: the inputs of Table 1 of Zeng et al. 2019 have four poses; row 3 of the table is the first.

    >>> from assur.model.registry import load_record
    >>> found = direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776])
    >>> len(found), found.complete_for
    (4, 'reduced')
    >>> next(iter(found)).pose.round(4)
    array([-15.4714,   9.6849, 456.3315])
    """
    given = border.checked(inputs, border.input_names(record), f"inputs of {record.name}")
    components = border.input_components(record, given.reshape(-1, given.shape[-1]))
    return _solve(record, "direct", given, components, mode)


def inverse(record: MechanismRecord, poses: ArrayLike, mode: str | None = None) -> SolutionSet:
    """All inputs at poses (..., m), in lengths and rad, in the file's order; or those of one working mode.

    Example: Table 2 of Zeng et al. 2019, row 4, is the working mode "++-++".

    >>> from assur.model.registry import load_record
    >>> found = inverse(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], mode="++-++")
    >>> next(iter(found)).inputs.round(3)
    array([ 162.691, -143.321,  -24.678])
    """
    given = border.checked(poses, record.platform.pose, f"pose of {record.name}")
    components = border.pose_components(record, given.reshape(-1, given.shape[-1]))
    return _solve(record, "inverse", given, components, mode)


def _solve(
    record: MechanismRecord,
    problem: Problem,
    given: np.ndarray,
    components: tuple[object, ...],
    mode: str | None,
) -> SolutionSet:
    form = closed_form_of(record)
    names = sign_names(record, problem)
    if mode is None:
        sign, shape = sign_axes(names), (2,) * len(names)
        asked = [mode_signs(record, problem, text) for text in all_modes(record, problem)]
    else:
        asked = [mode_signs(record, problem, mode)]
        sign, shape = SimpleNamespace(**dict(zip(names, map(float, asked[0]), strict=True))), ()
    kernel = form.direct if problem == "direct" else form.inverse
    with np.errstate(
        divide="ignore", invalid="ignore", over="ignore"
    ):  # where a margin degenerates; its status says so
        branch = kernel(Floats(), record.values, components, sign)
    return SolutionSet(record, problem, given, np.array(asked, dtype=np.int8), shape, branch)
