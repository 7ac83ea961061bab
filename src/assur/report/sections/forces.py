"""Forces: what links weigh, what actuators exert and joints bear at rest, and what load the platform holds."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assur.errors import UsageError
from assur.figures.force_polytope import held, no_capacity
from assur.figures.joint_forces import joint_forces
from assur.kinematics.status import Status
from assur.machine.forces.actuator_forces import ActuatorForces, force_units, forces_at
from assur.machine.forces.forces_at_rest import ForcesAtRest
from assur.machine.forces.loads import load_of
from assur.machine.forces.utilisation import stated
from assur.machine.masses.link_masses import all_masses
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, RANK, Picture, Result, Scalar, Section, Table
from assur.results.typeset_text import short

PICTURES = ("reactions", "polytope", "forces")
SAID = (
    "Masses are those of the mechanism’s file, which says where they come from. Forces are in newtons, moments in"
    " newton metres, at rest under gravity in the configuration that is drawn: those of the actuators by virtual work"
    " over all links, those of the joints by Newton and Euler for every link."
)


def forces(findings: Findings) -> Section:
    """Weights, forces of the actuators, reactions of the joints, capacity."""
    known = all_masses(findings.record)
    answer = forces_at(findings.record, findings.drawn_joints[None], load_of(None))
    status = Status(int(answer.status[0]))
    if np.isnan(answer.forces).any():
        raise UsageError(f"the actuators do not hold the platform where it is drawn: it is {status.name} there")
    passed = joint_forces(findings)
    weights = Table(
        "Masses",
        ("link", "mass (kg)", "from"),
        tuple((name, short(body.mass, 4), body.source) for name, body in known.carried("").items()),
        folded=True,
        known_by=FLOATING,
    )
    results: list[Result] = [
        Scalar("total mass", known.total, "kg", FLOATING, note="without the base, with what the platform carries"),
        _actuators(findings, answer),
        Scalar(
            "largest force of an actuator per newton at the platform",
            float(answer.growth[0]),
            "",
            FLOATING,
            note="N or N m; it grows without bound towards a parallel singularity",
        ),
        *_capacity(findings),
        Scalar(
            "stresses that balance themselves",
            float(passed.stresses),
            "",
            RANK,
            note="of rigid links; what they change in the joints is marked *",
        ),
        _joints(passed),
        weights,
        *_pictures(findings),
    ]
    return Section("Forces", SAID, results)


def _actuators(findings: Findings, answer: ActuatorForces) -> Table:
    record = findings.record
    limits = stated(record, "force")
    rows = tuple(
        (item.name, short(float(force), 4), unit, _share(abs(force) / limit), short(float(band), 4))
        for item, force, unit, limit, band in zip(
            record.drives, answer.forces[0], force_units(record), limits, answer.friction_band, strict=True
        )
    )
    columns = ("actuator", "force", "in", "of its limit", "± friction")
    return Table("Actuators at rest", columns, rows, known_by=FLOATING)


def _share(value: float) -> str | None:
    return f"{100 * value:.1f} %" if np.isfinite(value) else None


def _capacity(findings: Findings) -> Iterator[Scalar]:
    if not no_capacity(findings):
        own = held(findings)
        note = f"within the limits of the actuators, gravity included; then {own.limiting} is at its limit"
        yield Scalar("force that is held in every direction", own.sphere, "N", FLOATING, note=note)


def _joints(passed: ForcesAtRest) -> Table:
    rows = tuple(
        (
            item.joint,
            *(
                f"{short(0.0 if abs(value) < 1e-9 else float(value), 4)}{'' if sure else '*'}"
                for value, sure in zip([*item.force, *item.moment], item.unique, strict=True)
            ),
        )
        for item in passed.joints
    )
    columns = ("joint", "Fx", "Fy", "Fz", "Mx", "My", "Mz")
    caption = (
        "What the parent passes to the child at its joint point, along the base’s axes, in N and N m."
        " *: rigid links leave it open; the least is shown."
    )
    return Table("Joints at rest", columns, rows, caption, folded=True, known_by=FLOATING)


def _pictures(findings: Findings) -> tuple[Picture, ...]:
    return tuple(findings.picture(*PICTURES))
