"""`assur calibrate`: dimensions and offsets from measured poses."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, Centre, MechanismName, Outcome, Shared


def calibrate(
    mechanism: MechanismName,
    data: Annotated[
        str, Parameter(metavar="DATA.CSV", help="A line of names, inputs and what is measured; a line a pose.")
    ],
    /,
    *,
    hold: Annotated[
        tuple[str, ...], Parameter(metavar="NAME", help="Keep this dimension or input as it is. May be repeated.")
    ] = (),
    frame: Annotated[bool, Parameter(help="The measuring frame's place is unknown too.")] = False,
    centre: Centre = None,
    output: Annotated[
        str | None, Parameter(name=("-o", "--output"), metavar="FILE", help="Write the file with the new numbers.")
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """The dimensions and offsets of inputs with which measured poses agree best.

    The table has a column for each input, in the file's units, and one for
    whatever is measured: x, y, z of the platform's point, its rotation vector
    rx, ry, rz, the angles phi, theta, psi of a pose, its distance from a point
    (--centre). Least squares, each pose solved again on the joint graph; what
    the measurements do not tell apart is held (`assur identify` says in words
    what that is), and measurements far beside the others are named and left
    out. The new file differs in these numbers alone.

    For example:
        assur calibrate delta.toml heights.csv -o calibrated.toml
        assur calibrate delta.toml tracker.csv --frame --hold sB
    """
    record = shared.mechanism(mechanism)
    from assur.cli import calibrated
    from assur.cli.numbers import centre_of
    from assur.cli.pose_table import measurements

    given = measurements(record, data, centre_of(centre))
    return calibrated.outcome(record, *given, hold, output, frame=frame)
