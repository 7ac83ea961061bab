"""The fourth law: a mode is named by the signs of the quantities that the mechanism's file names."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantities
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.modes import sign_names
from assur.kinematics.status import closed_form_of, scale
from assur.model.formula import Formula

FloatArray = NDArray[np.float64]

CLEAR = 1e-5
"""A quantity nearer to zero than this share of its scale says nothing of its sign: here two branches merge."""


def wrong_signs(solutions: Solutions) -> list[Mismatch]:
    """Signs that the closed form gives and the file's own quantities, of the joint graph, do not have."""
    if not len(solutions):
        return []
    record, form = solutions.record, closed_form_of(solutions.record)
    formulas: dict[str, Formula] = {**record.modes.working, **record.modes.assembly}
    names = list(formulas)
    graph = dict(zip(names, quantities(record, formulas.values(), solutions.joints), strict=True))
    mismatches = []
    for name in names:
        sign = form.signs[name]
        own = solutions.named[name] / scale(record, sign.scale)
        clear = (np.abs(own) > CLEAR) & (np.abs(graph[name]) > CLEAR * min(1.0, characteristic_length(record)))
        claimed = np.sign(own)
        asked = sign_names(record, solutions.problem)
        if name in asked:
            column = solutions.signs[:, asked.index(name)]
            clear &= column != 0
            claimed = np.where(column == np.sign(graph[name]), claimed, column)
        wrong = np.flatnonzero(clear & (claimed != np.sign(graph[name])))
        if len(wrong):
            mismatches.append(_told(solutions, name, formulas[name], graph[name], claimed, wrong))
    return mismatches


def _told(
    solutions: Solutions, name: str, formula: Formula, graph: FloatArray, claimed: FloatArray, wrong: NDArray[np.intp]
) -> Mismatch:
    record = solutions.record
    row = int(wrong[np.argmax(np.abs(graph[wrong]))])
    symbol = "+" if claimed[row] > 0 else "-"
    text = (
        f"the branch with {name} {symbol} has {formula.text} = {graph[row]:.6g}, in the {solutions.problem} problem at "
        f"{place_text(record, solutions.problem, solutions.given[row])}; "
        f"so of {len(wrong)} of {len(solutions)} solutions"
    )
    hint = "all of them: is the sign reversed?" if len(wrong) > len(solutions) / 2 else ""
    return Mismatch(
        "mode sign", name, solutions.problem, text, f"{name} is the sign of '{formula.text}' in [modes]", hint
    )
