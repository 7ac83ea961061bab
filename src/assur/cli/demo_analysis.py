"""The demonstration's middle: velocities, singularities and the workspace, each by a second route."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.cli.claims import Ledger
from assur.cli.demo_position import entry_of
from assur.cli.options import Plain
from assur.cli.output import table
from assur.cli.progress import progress
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import pose_from_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.closure import mobility
from assur.kinematics.rates.motions import general
from assur.kinematics.rates.velocity import velocity_map
from assur.kinematics.status import closed_form_of
from assur.mechanism import Mechanism
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.results.outward import outward
from assur.results.plain_text import count, with_error
from assur.workspace.region import Workspace

STEP = 1e-5
"""Step of a central difference, as a share of the characteristic length."""
ROUNDING = 1e-10
"""What rounding leaves of such a difference, relative to the matrix."""
SINGULAR = 1e-6
"""Smallest over largest singular value below which a matrix counts as singular here."""
POINTS = 400_000
SIGMAS = 4.0


def velocity(ledger: Ledger, record: Mechanism) -> None:
    """Jp and Jq at the printed pose in the default working mode."""
    mode = record.modes.default_working
    ledger.section(f"Velocity, Jp v = Jq dq/dt (mode {mode})")
    pose = pose_from_border(record, [digits.value for digits in entry_of(record, "inverse").given])
    here = record.velocity_map(pose, mode)
    style = style_of(record)
    inputs = [item.name for item in record.inputs]
    for name, columns, matrix in (("Jp", record.platform.pose, here.jp), ("Jq", inputs, here.jq)):
        rows = [("", *(style.number(value, angle=False) for value in row)) for row in matrix.tolist()]
        ledger.show([table((name, *columns), rows)])
    ledger.show([f"condition number of J = Jp^-1 Jq: {float(here.condition):.4f}"])
    error, allowed = _difference(record, pose, mode, np.linalg.solve(here.jq, here.jp))
    ledger.claim(
        "Jq^-1 Jp is the derivative of the inverse problem",
        error <= allowed,
        f"central differences agree to {error:.1e}, and are good to {allowed:.1e}",
    )
    factors = record.singularity(pose, mode).factors
    for name, kind, value in (("Jp", "parallel", here.det_jp), ("Jq", "serial", here.det_jq)):
        listed = [item.name for item in closed_form_of(record).factor_list if item.kind == kind]
        product = math.prod(factors[key] for key in listed)
        ledger.claim(
            f"det {name} is the product of {', '.join(listed)}",
            abs(product - value) <= 1e-12 * abs(value),
            f"{float(value):.6g}",
        )


def _difference(record: Mechanism, pose: NDArray[Any], mode: str, matrix: NDArray[Any]) -> tuple[float, float]:
    """How far central differences are from dq/dx (n, m), and how far from those of twice the step; relative."""

    def numeric(step: float) -> NDArray[Any]:
        steps = step * np.eye(len(pose))
        ahead, behind = (record.inverse(pose + side * steps, mode).inputs[:, 0] for side in (1, -1))
        return np.asarray((ahead - behind).T / (2 * step))

    step = STEP * characteristic_length(record)
    fine, coarse, size = numeric(step), numeric(2 * step), np.max(np.abs(matrix))
    error, change = (float(np.max(np.abs(fine - other)) / size) for other in (matrix, coarse))
    return error, change + ROUNDING


def singularities(ledger: Ledger, findings: Findings, shared: Plain) -> None:
    """One configuration for every factor that vanishes somewhere."""
    record = findings.record
    ledger.section("Singular configurations, one for each factor")
    with progress("singular configurations", shared):
        examples = findings.examples
    style, names = style_of(record), record.platform.pose
    ranks = [int(mobility(record, item.joints).rank) for item in examples]
    rows = [
        (item.factor.name, item.status.name, item.mode, str(rank), style.point(names, item.pose.tolist()))
        for item, rank in zip(examples, ranks, strict=True)
    ]
    pose = style.point_title(names)
    ledger.show([table(("factor", "status", "mode", "rank", pose), rows, left=("factor", "status", pose))])
    for kind, name in (("parallel", "Jp"), ("serial", "Jq")):
        ratios = [_ratio(record, item, kind) for item in examples if item.factor.kind == kind]
        worst = max(ratios, default=1.0)
        ledger.claim(
            f"{name} itself is singular at every example of a {kind} factor",
            worst < SINGULAR,
            f"smallest over largest singular value at most {worst:.1e} at {count(len(ratios), 'example')}",
        )
    usual = general(record).closure
    constraint = [rank < usual for item, rank in zip(examples, ranks, strict=True) if item.status.name == "constraint"]
    weaker = [rank < usual for item, rank in zip(examples, ranks, strict=True) if item.status.name in MILDER]
    ledger.claim(
        "the joint graph loses rank at the examples called constraint, and at none that is less severe",
        all(constraint) and not any(weaker),
        f"rank below {usual} at {sum(constraint)} of {len(constraint)}, and at {sum(weaker)} of {len(weaker)}",
    )


MILDER = ("serial", "parallel", "comprehensive")


def _ratio(record: MechanismRecord, example: Any, kind: str) -> float:
    """Smallest over largest singular value of Jp or Jq at an example."""
    here = velocity_map(record, example.pose, example.mode)
    values = np.linalg.svd(here.jp if kind == "parallel" else here.jq, compute_uv=False)
    return float(values[-1] / values[0])


def workspace(ledger: Ledger, findings: Findings, shared: Plain) -> None:
    """The workspace of the default working mode, its volume against random poses."""
    record = findings.record
    ledger.section(f"Workspace of mode {record.modes.default_working}")
    with progress("workspace", shared):
        found = findings.workspace
    last = found.box.names[-1]
    rows = [(f"{item.value:g}", with_error(item.area, item.area_error)) for item in found.sections]
    ledger.show([f"volume {with_error(found.volume, found.volume_error)} {found.unit}"])
    ledger.show([table((f"section at {last} [{record.unit}]", f"area [{record.unit}^2]"), rows)])
    volume, sigma = _sampled(record, found)
    ledger.claim(
        f"{POINTS} random poses give the same volume",
        abs(found.volume - volume) <= SIGMAS * sigma + found.volume_error,
        f"{with_error(volume, sigma)} {found.unit}",
    )
    _proved(ledger, findings, shared)
    inside = {locus.factor: locus.area for locus in found.loci}
    crossing = [name for name, area in inside.items() if area > 0]
    ledger.claim(
        "random poses lie inside on both sides of each parallel-singular surface",
        all(_changes_sign(record, found, name) for name in crossing),
        ", ".join(crossing) or "none",
    )
    if found.share is not None:
        ledger.show([f"{100 * found.share:.1f} % of the volume lie within {found.near:g} {record.unit} of one"])


def _proved(ledger: Ledger, findings: Findings, shared: Plain) -> None:
    """Proved bounds of the volume and of the sections, with the estimates by solids beside them."""
    with progress("workspace, proved", shared):
        proof, cube = findings.bounds, findings.cube
    if isinstance(proof, str) or isinstance(cube, str):
        ledger.claim("bounds of the workspace are proved", holds=False, observed=str(proof))
        return
    found = findings.workspace
    pairs = [(found.volume, found.volume_error, proof.volume)]
    for item, cut in zip(found.sections, proof.sections, strict=True):
        pairs.append((item.area, item.area_error, cut.area))
    low, high = proof.volume
    ledger.claim(
        f"the volume and the {len(pairs) - 1} sections lie within their errors of the bounds proved by intervals",
        all(low - error <= value <= high + error for value, error, (low, high) in pairs),
        f"volume {' to '.join(outward(low, high))} {found.unit}, {proof.how}",
    )
    ledger.claim(
        "about the configuration of the printed inputs a cube is proved to be reached and free of singularities",
        cube.size > 0,
        f"edge {' to '.join(outward(cube.size, cube.refuted))} {findings.record.unit}",
    )


def _sampled(record: MechanismRecord, region: Workspace) -> tuple[float, float]:
    """Volume by random poses, and its standard deviation."""
    low, high = np.array(region.box.low), np.array(region.box.high)
    share = float(np.mean(_random(record, region)["exists"]))
    whole = float(np.prod(high - low))
    return whole * share, whole * math.sqrt(share * (1 - share) / POINTS)


def _changes_sign(record: MechanismRecord, region: Workspace, factor: str) -> bool:
    """Whether a factor has both signs among random poses inside."""
    sample = _random(record, region)
    place = [item.name for item in closed_form_of(record).factor_list].index(factor)
    values = sample["factors"][place][sample["exists"]]
    return bool(np.any(values > 0) and np.any(values < 0))


def _random(record: MechanismRecord, region: Workspace) -> dict[str, NDArray[Any]]:
    """The inverse problem at random poses of the box."""
    rng = np.random.default_rng(0)
    poses = [rng.uniform(low, high, POINTS) for low, high in zip(region.box.low, region.box.high, strict=True)]
    return inverse_sweep(record, poses, region.mode, ("exists", "factors"))
