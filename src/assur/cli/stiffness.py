"""`assur stiffness`: how the platform gives way at a pose, and what gives way."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import (
    NO_MAP,
    POSE,
    SHARED_DEFAULTS,
    MapOptions,
    MechanismName,
    Outcome,
    PoseOptions,
    Shared,
    refuse,
)


def stiffness(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
    no_shear: Annotated[bool, Parameter(help="Beams of Euler and Bernoulli: no shear.")] = False,
    over: MapOptions = NO_MAP,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Stiffness of the platform at a pose while the actuators hold their inputs.

    Matrix structural analysis of the whole joint graph: links with a profile
    are Timoshenko beams, links and joints with a compliance give way by it,
    the others are rigid; actuators and gears are springs, passive joints leave
    free what they leave free, and what is held twice needs no care. Compliance
    and stiffness at the platform's point, the stiffness along its principal
    directions where no moment is applied, what would remain if only the
    actuators gave way, where the strain energy is, and the slowest natural
    vibrations. All is in SI units, in the base's axes. Exit code 2: what is
    needed is not in the file. 4: the mode does not reach the pose.
    With --map: the least stiffness and its direction at the nodes of a grid
    through the workspace, and the least that the actuators alone would leave.

    For example:
        assur stiffness zeng2019 --pose -15.4714 9.6849 456.3315
        assur stiffness orthoglide --pose 0 0 0 --json
        assur stiffness zeng2019 --map x,z --at y=0 -o stiffness.png
    """
    record = shared.mechanism(mechanism)
    mode = at.mode_of(record)
    if over.map_ is not None:
        from assur.cli import machine_map, mapped

        refuse("a map is of many poses, with shear", "leave it out, or --map", pose=at.pose, no_shear=no_shear)
        return mapped.over_plane(machine_map.STIFFNESS, record, mode, over, shared)
    from assur.cli import stiffness_answer

    refuse("of a map alone", "add --map x,z, or leave it out", **vars(over))
    return stiffness_answer.outcome(record, at.pose_of(record), mode, shear=not no_shear)
