"""Which solution of a problem is that of home's mode: by the signs that name it, else by following home there."""

from __future__ import annotations

import numpy as np

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.following.exclusion import MERGED
from assur.kinematics.following.home_marks import HomeSolution, marked_words
from assur.kinematics.home import home_values
from assur.kinematics.naming import declared_signs


def home_solution(solutions: SolutionSet) -> HomeSolution:
    """Which of the solutions of one problem is that of home's mode.

    With a closed form it is the one with the signs that name home's mode. Where its modes have no signs, or several
    solutions share them, and without a closed form, home is followed to it, straight.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> home_solution(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    HomeSolution(marks=(True, False, False, False), words='home: mode +++, by its signs')
    """
    labels = [str(label) for label in solutions.labels[solutions.exists]]
    if not labels:
        return HomeSolution((), "")
    if solutions.record.closed_form is not None:
        same = _signs_of_home(solutions)
        if same is not None and np.sum(same) <= 1:
            marks = tuple(bool(mark) for mark in same)
            return HomeSolution(marks, marked_words(labels, marks, "by its signs", "none of these, by their signs"))
    from assur.kinematics.following.home_by_path import home_by_path  # followers, which signs do without

    return home_by_path(solutions, labels)


def _signs_of_home(solutions: SolutionSet) -> np.ndarray[tuple[int], np.dtype[np.bool_]] | None:
    """Which solutions have all the signs that name home's mode; None where there are no such signs."""
    home = declared_signs(solutions.record, solutions.problem, home_values(solutions.record), MERGED)
    if not home.size or np.any(home == 0):
        return None
    listed = declared_signs(solutions.record, solutions.problem, solutions.joints[solutions.exists], MERGED)
    return np.asarray(np.all(listed == home, axis=1))
