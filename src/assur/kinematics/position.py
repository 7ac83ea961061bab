"""The direct and the inverse problem: in closed form where there is one, else on the joint graph."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.branches import Branches
from assur.kinematics.found import Found
from assur.kinematics.modes import Problem, all_modes, mode_signs, sign_axes, sign_names
from assur.kinematics.roots import roots_of
from assur.kinematics.search import search
from assur.kinematics.solutions import SolutionSet
from assur.kinematics.status import branch_kernel, closed_form_of
from assur.model.closed_form import Eliminant
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
Method = Literal["auto", "closed form", "search"]


def direct(record: MechanismRecord, inputs: ArrayLike, mode: str | None = None, method: Method = "auto") -> SolutionSet:
    """Every pose at inputs (..., n), in lengths and rad, in the file's order; or that of one assembly mode.

    Args:
        record: the mechanism.
        inputs: as printed.
        mode: an assembly mode; all of them by default.
        method: "closed form"; "search", on the joint graph from many starts, never known to be complete; by default
            the closed form where there is one.

    Errors:
        UsageError: inputs that are not n finite numbers, a closed form that there is not.
        UnknownNameError: a mode or a method that there is not.

    Example: the inputs of Table 1 of Zeng et al. 2019 have four poses; row 3 of the table is the first.

    >>> from assur.model.registry import load_record
    >>> found = direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776])
    >>> len(found), found.complete_for
    (4, 'reduced')
    >>> next(iter(found)).pose.round(4)
    array([-15.4714,   9.6849, 456.3315])
    """
    given = border.checked(inputs, border.input_names(record), f"inputs of {record.name}")
    return _answer(record, "direct", given, mode, method)


def inverse(record: MechanismRecord, poses: ArrayLike, mode: str | None = None, method: Method = "auto") -> SolutionSet:
    """All inputs at poses (..., m), in lengths and rad, in the file's order; or those of one working mode.

    Arguments and errors are as for `direct`.

    Example: Table 2 of Zeng et al. 2019, row 4, is the working mode "++-++".

    >>> from assur.model.registry import load_record
    >>> found = inverse(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], mode="++-++")
    >>> next(iter(found)).inputs.round(3)
    array([ 162.691, -143.321,  -24.678])
    """
    return _answer(record, "inverse", border.checked_poses(record, poses), mode, method)


def _answer(record: MechanismRecord, problem: Problem, given: FloatArray, mode: str | None, method: str) -> SolutionSet:
    if method not in get_args(Method):
        raise UnknownNameError("method", method, get_args(Method))
    form = record.closed_form
    kernel = None if form is None else form.direct if problem == "direct" else form.inverse
    if method == "closed form" and kernel is None:
        raise UsageError(f"{record.name} has no closed form of the {problem} problem", hint="leave the method out")
    if method == "search" or kernel is None:
        return _searched(record, problem, given, _numbered_mode(record, problem, mode))
    if isinstance(kernel, Eliminant):
        return roots_of(record, kernel, given, _numbered_mode(record, problem, mode))
    return _branches(record, problem, given, mode)


def _branches(record: MechanismRecord, problem: Problem, given: FloatArray, mode: str | None) -> Branches:
    """Every branch of a kernel, or the one of a mode."""
    form = closed_form_of(record)
    names = sign_names(record, problem)
    if mode is None:
        sign, shape = sign_axes(names), (2,) * len(names)
        asked = [mode_signs(record, problem, text) for text in all_modes(record, problem)]
    else:
        asked = [mode_signs(record, problem, mode)]
        sign, shape = SimpleNamespace(**dict(zip(names, map(float, asked[0]), strict=True))), ()
    flat = given.reshape(-1, given.shape[-1])
    components = border.input_components if problem == "direct" else border.pose_components
    kernel = branch_kernel(record) if problem == "direct" else form.inverse
    with np.errstate(
        divide="ignore", invalid="ignore", over="ignore"
    ):  # where a margin degenerates; its status says so
        branch = kernel(Floats(), record.values, components(record, flat), sign)
    return Branches(record, problem, given, np.array(asked, dtype=np.int8), shape, branch)


def _searched(record: MechanismRecord, problem: Problem, given: FloatArray, only: str) -> Found:
    """What a search on the joint graph finds, problem by problem."""
    found = [search(record, problem, one) for one in given.reshape(-1, given.shape[-1])]
    most = max((len(item.joints) for item in found), default=0)
    joints = np.full((len(found), most, len(record.coordinates)), np.nan)
    for row, item in zip(joints, found, strict=True):
        row[: len(item.joints)] = item.joints
    starts = found[0].starts if found else 0
    last = max((item.last_new for item in found), default=0)
    reason = f"not proved: a search from {starts} starts, of which number {last} found the last new assembly"
    batch = given.shape[:-1]
    nearest = np.array([item.nearest for item in found]).reshape(batch)
    return Found(record, problem, given, joints.reshape(*batch, *joints.shape[1:]), False, reason, nearest, only)


def _numbered_mode(record: MechanismRecord, problem: Problem, mode: str | None) -> str:
    """A mode as it may be asked of solutions that carry numbers: signs, a number, or both."""
    if mode is None:
        return ""
    count = len(sign_names(record, problem))
    if not re.fullmatch(rf"[+-]{{{count}}}(/[1-9]\d*)?" if count else r"[1-9]\d*", mode):
        signs = all_modes(record, problem) if count else ("1", "2")
        kind = "assembly mode" if problem == "direct" else "working mode"
        raise UnknownNameError(f"{kind} of {record.name}", mode, signs, hint="a number may follow, as in +/2")
    return mode
