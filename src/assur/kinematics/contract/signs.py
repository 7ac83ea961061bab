"""The fourth law: a mode is named by the signs of the quantities that the mechanism's file names."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantities
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.modes import Problem, sign_names, written_quantities
from assur.kinematics.naming import declared_signs, sign_meanings
from assur.kinematics.status import closed_form_of, scale

FloatArray = NDArray[np.float64]

PROBLEMS: tuple[Problem, Problem] = ("inverse", "direct")
CLEAR = 1e-5
"""A quantity nearer to zero than this share of its scale says nothing of its sign: here two branches merge."""


def wrong_signs(solutions: Solutions) -> list[Mismatch]:
    """Signs that the closed form gives and the joint graph does not have; names that are not the joint graph's."""
    if not len(solutions):
        return []
    record, form = solutions.record, closed_form_of(solutions.record)
    mismatches = _other_names(solutions)
    if mismatches:
        return mismatches
    for name, graph, meaning in _of_joint_graph(solutions):
        sign = form.signs[name]
        own = solutions.named[name] / scale(record, sign.scale)
        clear = (np.abs(own) > CLEAR) & (np.abs(graph) > CLEAR * min(1.0, characteristic_length(record)))
        claimed = np.sign(own)
        asked = sign_names(record, solutions.problem)
        if name in asked:
            column = solutions.signs[:, asked.index(name)]
            clear &= column != 0
            claimed = np.where(column == np.sign(graph), claimed, column)
        wrong = np.flatnonzero(clear & (claimed != np.sign(graph)))
        if len(wrong):
            mismatches.append(_told(solutions, name, meaning, graph, claimed, wrong))
    return mismatches


def _other_names(solutions: Solutions) -> list[Mismatch]:
    """Where a closed form names modes that the file leaves nameless, and by other names than the joint graph does."""
    mismatches = []
    for problem in PROBLEMS:
        named = sign_names(solutions.record, problem)
        if not named or written_quantities(solutions.record, problem):
            continue
        own = tuple(sign_meanings(solutions.record, problem))
        if named != own:
            allowed = f"the joint graph names the modes by {', '.join(own) or 'no sign'}"
            mismatches.append(
                Mismatch("mode sign", next(iter(named), ""), problem, f"names {', '.join(named)}", allowed)
            )
    return mismatches


def _of_joint_graph(solutions: Solutions) -> Iterator[tuple[str, FloatArray, str]]:
    """Name, values (S,) and meaning of each quantity of the joint graph whose sign names modes, of both problems.

    Of a closing block the value is the sign alone.
    """
    record, joints = solutions.record, solutions.joints
    for problem in PROBLEMS:
        if not sign_names(record, problem):
            continue
        written = written_quantities(record, problem)
        meanings = {name: f"'{formula.text}' in [modes]" for name, formula in written.items()}
        if written:
            columns = list(quantities(record, written.values(), joints))
        else:
            meanings = {name: f"where {meaning}" for name, meaning in sign_meanings(record, problem).items()}
            columns = list(declared_signs(record, problem, joints).T.astype(float))
        yield from zip(meanings, columns, meanings.values(), strict=True)


def _told(
    solutions: Solutions, name: str, meaning: str, graph: FloatArray, claimed: FloatArray, wrong: NDArray[np.intp]
) -> Mismatch:
    record = solutions.record
    row = int(wrong[np.argmax(np.abs(graph[wrong]))])
    symbol = "+" if claimed[row] > 0 else "-"
    text = (
        f"the branch with {name} {symbol} has {graph[row]:.6g} for it on the joint graph, "
        f"in the {solutions.problem} problem at {place_text(record, solutions.problem, solutions.given[row])}; "
        f"so of {len(wrong)} of {len(solutions)} solutions"
    )
    hint = "all of them: is the sign reversed?" if len(wrong) > len(solutions) / 2 else ""
    return Mismatch("mode sign", name, solutions.problem, text, f"{name} is the sign of {meaning}", hint)
