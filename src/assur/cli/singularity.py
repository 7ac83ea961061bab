"""`assur singularity`: what one configuration is, or where a mechanism is singular."""

from __future__ import annotations

from assur.cli.options import POSE, SHARED_DEFAULTS, MechanismName, Outcome, PoseOptions, Shared


def singularity(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
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

    if not at.pose:
        return singularities.outcome(record, at.mode_of(record), shared)
    return configuration.outcome(record, at.pose_of(record), at.mode_of(record))
