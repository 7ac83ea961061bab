"""Dexterity: how evenly the inputs move the platform, here and over the workspace."""

from __future__ import annotations

import numpy as np

from assur.kinematics.rates.units import unit_length
from assur.performance.indices import INDICES, indices, indices_at
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, Scalar, Section, Table
from assur.results.typeset_text import short

SPREAD = "estimate: spread of eight independent shifts"
COUNT = 4096
SEED = 5
SHARES = (0, 10, 25, 50, 75, 90, 100)
PICTURES = ("dexterity", "fastest", "slowest", "transmission", "manipulability", "indices")


def performance(findings: Findings) -> Section:
    """Local condition index, its mean over the workspace, velocity factors."""
    if findings.record.closed_form is None:
        return _of_the_joint_graph(findings)
    record, solution = findings.record, findings.solution
    found = indices(record, solution.pose, solution.working_mode)
    index = findings.mean_index
    said = (
        "The local condition index is 1/cond(J) in the 2-norm with J = Jp⁻¹ Jq, between 0 (singular) and 1 "
        "(isotropic); the velocity factors are the singular values of J: by how much the inputs’ speed is multiplied "
        "in the fastest and in the slowest direction. The global index is the mean over the workspace."
    )
    length = unit_length(record)
    if length is not None:
        said += f" Lengths are divided by the characteristic length {short(length)} {record.unit}."
    factors = found.velocity_factors
    left_out = f"; {index.singular} left out as singular" if index.singular else ""
    points = f"{index.points} quasi-random points{left_out}"
    scalars = [
        Scalar(
            "local condition index here",
            _number(found["condition"]),
            "",
            FLOATING,
            note="in the configuration of this report",
        ),
        Scalar("fastest direction", _number(factors[0]), "", FLOATING, note="largest velocity factor"),
        Scalar("slowest direction", _number(factors[-1]), "", FLOATING, note="smallest velocity factor"),
        Scalar("global condition index", index.value, "", SPREAD, index.error, note=points),
    ]
    return Section("Dexterity", said, [*scalars, *findings.picture(*PICTURES), *_spread(findings)])


def _of_the_joint_graph(findings: Findings) -> Section:
    """Every index in the configuration of this report, by the null space of the closure, and its maps."""
    found = indices_at(findings.record, findings.joints)
    said = (
        "Indices of J = Jp⁻¹ Jq in the configuration of this report, from the joint graph: condition indices and "
        "transmission indices are between 0 (singular) and 1 (best); the velocity factors are the singular values of J."
    )
    if found.length is not None:
        said += f" Lengths are divided by the characteristic length {short(found.length)} {findings.record.unit}."
    scalars = [
        Scalar(name.replace("_", " "), _number(found[name]), index.unit(found), FLOATING, note=index.meaning)
        for name, index in INDICES.items()
    ]
    return Section("Dexterity", said, [*scalars, *findings.picture(*PICTURES)])


def _spread(findings: Findings) -> list[Table]:
    """Quantiles of the local condition index over the workspace."""
    region = findings.workspace
    poses = region.interior(COUNT, np.random.default_rng(SEED))
    condition = indices(findings.record, poses, region.mode)["condition"]
    known = np.isfinite(condition)
    if not np.any(known):
        return []
    quantiles = np.percentile(condition[known], SHARES)
    columns = tuple("least" if share == 0 else "greatest" if share == 100 else f"{share} %" for share in SHARES)
    caption = f"Quantiles over {int(np.sum(known))} poses spread evenly over the workspace."
    return [
        Table(
            "Local condition index over the workspace",
            columns,
            (tuple(short(float(v), 3) for v in quantiles),),
            caption,
            known_by="estimate: quantiles of a sample",
        )
    ]


def _number(value: float | np.floating | np.ndarray) -> float | None:
    return float(value) if np.isfinite(value) else None
