"""Which solution of a problem is that of home's mode, by following home straight to it."""

from __future__ import annotations

import numpy as np

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.home_marks import HomeSolution, marked_words
from assur.kinematics.following.home_mode import HomeMode, home_mode_at
from assur.kinematics.following.path import WORDS
from assur.kinematics.home import home_values
from assur.kinematics.turns import counted

MOST_TURNS = 20.0
"""Screws that have turned further are not followed: steps are a quarter of a rad, and an answer shall not wait."""


def home_by_path(solutions: SolutionSet, labels: list[str]) -> HomeSolution:
    """Which of the listed solutions, of these labels, home is followed to."""
    if _turns_away(solutions) > MOST_TURNS:
        return HomeSolution((None,) * len(labels), "home: not decided, as a screw is too many turns from home")
    there = _followed(solutions)
    if there.never:
        return HomeSolution((False,) * len(labels), f"home: none of these, which is proved: {there.never}")
    if there.joints is None:
        before = f" before {WORDS[there.stopped.kind]}" if there.stopped is not None else ""
        return HomeSolution((None,) * len(labels), f"home: not decided, as the straight path from home stops{before}")
    marks = tuple(there.is_home(solutions.record, joints) for joints in solutions.joints[solutions.exists])
    words = marked_words(labels, marks, there.how, f"none of these, {there.how}")
    return HomeSolution(marks, words)


def _turns_away(solutions: SolutionSet) -> float:
    """By how many turns the screws of the solution that is nearest in this have left home."""
    away = np.abs(solutions.joints[solutions.exists] - home_values(solutions.record))[:, counted(solutions.record)]
    return float(np.min(np.max(away, axis=1, initial=0.0))) / (2 * np.pi)


def _followed(solutions: SolutionSet) -> HomeMode:
    """Home's mode at what is given, by the straight way; solutions of one mode alone prove nothing of the others."""
    prescribed: Prescribed = "inputs" if solutions.problem == "direct" else "poses"
    record, given = solutions.record, solutions.given
    goal = given if prescribed == "poses" else given[: len(record.inputs)]  # redundant inputs follow
    return home_mode_at(record, goal, prescribed, detours=0, known=solutions)
