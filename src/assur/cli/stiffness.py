"""`assur stiffness`: how the platform gives way at a pose, and what gives way."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, Box, Held, MechanismName, Outcome, Shared, Stroke, WorkingMode


def stiffness(
    mechanism: MechanismName,
    /,
    *,
    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="X Y Z", help="The pose, one value per coordinate."),
    ] = (),
    mode: WorkingMode = None,
    no_shear: Annotated[bool, Parameter(help="Beams of Euler and Bernoulli: no shear.")] = False,
    box: Box = (),
    stroke: Stroke = (),
    at: Held = (),
    plane: Annotated[
        str | None,
        Parameter(name="--map", metavar="X,Z", help="Map the least stiffness over these coordinates, the others held."),
    ] = None,
    nodes: Annotated[str, Parameter(metavar="COUNT", help="With --map: nodes along each; 30 if left out.")] = "30",
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="With --map: write the maps, .npz, .csv or .json, or draw them, .png, .pdf or .svg.",
        ),
    ] = None,
    resolution: Annotated[str, Parameter(metavar="CELLS", help="Cells of the workspace, 32 if left out.")] = "32",
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Stiffness of the platform at a pose while the actuators hold their inputs.

    Matrix structural analysis of the whole joint graph: links with a profile
    are Timoshenko beams, the others rigid; actuators are springs, passive
    joints leave free what they leave free, and what is held twice needs no
    care. Compliance and stiffness at the platform's point, the stiffness along
    its principal directions where no moment is applied, what would remain if
    only the actuators gave way, where the strain energy is, and the slowest
    natural vibrations. All is in SI units, in the base's axes. Exit code 2:
    what is needed is not in the file. 4: the mode does not reach the pose.
    With --map: the least stiffness and its direction at the nodes of a grid
    through the workspace, and the least that the actuators alone would leave.

    For example:
        assur stiffness zeng2019 --pose -15.4714 9.6849 456.3315
        assur stiffness orthoglide --pose 0 0 0 --json
        assur stiffness zeng2019 --map x,z --at y=0 -o stiffness.png
    """
    record = shared.mechanism(mechanism)
    from assur.cli import stiffness_answer
    from assur.cli.numbers import numbers
    from assur.errors import UsageError
    from assur.kinematics.answers.at_border import pose_from_border

    mode = mode or record.modes.default_working
    if plane is not None:
        if pose or no_shear:
            raise UsageError("--map: of poses over a plane, with shear", hint="leave out --pose and --no-shear")
        from assur.cli import machine_map

        asked = mode, box, stroke, resolution
        return machine_map.over_plane(machine_map.STIFFNESS, record, plane, at, asked, nodes, output, shared)
    if output is not None:
        raise UsageError("--output: only maps are written", hint="add --map, as --map x,z")
    if not pose:
        raise UsageError("--pose is missing", hint=f"--pose {' '.join(record.platform.pose)}")
    place = pose_from_border(record, numbers(pose, record.platform.pose, f"pose of {record.name}"))
    return stiffness_answer.outcome(record, place, mode, shear=not no_shear)
