"""`assur errors`: how errors of dimensions and inputs move the platform at a pose."""

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


def errors(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
    samples: Annotated[
        str | None,
        Parameter(
            metavar="COUNT",
            help="How many mechanisms are drawn at random within the tolerances and assembled; 100000 if left out.",
        ),
    ] = None,
    over: MapOptions = NO_MAP,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """How errors of dimensions and of inputs move the platform, to first order.

    The inputs are held. A dimension counts wherever it is written, in one limb
    (leg1.L) and in one link (leg1.rod.L); the platform's rotation counts too,
    also where it should have none. An error that does not assemble alone is so
    called, with the joints that bear it, and with the pose at which links that
    bend settle. Tolerances of the file add to a worst case, a root sum of
    squares and a covariance, clearances of joints to their largest errors.
    Bounds of the pose are proved, and beside them stands how far mechanisms
    reach that are drawn at random within the tolerances, each assembled anew.
    Exit code 4: the mode does not reach the pose. With --map: the largest
    displacement and rotation within the tolerances at the nodes of a grid
    through the workspace, and the root sum square.

    For example:
        assur errors zeng2019 --pose -15.4714 9.6849 456.3315
        assur errors orthoglide --pose 0 0 0 --json
        assur errors own.toml --map x,z --at y=0 -o errors.png
    """
    record = shared.mechanism(mechanism)
    if over.map_ is not None:
        from assur.cli import machine_map, mapped

        refuse("a map is of many poses, to first order", "leave it out, or --map", pose=at.pose, samples=samples)
        return mapped.over_plane(machine_map.ERRORS, record, at.mode_of(record), over, shared)
    from assur.cli import errors_answer
    from assur.cli.numbers import whole_number
    from assur.errors import UsageError

    refuse("of a map alone", "add --map x,z, or leave it out", **vars(over))
    if not record.machine.tolerances:
        refuse(f"{record.name} states no tolerances", "write [tolerances] in its file", samples=samples)
    count = None if samples is None else whole_number(samples, "--samples")
    if count is not None and not 1 <= count <= errors_answer.MOST:
        raise UsageError(f"--samples: {count}", hint=f"allowed: 1 to {errors_answer.MOST}")
    return errors_answer.outcome(record, at.pose_of(record), at.mode_of(record), count, shared)
