"""`assur workspace`: the poses that one working mode reaches."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import (
    SHARED_DEFAULTS,
    Box,
    Held,
    MechanismName,
    Outcome,
    Shared,
    Stroke,
    WorkingMode,
)


def workspace(
    mechanism: MechanismName,
    /,
    *,
    mode: WorkingMode = None,
    box: Box = (),
    stroke: Stroke = (),
    resolution: Annotated[
        str | None,
        Parameter(metavar="CELLS", help="Cells along each coordinate; 64, or 20 if followed in space."),
    ] = None,
    at: Held = (),
    section: Annotated[
        tuple[str, ...],
        Parameter(metavar="VALUE", help="Cut across the last coordinate; the file's sections if left out."),
    ] = (),
    near: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="How near a parallel singularity is near; 3.5 % of the size if left out."),
    ] = None,
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="Write the answer (.json) or surface (.obj)."),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """The workspace of one working mode: volume, sections, loci.

    The volume comes with an estimate of its error, from two resolutions. Where
    a factor of det Jp vanishes inside, the surface's area is given, and the
    share of the volume that is near one. --box, --stroke and --section may be
    repeated; lengths and angles are in the mechanism's units.

    For example:
        assur workspace zeng2019
        assur workspace zeng2019 --box x=-110:80 --stroke -300:300 -o out.obj
        assur workspace zeng2019 --mode ++++- --stroke yA1=-200:200 --json
        assur workspace planar_3rpr --at phi=10
    """
    record = shared.mechanism(mechanism)
    from assur.cli import regions

    asked = regions.question(record, mode, box, stroke, resolution, section, near, at)
    target = regions.target(output) if output is not None else None
    return regions.outcome(record, asked, target, shared)
