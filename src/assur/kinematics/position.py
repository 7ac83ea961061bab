"""The direct and the inverse problem: in closed form where there is one, else on the joint graph."""

from __future__ import annotations

import itertools
import re
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closed_form.branches import Branches, branches
from assur.kinematics.modes import Method, Problem, all_modes
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
MOST_SIGNS = 5
"""Signs up to which every mode is listed where an unknown one is refused."""


def direct(
    record: MechanismRecord,
    inputs: ArrayLike,
    mode: str | None = None,
    method: Method = "auto",
    *,
    crossed: bool = False,
) -> SolutionSet:
    """Every pose at inputs (..., n), in lengths and rad, in the file's order; or that of one assembly mode.

    Args:
        record: the mechanism.
        inputs: as printed; where the file has redundant ones they may be given too, and only poses that have them
            answer.
        mode: an assembly mode; all of them by default.
        method: "closed form"; on the joint graph "loops", one after another as the theory orders them, complete where
            it says so, or "search" from many starts, never known to be complete. By default the
            closed form where there is one, else the loops where they are complete, else a search. A single problem
            that the roots of a polynomial leave open goes to the loops too.
        crossed: whether parallelograms may cross over; a mode says which do ("+++~Pa1"). Otherwise such assemblies are
            left out, and the answer says how many a search met; unless home is one of them.

    Errors:
        UsageError: inputs that are not n finite numbers, a closed form that there is not.
        UnknownNameError: a mode or a method that there is not.
        MechanismFileError: on the joint graph, where the file has a fault that only shows there
            (`assur check`).

    Example: the inputs of Table 1 of Zeng et al. 2019 have four poses; row 3 of the table is the first.

    >>> from assur.model.registry import load_record
    >>> found = direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776])
    >>> len(found), found.complete_for
    (4, 'reduced')
    >>> next(iter(found)).pose.round(4)
    array([-15.4714,   9.6849, 456.3315])
    """
    given = border.checked_inputs(record, inputs)
    count = len(record.inputs)
    solutions = _answer(record, "direct", given[..., :count], mode, method, crossed)
    if given.shape[-1] == count:
        return solutions
    from assur.kinematics.answers.agreeing_solutions import AgreeingSolutions  # redundant inputs are rare

    return AgreeingSolutions(solutions, given)


def inverse(
    record: MechanismRecord,
    poses: ArrayLike,
    mode: str | None = None,
    method: Method = "auto",
    *,
    crossed: bool = False,
) -> SolutionSet:
    """All inputs at poses (..., m), in lengths and rad, in the file's order; or those of one working mode.

    Arguments and errors are as for `direct`.

    Example: Table 2 of Zeng et al. 2019, row 4, is the working mode "++-++".

    >>> from assur.model.registry import load_record
    >>> found = inverse(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], mode="++-++")
    >>> next(iter(found)).inputs.round(3)
    array([ 162.691, -143.321,  -24.678])
    """
    return _answer(record, "inverse", border.checked_poses(record, poses), mode, method, crossed)


def branches_at(record: MechanismRecord, poses: ArrayLike, mode: str) -> Branches:
    """The closed form of the inverse problem at poses (..., m) in one working mode: one reading of its kernel.

    >>> from assur.model.registry import load_record
    >>> branches_at(load_record("fivebar"), [[0.0, 200.0], [0.0, 900.0]], "-+").exists[:, 0]
    array([ True, False])
    """
    return branches(record, "inverse", border.checked_poses(record, poses), mode)


def modes_at(record: MechanismRecord, problem: Problem, given: FloatArray) -> tuple[str, ...]:
    """The modes of all solutions that are known at inputs, or at a pose (m,).

    >>> from assur.model.registry import load_record
    >>> modes_at(load_record("fivebar"), "inverse", np.array([0.0, 200.0]))
    ('++', '+-', '-+', '--')
    """
    solutions = _answer(record, problem, given, None, "auto", crossed=False)
    return tuple(str(label) for label in solutions.labels[solutions.exists])


def branch_count(record: MechanismRecord, problem: Problem) -> int:
    """How many branches, real or not, the closed form of a problem has.

    >>> from assur.model.registry import load_record
    >>> branch_count(load_record("zeng2019"), "inverse"), branch_count(load_record("planar_3rpr"), "direct")
    (32, 6)
    """
    kernel = closed_form_of(record).direct
    if problem == "direct" and kernel is not None and not callable(kernel):
        return kernel.degree
    return len(all_modes(record, problem))


def _answer(
    record: MechanismRecord, problem: Problem, given: FloatArray, mode: str | None, method: Method, crossed: bool
) -> SolutionSet:
    if method not in get_args(Method):
        raise UnknownNameError("method", method, get_args(Method))
    form = record.closed_form
    kernel = None if form is None else form.direct if problem == "direct" else form.inverse
    if method == "closed form" and kernel is None:
        raise UsageError(f"{record.name} has no closed form of the {problem} problem", hint="leave the method out")
    if method == "closed form" and crossed:
        raise UsageError("crossed parallelograms are found on the joint graph", hint="leave the method out")
    if kernel is not None and method not in ("loops", "search") and not crossed:
        if not isinstance(kernel, Eliminant | PolynomialSystem):
            if mode is not None and mode.isdecimal():
                checked_mode(record, problem, mode, given, method)  # which refuses it, with its new name
            return branches(record, problem, given, mode)
        from assur.kinematics.closed_form.polynomials import polynomial_solutions  # no branch needs it

        return polynomial_solutions(record, kernel, given, checked_mode(record, problem, mode, given, method), method)
    from assur.kinematics.assemblies import assemblies  # loops and searches, which no closed form needs

    return assemblies(
        record, problem, given, checked_mode(record, problem, mode, given, method), method, crossed=crossed
    )


def checked_mode(
    record: MechanismRecord,
    problem: Problem,
    mode: str | None,
    given: FloatArray | None = None,
    method: Method = "auto",
) -> str:
    """A mode as it may be asked of solutions on the joint graph: signs, a letter of those that share them, or both.

    Errors:
        UnknownNameError: it is none. A number names none; the refusal says which name the solution has that it counted
            where it was asked, or at home where it was asked of many problems at once.
    """
    if mode is None:
        return ""
    from assur.kinematics.naming import sign_meanings  # blocks of the joint graph, which a closed form does without

    names = list(sign_meanings(record, problem))
    if not re.fullmatch(rf"[-+0]{{{len(names)}}}[a-z]{{0,2}}(~[\w.]+)*", mode):
        if len(names) > MOST_SIGNS:
            choices = [f"rows of {len(names)} signs"]
        else:
            choices = ["".join(signs) for signs in itertools.product("+-", repeat=len(names))]
        each = f"one sign + or - for each of: {', '.join(names)}; " if names else ""
        hint = f"{each}a letter may follow, as in {'+' * len(names)}a, where several solutions share them"
        now = renamed(record, problem, mode, given, method)
        hint = f"{hint}; {now}" if now else hint
        raise UnknownNameError(f"{_kind(problem)} of {record.name}", mode, choices if names else ["a", "b"], hint=hint)
    return mode


def renamed(
    record: MechanismRecord, problem: Problem, mode: str, given: FloatArray | None = None, method: Method = "auto"
) -> str:
    """What a mode is called that is given by a number, of all solutions or of those that share signs; "" of others.

    >>> from assur.model.registry import load_record
    >>> renamed(load_record("fivebar"), "inverse", "1"), renamed(load_record("fivebar"), "inverse", "++")
    ('a number is no name: at home number 1 is now ++', '')
    """
    numbered = re.fullmatch(r"([-+0]*)/?([1-9]\d{0,3})", mode)
    if not numbered:
        return ""
    one = given is not None and given.size == given.shape[-1]
    asked = given.reshape(-1) if given is not None and one else _home(record, problem)
    solutions = _answer(record, problem, asked, None, method, crossed=False)
    labels = [str(label) for label in solutions.labels[solutions.exists]]
    alike, number = [label for label in labels if label.startswith(numbered[1])], int(numbered[2])
    known = (
        f"number {mode} is now {alike[number - 1] or 'the one mode, which needs no name'}"
        if number <= len(alike)
        else f"of {mode} there is none"
    )
    return f"a number is no name: {'where this was asked' if one else 'at home'} {known}"


def _home(record: MechanismRecord, problem: Problem) -> FloatArray:
    """Home's pose (m,), or its inputs (k,)."""
    from assur.kinematics.home import home_values  # loops are closed there, which few answers need
    from assur.kinematics.pose import pose_of

    home = home_values(record)
    return pose_of(record, home) if problem == "inverse" else border.inputs_of(record, home)


def _kind(problem: Problem) -> str:
    return "assembly mode" if problem == "direct" else "working mode"
