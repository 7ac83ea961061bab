"""What holds a mechanism at rest under gravity: forces of its actuators and of its joints, as pictures show them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.status import Status
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import JointReaction, reactions
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ForcesAtRest:
    """What each joint's parent exerts on its child, in N; none where nothing holds the platform.

    `stresses` balance themselves, so that rigid links leave them open. `actuators` (d,) are in N or N m.
    """

    status: str
    joints: tuple[JointReaction, ...]
    stresses: int
    actuators: FloatArray

    @property
    def largest(self) -> float:
        """Of all forces in joints."""
        return max((float(np.linalg.norm(item.force)) for item in self.joints), default=0.0)


def forces_at_rest(record: MechanismRecord, values: FloatArray) -> ForcesAtRest:
    """At joint values (n,).

    Errors:
        UsageError: links without a mass.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("tripteron")
    >>> held = forces_at_rest(record, home_values(record))
    >>> held.status, len(held.joints) == len(record.joints), held.actuators.round(1).tolist()
    ('regular', True, [-0.3, -1.2, 55.5])
    """
    answer = forces_at(record, values[None], load_of(None))
    status, borne = Status(int(answer.status[0])).name, answer.forces[0]
    if np.isnan(borne).any():
        return ForcesAtRest(status, (), 0, borne)
    passed = reactions(answer)
    return ForcesAtRest(status, passed.joints, passed.redundancy, borne)
