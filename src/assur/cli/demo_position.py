"""The demonstration's first half: topology, direct and inverse solutions of the printed problems."""

from __future__ import annotations

from typing import Any

import numpy as np

from assur.audit.audit import FORMS, KINDS
from assur.audit.reference import read_reference
from assur.audit.rows import Row
from assur.cli.auditing import rows_table
from assur.cli.claims import Ledger
from assur.cli.positions import lines
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import inputs_from_border, pose_from_border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import CertifiedSolutions
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.status import Status
from assur.mechanism import Mechanism
from assur.results.plain_text import count

BACK = 1e-9
"""Share of the characteristic length within which a number must come back."""


def topology(ledger: Ledger, record: Mechanism) -> None:
    """What the source prints of topology, beside ranks of twists and of the joint graph."""
    ledger.section("Topology")
    rows = _rows(record, ("poc", "decomposition"))
    ledger.show([rows_table(rows)])
    free = record.mobility(record.home_values)
    joints, rank = len(record.coordinates), int(free.rank)
    ledger.claim(
        "F is the number of inputs, by the rank of the closure of the whole joint graph",
        int(free.freedoms) == len(record.inputs),
        f"{joints} joint freedoms - rank {rank} = {int(free.freedoms)}",
    )
    printed = [row for row in rows if row.quantity == "F"]
    ledger.claim(
        "the same F comes out of the loops of the source",
        all(row.computed == int(free.freedoms) for row in printed),
        ", ".join(str(row.computed) for row in printed) or "no row",
    )


def direct(ledger: Ledger, record: Mechanism) -> None:
    """Every pose at the printed inputs."""
    entry = entry_of(record, "direct")
    ledger.section(f"Direct solutions ({entry.source})")
    given = inputs_from_border(record, [digits.value for digits in entry.given])
    found = record.direct(given)
    ledger.show(lines(record, found))
    _closes(ledger, record, found)
    _certified(ledger, found, certified_direct(record, given))
    gaps = [_nearest(record.inverse(item.pose, item.working_mode).inputs, item.inputs) for item in found]
    _comes_back(ledger, record, "the inverse problem at each pose gives the inputs back", gaps)


def inverse(ledger: Ledger, record: Mechanism) -> None:
    """All inputs at the printed pose."""
    entry = entry_of(record, "inverse")
    ledger.section(f"Inverse solutions ({entry.source})")
    given = pose_from_border(record, [digits.value for digits in entry.given])
    found = record.inverse(given)
    ledger.show(lines(record, found))
    _closes(ledger, record, found)
    _certified(ledger, found, certified_inverse(record, given))
    regular = [item for item in found if item.status <= Status.near_singular]
    gaps = [_nearest(record.direct(item.inputs).poses, item.pose) for item in regular]
    _comes_back(ledger, record, "the direct problem at each regular solution gives the pose back", gaps)
    moving = [item for item in found if item.status == Status.self_motion]
    spans = [_span(record.direct(item.inputs)) for item in moving]
    if moving:
        ledger.claim(
            "where the status is self_motion the platform moves with every input locked",
            min(spans) > 0,
            f"{count(len(moving), 'solution')}, by {min(spans):.1f} {record.unit} or more, all loops closed on the way",
        )


def _certified(ledger: Ledger, solutions: SolutionSet, proof: CertifiedSolutions) -> None:
    """The certificate: that these are all."""
    ledger.claim(
        "interval arithmetic proves as many solutions, and that there is no other",
        proof.proved and len(proof) == len(solutions),
        proof.headline,
    )


def _rows(record: Mechanism, kinds: tuple[str, ...]) -> list[Row]:
    reference = read_reference(record, FORMS)
    return [
        row for kind in kinds for entry in reference.entries[kind] for row in KINDS[kind].rows(record, reference, entry)
    ]


def entry_of(record: Mechanism, kind: str) -> Any:
    """The first printed problem of a kind."""
    return read_reference(record, FORMS).entries[kind][0]


def _closes(ledger: Ledger, record: Mechanism, solutions: SolutionSet) -> None:
    worst = max(item.residual for item in solutions)
    ledger.claim(
        "every solution closes every loop of the joint graph",
        worst <= CLOSED * characteristic_length(record),
        f"largest gap {worst:.1e} {record.unit}",
    )


def _comes_back(ledger: Ledger, record: Mechanism, text: str, gaps: list[float]) -> None:
    worst = max(gaps, default=float("inf"))  # no solution that could come back is no claim that holds
    ledger.claim(
        text, worst <= BACK * characteristic_length(record), f"{len(gaps)} times, to {worst:.1e} {record.unit}"
    )


def _nearest(rows: Any, inputs: Any) -> float:
    """Distance of the nearest of some rows (K, n); rows of NaN do not exist."""
    return float(np.nanmin(np.linalg.norm(rows - inputs, axis=-1), initial=np.inf))


def _span(solutions: SolutionSet) -> float:
    """How far the platform gets on the longest curve, 0 where the loops do not close on the way."""
    reach = [0.0]
    for curve in solutions.curves:
        gap = float(np.max(closure_error(solutions.record, curve.joints())))
        poses = curve.poses()
        far = float(np.max(np.linalg.norm(poses - poses[0], axis=-1)))
        reach.append(far if gap <= CLOSED * characteristic_length(solutions.record) else 0.0)
    return max(reach)
