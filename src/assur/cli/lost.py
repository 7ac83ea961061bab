"""Why a mode does not reach a pose: which quantity is negative, or without a closed form what paths from home met."""

from __future__ import annotations

from typing import Any, NamedTuple

from numpy.typing import NDArray

from assur.kinematics.answers.answer import missing
from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.status import Status
from assur.mechanism import Mechanism
from assur.results.answers.position import NegativeQuantity


class Lost(NamedTuple):
    """What is negative, and words; nothing where the mode reaches the pose."""

    failures: tuple[NegativeQuantity, ...] = ()
    notes: tuple[str, ...] = ()


def why_lost(record: Mechanism, pose: NDArray[Any], mode: str, status: Status) -> Lost:
    """Of a pose (m,), in lengths and rad, in a mode that a status says of."""
    if status not in (Status.unreachable, Status.undecided):
        return Lost()
    if record.closed_form is None and mode in (None, record.modes.default_working):
        home = home_mode_at(record, pose)
        return Lost() if home.reached else Lost(notes=(home.words,))
    if status == Status.undecided:
        return Lost()
    return Lost(missing(record, record.inverse(pose, mode).failures))
