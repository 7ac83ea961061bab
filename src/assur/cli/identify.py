"""`assur identify`: which dimensions measured poses tell."""

from __future__ import annotations

from functools import partial
from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, Centre, MechanismName, Outcome, Shared, WorkingMode, refuse

CANDIDATES = 5
"""Poses that are drawn for each that is chosen."""


def identify(
    mechanism: MechanismName,
    /,
    *,
    poses: Annotated[
        str | None,
        Parameter(metavar="FILE", help="A .csv whose first line names the coordinates of the pose; a pose a line."),
    ] = None,
    count: Annotated[
        str | None,
        Parameter(metavar="COUNT", help="Instead: so many poses of the workspace's box, those that show most."),
    ] = None,
    by: Annotated[
        str | None,
        Parameter(metavar="O1", help="With --count: the index, O1 to O5, that they are chosen by; O1 if left out."),
    ] = None,
    measure: Annotated[
        str | None,
        Parameter(
            metavar="X,Y,Z",
            help="What is measured, of x, y, z, rx, ry, rz, phi, theta, psi, distance; the pose's lengths if left out.",
        ),
    ] = None,
    centre: Centre = None,
    copies: Annotated[
        Literal["limb", "link"] | None,
        Parameter(help="Dimensions of each limb, or of each link, are unknown by themselves; else alike in all."),
    ] = None,
    frame: Annotated[bool, Parameter(help="The measuring frame's place is unknown too.")] = False,
    mode: WorkingMode = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Which dimensions of a mechanism can be told from measured poses.

    To first order, from the sensitivities of `assur errors`: the dimensions, an
    offset of each input, and the measuring frame's place with --frame. It says
    how many combinations of them the poses tell, which they do not, in words,
    and how well the poses show the rest by the indices O1 to O5. With --count
    the poses are chosen among many more so that one of these is large. With
    --copies limb or --copies link each limb's or link's own copy of a dimension
    counts by itself: that is where parts differ that should be alike.

    For example:
        assur identify zeng2019 --count 20
        assur identify delta_4s --count 20 --measure z --frame
        assur identify delta_4s --count 20 --copies limb
        assur identify delta_4s --count 12 --measure distance --centre 0,0,-0.7
    """
    record = shared.mechanism(mechanism)
    from assur.cli import identified
    from assur.cli.numbers import centre_of, whole_number
    from assur.cli.pose_table import pose_table
    from assur.errors import UsageError
    from assur.machine.calibration.chosen_poses import chosen, random_poses
    from assur.machine.calibration.identification import identification

    mode = mode or record.modes.default_working
    if (poses is None) == (count is None):
        raise UsageError("--poses or --count: one of them", hint="as --count 20")
    if count is None:
        refuse("the poses are given", "it goes with --count", by=by)
    names = tuple(name.strip() for name in measure.split(",")) if measure is not None else ()
    told = partial(
        identification, record, measured=names, frame=frame, centre=centre_of(centre), mode=mode, copies=copies
    )
    if count is None:
        return identified.outcome(record, told(poses=pose_table(record, poses or "")), mode)
    if not 1 <= (number := whole_number(count, "--count")) <= 10_000:
        raise UsageError(f"--count: {number}", hint="allowed: 1 to 10000")
    drawn = random_poses(record, CANDIDATES * number, mode)
    return identified.outcome(record, told(poses=drawn[chosen(told(poses=drawn), number, by or "O1")]), mode)
