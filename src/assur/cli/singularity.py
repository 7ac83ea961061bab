"""`assur singularity`: what one configuration is, or where a mechanism is singular."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.numbers import numbers
from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared, WorkingMode


def singularity(
    mechanism: MechanismName,
    /,
    *,
    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="X Y Z", help="The pose to be judged, one value per coordinate."),
    ] = (),
    mode: WorkingMode = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """What a configuration is: regular, or singular of which kind.

    With --pose: the kind by the factors of det Jp and det Jq and by the rank of
    the whole joint graph, every factor, the determinants and the condition
    number of the velocity map. Exit code 4: the mode does not reach the pose.
    Without: every factor and what it means, the loci inside the workspace box,
    and one example configuration for each.

    For example:
        assur singularity zeng2019 --pose -15.4714 9.6849 456.3315 --mode ++-++
        assur singularity zeng2019
    """
    record = shared.mechanism(mechanism)
    from assur.cli import configuration, singularities
    from assur.kinematics.answers.at_border import pose_from_border

    mode = mode or record.modes.default_working
    if not pose:
        return singularities.outcome(record, mode, shared)
    values = numbers(pose, record.platform.pose, f"pose of {record.name}")
    return configuration.outcome(record, pose_from_border(record, values), mode)
