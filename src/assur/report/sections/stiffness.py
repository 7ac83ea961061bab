"""Stiffness: how the platform gives way where it is drawn, what gives way, and the slowest natural vibrations."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assur.figures.strain_colours import drawn_stiffness
from assur.machine.elasticity.energies import EnergyShares, ranked
from assur.machine.elasticity.springs import ACTUATORS, JOINTS
from assur.machine.elasticity.stiffness import Stiffness, alike
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, RANK, Result, Scalar, Section, Table
from assur.results.typeset_text import short

PICTURES = ("stiffness", "weakest", "vibrations")
SAID = (
    "How the platform gives way in the configuration that is drawn while the actuators hold their inputs. Links with a"
    " profile are Timoshenko’s beams, those with a compliance give way by it, the others are rigid; actuators and gears"
    " are springs, joints hold but for their compliance. All of these numbers are those of the mechanism’s file, which"
    " says where they come from."
)


def stiffness(findings: Findings) -> Section:
    """Principal stiffness, shares of the energy, frequencies.

    Errors:
        UsageError: an actuator without stiffness, a pose that the actuators do not hold.
    """
    answer = drawn_stiffness(findings)
    results: list[Result] = [
        Scalar("ways in which the platform gives way", int(answer.rank[0]), "", RANK, note="of six"),
        _principal(answer),
        *_shared(answer.shares()),
        *_vibrations(answer),
        *findings.picture(*PICTURES),
    ]
    return Section("Stiffness", SAID, results)


def _principal(answer: Stiffness) -> Table:
    (sizes,), (ways,) = answer.translational
    alone = answer.actuator_only.translational[0][0]
    rows = tuple(
        (_micro(size), ", ".join(short(float(part) + 0.0, 3) for part in np.round(way, 3)), _micro(motors))
        for size, way, motors in zip(sizes, ways, alone, strict=True)
    )
    columns = ("stiffness (N/µm)", "along x, y, z", "actuators alone (N/µm)")
    said = f"; {alike(sizes)}" if alike(sizes) else ""
    caption = f"Of forces along principal directions without moment; those of the actuators alone have their own{said}."
    return Table("Principal stiffness", columns, rows, caption, known_by=FLOATING)


def _micro(value: float) -> str:
    return short(float(value) / 1e6, 4) if np.isfinite(value) else "rigid"


def _shared(shares: EnergyShares) -> Iterator[Table]:
    """By links, joints and actuators, the largest first, and by kinds where there are several."""
    caption = "Of the strain energy under unit forces along x, y and z, summed."
    whole = shares.bent | {name: share * shares.links[ACTUATORS] for name, share in shares.actuators.items()}
    whole |= {f"joint {name}": share * shares.links[JOINTS] for name, share in shares.joints.items()}
    several = sum(share > 0.0 for share in shares.kinds.values()) > 1
    for title, own in (("What gives way", whole), ("Kinds of strain", shares.kinds if several else {})):
        rows = tuple((name, f"{share:.1%}") for name, share in ranked(own))
        if rows:
            yield Table(title, ("in", "share"), rows, caption, folded=len(rows) > 8, known_by=FLOATING)


def _vibrations(answer: Stiffness) -> Iterator[Result]:
    own = answer.vibrations()
    if own.lacking or not len(own.frequencies):
        return
    rows = tuple((str(place), short(float(value), 4)) for place, value in enumerate(own.frequencies, 1))
    yield Table("Slowest natural vibrations", ("", "frequency (Hz)"), rows, known_by=FLOATING)
