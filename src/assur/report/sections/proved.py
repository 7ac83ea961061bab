"""What is proved of the answers to both problems: their number, that there is no other, and within what bounds."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.result import CertifiedSolutions, ProvedSolution
from assur.kinematics.modes import Problem
from assur.kinematics.turns import periodic_drives
from assur.model.pose import QUATERNION, is_angle
from assur.numerics import rotations
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, PROVED
from assur.results.typeset_text import short, shown_unit

FloatArray = NDArray[np.float64]


def right(findings: Findings, problem: Problem) -> tuple[str, float | None, float | None]:
    """By what right the number of solutions is known, and its bounds: None where there is none."""
    answer = findings.direct if problem == "direct" else findings.inverse
    proof = findings.proved[problem]
    if isinstance(proof, str):
        return (f"{FLOATING}, every branch" if answer.complete else "not proved to be all"), None, None
    count = float(len(proof))
    if not proof.proved and not proof.undecided and answer.complete and len(proof) == len(answer):
        each = f"{PROVED} for the independent equations" if any(box.left for box in proof) else f"{PROVED} one by one"
        return f"{each}; that there is no other, in {FLOATING}", count, None
    if not proof.proved:
        return f"not proved to be all: {proof.headline}", count, None
    if len(proof) != len(answer):
        return f"not proved: {len(answer)} in floating point, but {proof.headline}", count, count
    return f"{PROVED}: these and no other", count, count


def proof_words(findings: Findings, problem: Problem) -> str:
    """What the certificate says, and how far the solutions in floating point are from it."""
    proof = findings.proved[problem]
    if isinstance(proof, str):
        return f"Nothing is proved of these solutions: {proof}."
    headline = proof.headline.replace("proved, ", "proved: ", 1) if proof.proved else proof.headline
    model = "joint graph" if proof.complete_for == "joint_graph" else "reduced model"
    of_what = f" of the {model}" if proof.proved else ""
    said = f"{headline[0].upper()}{headline[1:]}{of_what}. By what right: {proof.right}."
    doubts = Counter(f"{verdict.name}: {verdict.meaning}" for verdict in proof.undecided)
    if doubts:
        said += f" Undecided: {'; '.join(text + (f' ({n} times)' if n > 1 else '') for text, n in doubts.items())}."
    return f"{said} {_widths(findings, problem, proof)}" if len(proof) else said


def _widths(findings: Findings, problem: Problem, proof: CertifiedSolutions) -> str:
    unit = f"{shown_unit(findings.record.unit)} or rad"
    answer = findings.direct if problem == "direct" else findings.inverse
    width = short(max(proved.width for proved in proof), 2)
    said = f"Each is the only one of its mode within bounds at most {width} {unit} wide"
    if not len(answer):
        return f"{said}; in floating point none was found."
    farthest = max(
        min(
            _apart(findings, problem, solution.pose if problem == "direct" else solution.inputs, proved)
            for proved in proof
        )
        for solution in answer
    )
    distance = f"at most {short(farthest, 2)} {unit} off them" if farthest else "within them"
    return f"{said}; the solutions in floating point lie {distance}."


def _apart(findings: Findings, problem: Problem, values: FloatArray, proved: ProvedSolution) -> float:
    """How far values (k,) lie outside proved bounds; angles but for whole turns, quaternions but for their sign."""
    record = findings.record
    bounds = proved.pose if problem == "direct" else proved.inputs
    names = record.platform.pose if problem == "direct" else ()
    angles = np.array([is_angle(name) for name in names]) if names else periodic_drives(record)
    middle, half = 0.5 * (bounds.low + bounds.high), 0.5 * bounds.width
    turned = np.array([-1.0 if name in QUATERNION else 1.0 for name in names]) if names else np.ones(len(values))
    away = []
    for sign in (np.ones(len(values)), turned):
        difference = sign * values - middle
        difference = np.where(angles, rotations.nearest_turn(difference), difference)
        away.append(float(np.max(np.maximum(np.abs(difference) - half, 0.0), initial=0.0)))
    return min(away)
