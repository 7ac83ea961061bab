"""What is said of forces at and near singularities: which actuators and which joint, and how forces grow."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.machine.forces.actuator_forces import ActuatorForces
from assur.machine.forces.weakness import Weakness, fastest, loosest, unfelt, weakness
from assur.results.answers.forces import ShownWeakness
from assur.results.plain_text import short

FELT = 0.1
"""Share of the largest that an actuator bears, so that it is named."""
WEAK = 1e-2
"""Where the actuators move by less than this while the platform moves by one, they are what is weak, else the loops."""
ALONE = ("unreachable", "not_closed")
"""Where there is nothing to look at."""


def shown(solved: ActuatorForces) -> ShownWeakness | None:
    """As data, of the first configuration."""
    if Status(int(solved.status[0])).name in ALONE:
        return None
    own = weakness(solved.motion)
    return ShownWeakness(tuple(own.twist.tolist()), own.moved, tuple(own.drives.tolist()), own.joint)


def notes(solved: ActuatorForces) -> Iterator[str]:
    """As sentences; none where nothing is near."""
    status = Status(int(solved.status[0])).name
    if status == "near_singular":
        own, (times, ratio) = weakness(solved.motion), fastest(solved.motion)
        if times > 1.0 / NEAR_SINGULAR:
            yield (
                f"near a singularity: while the pose moves by one, {_bearing(solved, ratio)} may move by "
                f"{short(times)} (lengths in characteristic lengths); mass and bias grow with the square of that"
            )
        elif own.moved > WEAK:
            joint = loosest(solved.motion)
            yield f"near a singularity: the loops nearly lose a constraint and reactions grow; joint {joint} moves most"
        if own.moved <= WEAK:
            yield (
                f"near a singularity: a load that moves the platform {_moves(own)} asks {_bearing(solved, own.drives)} "
                f"for up to {short(float(solved.growth[0]))} N or N m for each newton, half as far from the "
                f"singularity for twice as much; joint {own.joint} moves most then"
            )
    if status in ("parallel", "comprehensive", "constraint"):
        own = weakness(solved.motion)
        yield (
            f"while the actuators stand the platform moves {_moves(own)}, and joint {own.joint} most: near by, "
            f"{_bearing(solved, own.drives)} would bear a load against it with a force that grows as one over the "
            "distance"
        )
    if status in ("serial", "comprehensive", "undecided") and (names := unfelt(solved.motion)):
        yield f"{_list(names)} can move while the pose stays as it is"


def _bearing(solved: ActuatorForces, ratio: NDArray[np.float64]) -> str:
    """Names of the actuators that have most of what they share in a ratio (d,)."""
    largest = float(np.max(np.abs(ratio)))
    drives = zip(solved.record.drives, ratio, strict=True)
    return _list([item.name for item, share in drives if abs(share) >= FELT * largest])


def _moves(own: Weakness) -> str:
    """Along and about which directions, those that are more than rounding."""
    parts = []
    for word, part in (("along", own.twist[:3]), ("about", own.twist[3:])):
        size = float(np.linalg.norm(part))
        if size > 1e-6:
            parts.append(f"{word} ({', '.join(f'{value + 0.0:.3g}' for value in np.round(part / size, 6))})")
    return " and ".join(parts)


def _list(names: tuple[str, ...] | list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
