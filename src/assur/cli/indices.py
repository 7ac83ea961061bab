"""`assur indices`: condition, manipulability, velocity factors and transmission, at a pose or over the workspace."""

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


def indices(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
    length: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="Divide lengths by this one, or by the one that is most 'isotropic'."),
    ] = None,
    over: MapOptions = NO_MAP,
    points: Annotated[
        str | None, Parameter(metavar="COUNT", help="Points in the workspace's box, 4096 if left out.")
    ] = None,
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

    unit_length, mode = indexed.length_asked(length), at.mode_of(record)
    if over.map_ is not None:
        refuse("a map is of many poses", "--at holds coordinates of a map", pose=at.pose)
        refuse("of means over the workspace, not of a map", "give --nodes", points=points)
        return mapped.over_plane(indexed.maps_of(unit_length), record, mode, over, shared)
    if at.pose:
        refuse("of many poses, and --pose is one", "leave it out, or --pose", points=points, **vars(over))
        return indexed.at_pose(record, at.pose_of(record), mode, unit_length)
    refuse("of a map alone", "add --map x,z, or leave it out", nodes=over.nodes, output=over.output)
    asked = region_question.question(record, mode, over, over.resolution or mapped.CELLS)
    return indexed.over_workspace(record, asked, points or "4096", unit_length, shared)
