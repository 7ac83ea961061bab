"""`assur indices`: condition, manipulability, velocity factors and transmission, at a pose or over the workspace."""

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
from assur.errors import UsageError


def indices(
    mechanism: MechanismName,
    /,
    *,
    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="X Y Z", help="One pose, one value per coordinate."),
    ] = (),
    mode: WorkingMode = None,
    length: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="Divide lengths by this one, or by the one that is most 'isotropic'."),
    ] = None,
    box: Box = (),
    stroke: Stroke = (),
    at: Held = (),
    plane: Annotated[
        str | None,
        Parameter(name="--map", metavar="X,Z", help="Map every index over these coordinates, the others held."),
    ] = None,
    nodes: Annotated[str, Parameter(metavar="COUNT", help="With --map: nodes along each; 60 if left out.")] = "60",
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="With --map: write the maps, .npz, .csv or .json, or draw them, .png, .pdf or .svg.",
        ),
    ] = None,
    resolution: Annotated[str, Parameter(metavar="CELLS", help="Cells of the workspace, 32 if left out.")] = "32",
    points: Annotated[str, Parameter(metavar="COUNT", help="Points in its box, 4096 if left out.")] = "4096",
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Performance indices at a pose, or their means and extremes.

    With --pose: velocity factors (singular values of J = Jp^-1 Jq), condition
    indices, manipulability, and the input and output transmission indices of
    each input (Wang, Wu and Liu 2010). Exit code 4: the mode does not reach it.
    Without: means and extremes over the workspace of the mode, each with an
    error, and the share of it where the local transmission index is at least
    0.7. With --map: every index at the nodes of a grid over some coordinates,
    the others held by --at, in mid-box or as at home, and beside them the
    distance from the nearest parallel singularity inside the reach that rays
    find; the border of the reach is not counted. Where lengths and angles mix,
    lengths are divided by a characteristic length, which the answer states.

    For example:
        assur indices zeng2019 --pose -15.4714 9.6849 456.3315
        assur indices planar_3rrr --length isotropic --at phi=0
        assur indices zeng2019 --map x,z --at y=0 -o maps.npz
    """
    record = shared.mechanism(mechanism)
    from assur.cli import indexed, mapped, region_question
    from assur.cli.numbers import numbers
    from assur.kinematics.answers.at_border import pose_from_border

    unit_length = indexed.length_asked(length)
    mode = mode or record.modes.default_working
    if plane is not None:
        if pose:
            raise UsageError("--pose and --map: one or the other", hint="--at holds coordinates of a map")
        asked_of = (mode, box, stroke, resolution)
        return mapped.over_plane(record, plane, at, asked_of, nodes, output, unit_length, shared)
    if output is not None:
        raise UsageError("--output: only maps are written", hint="add --map, as --map x,z")
    if pose:
        values = numbers(pose, record.platform.pose, f"pose of {record.name}")
        return indexed.at_pose(record, pose_from_border(record, values), mode, unit_length)
    asked = region_question.question(record, mode, box, stroke, resolution, (), None, at)
    return indexed.over_workspace(record, asked, points, unit_length, shared)
