"""`assur identify`: which dimensions measured poses tell."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared, WorkingMode


def identify(
    mechanism: MechanismName,
    /,
    *,
    poses: Annotated[
        str | None,
        Parameter(metavar="FILE", help="A .csv whose first line names the coordinates of the pose; a pose a line."),
    ] = None,
    count: Annotated[
        str | None, Parameter(metavar="COUNT", help="Instead: so many poses anywhere in the workspace's box.")
    ] = None,
    measure: Annotated[
        str | None,
        Parameter(metavar="X,Y,Z", help="What is measured, of x, y, z, rx, ry, rz; the pose's lengths if left out."),
    ] = None,
    frame: Annotated[bool, Parameter(help="The measuring frame's place is unknown too.")] = False,
    mode: WorkingMode = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Which dimensions of a mechanism can be told from measured poses.

    To first order, from the sensitivities of `assur errors`: the dimensions, an
    offset of each input, and the measuring frame's place with --frame. It says
    how many combinations of them the poses tell, which they do not, in words,
    and how well the poses show the rest by the indices O1 to O5.

    For example:
        assur identify zeng2019 --count 20
        assur identify delta_4s --count 20 --measure z --frame
    """
    record = shared.mechanism(mechanism)
    from assur.cli import identified
    from assur.cli.numbers import whole_number
    from assur.cli.pose_table import pose_table
    from assur.errors import UsageError
    from assur.machine.calibration.identification import random_poses

    mode = mode or record.modes.default_working
    if (poses is None) == (count is None):
        raise UsageError("--poses or --count: one of them", hint="as --count 20")
    if count is not None:
        if not 1 <= (number := whole_number(count, "--count")) <= 10_000:
            raise UsageError(f"--count: {number}", hint="allowed: 1 to 10000")
        places = random_poses(record, number, mode)
    else:
        places = pose_table(record, poses or "")
    names = tuple(name.strip() for name in measure.split(",")) if measure is not None else ()
    return identified.outcome(record, places, names, mode, frame=frame)
