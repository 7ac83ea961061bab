"""Which solution of a problem is that of home's mode: by the signs that name it, else by following home there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.home import home_values
from assur.kinematics.paths.course import Prescribed
from assur.kinematics.paths.exclusion import signs_of
from assur.kinematics.paths.home_mode import HomeMode, home_mode_at
from assur.kinematics.paths.path import WORDS
from assur.kinematics.turns import counted

MOST_TURNS = 20.0
"""Screws that have turned further are not followed: steps are a quarter of a rad, and an answer shall not wait."""


@dataclass(frozen=True)
class HomeSolution:
    """What is said of the listed solutions of one problem.

    Attributes:
        marks: for each of them whether it is that of home's mode; None where that is not decided.
        words: by what it is decided; empty where nothing is listed.
    """

    marks: tuple[bool | None, ...]
    words: str


def home_solution(found: SolutionSet) -> HomeSolution:
    """Which of the solutions of one problem is that of home's mode.

    With a closed form it is the one with the signs that name home's mode. Where its modes have no signs, or several
    solutions share them, and without a closed form, home is followed to it, straight.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> home_solution(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    HomeSolution(marks=(True, False, False, False), words='home: mode +++, by its signs')
    """
    labels = [str(label) for label in found.labels[found.exists]]
    if not labels:
        return HomeSolution((), "")
    if found.record.closed_form is not None:
        same = _signs_of_home(found)
        if same is not None and np.sum(same) <= 1:
            marks = tuple(bool(mark) for mark in same)
            return HomeSolution(marks, _words(labels, marks, "by its signs", "none of these, by their signs"))
    if _turns_away(found) > MOST_TURNS:
        return HomeSolution((None,) * len(labels), "home: not decided, as a screw is too many turns from home")
    there = _followed(found)
    if there.never:
        return HomeSolution((False,) * len(labels), f"home: none of these, which is proved: {there.never}")
    if there.joints is None:
        before = f" before {WORDS[there.stopped.kind]}" if there.stopped is not None else ""
        return HomeSolution((None,) * len(labels), f"home: not decided, as the straight path from home stops{before}")
    marks = tuple(there.is_home(found.record, joints) for joints in found.joints[found.exists])
    return HomeSolution(marks, _words(labels, marks, "followed straight from home", "none of these, followed straight"))


def _turns_away(found: SolutionSet) -> float:
    """By how many turns the screws of the solution that is nearest in this have left home."""
    away = np.abs(found.joints[found.exists] - home_values(found.record))[:, counted(found.record)]
    return float(np.min(np.max(away, axis=1, initial=0.0))) / (2 * np.pi)


def _words(labels: list[str], marks: tuple[bool, ...], how: str, none: str) -> str:
    own = [label for label, mark in zip(labels, marks, strict=True) if mark]
    return f"home: mode {', '.join(own)}, {how}" if own else f"home: {none}"


def _signs_of_home(found: SolutionSet) -> np.ndarray[tuple[int], np.dtype[np.bool_]] | None:
    """Which solutions have all the signs that name home's mode; None where there are no such signs."""
    home = signs_of(found.record, found.problem, home_values(found.record)[None])
    if not home.size or np.any(home == 0):
        return None
    listed = signs_of(found.record, found.problem, found.joints[found.exists])
    return np.asarray(np.all(listed == home, axis=1))


def _followed(found: SolutionSet) -> HomeMode:
    """Home's mode at what is given, by the straight way; solutions of one mode alone prove nothing of the others."""
    prescribed: Prescribed = "inputs" if found.problem == "direct" else "poses"
    return home_mode_at(found.record, found.given, prescribed, detours=0, known=found)
