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


def indices(
    mechanism: MechanismName,
    /,
    *,
    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=True, metavar="X Y Z", help="One pose, one value per coordinate."),
    ] = (),
    mode: WorkingMode = None,
    length: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="Divide lengths by this one, or by the one that is most 'isotropic'."),
    ] = None,
    box: Box = (),
    stroke: Stroke = (),
    at: Held = (),
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
    0.7. Where lengths and angles mix, lengths are divided by a characteristic
    length, which the answer states.

    For example:
        assur indices zeng2019 --pose -15.4714 9.6849 456.3315
        assur indices planar_3rrr --length isotropic --at phi=0
    """
    record = shared.mechanism(mechanism)
    from assur.cli import indexed, regions
    from assur.cli.numbers import numbers
    from assur.kinematics.answers.at_border import pose_from_border

    unit_length = indexed.length_asked(length)
    mode = mode or record.modes.default_working
    if pose:
        values = numbers(pose, record.platform.pose, f"pose of {record.name}")
        return indexed.at_pose(record, pose_from_border(record, values), mode, unit_length)
    asked = regions.question(record, mode, box, stroke, resolution, (), None, at)
    return indexed.over_workspace(record, asked, points, unit_length, shared)
