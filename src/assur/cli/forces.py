"""`assur forces`: what actuators exert and joints bear, for gravity, a load and a motion."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, Box, Held, Load, MechanismName, NoGravity, Outcome, Shared, WorkingMode


def forces(
    mechanism: MechanismName,
    /,
    *,
    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="X Y Z", help="The pose; with --capacity home's if left out."),
    ] = (),
    mode: WorkingMode = None,
    load: Load = None,
    no_gravity: NoGravity = False,
    velocity: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="VX VY VZ", help="Rates of the pose, per second; 0 if left out."),
    ] = (),
    acceleration: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="AX AY AZ", help="Their rates, per second squared; 0 if left out."),
    ] = (),
    capacity: Annotated[
        bool, Parameter(help="Which forces on the platform the actuators hold at rest within their limits.")
    ] = False,
    plane: Annotated[
        str | None,
        Parameter(name="--map", metavar="X,Z", help="With --capacity: map it over these coordinates."),
    ] = None,
    box: Box = (),
    at: Held = (),
    nodes: Annotated[str, Parameter(metavar="COUNT", help="With --map: nodes along each; 40 if left out.")] = "40",
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="With --map: write the maps, .npz, .csv or .json, or draw them, .png, .pdf or .svg.",
        ),
    ] = None,
    latex: Annotated[
        str | None,
        Parameter(
            metavar="FILE", help="Write the equation of motion and the actuators' forces as formulas, for pdflatex."
        ),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Forces of the actuators and reactions in the joints at a pose.

    By virtual work over all links, with Newton and Euler for every joint, on the
    joint graph alone: a closed form is not asked for, and joints that hold the
    same twice do no harm. Masses, actuators and gravity are those of the file
    (`assur show --masses` prints them). Of each reaction it says what is unique
    and what rigid links leave open. Also: energies, power, mass matrix, bias and
    gravity in the pose's rates, friction apart. Rates and accelerations are in
    the file's units; `--json` is in SI units. Exit code 2: a mass that is needed
    is not in the file. 4: the mode does not reach the pose. With --capacity:
    which forces on the platform the actuators hold at rest, at a pose or, with
    --map, over the workspace, and how fast they move the platform. With --latex:
    mass matrix, bias, gravity and the actuators' forces in formulas of pose,
    rates and accelerations, by the closed form.

    For example:
        assur forces zeng2019 --pose -15.4714 9.6849 456.3315 --load 0,0,-100
        assur forces delta_4s --pose 0 0 -0.9 --velocity 1 0 0 --acceleration 20 0 0
        assur forces delta_4s --capacity --pose 0 0 -0.9
        assur forces delta_4s --capacity --map x,z --at y=0 -o held.png
        assur forces zeng2019 --latex motion.tex
    """
    record = shared.mechanism(mechanism)
    from assur.cli import forced
    from assur.cli.numbers import numbers, wrench
    from assur.errors import UsageError
    from assur.kinematics.answers.at_border import pose_from_border
    from assur.model.pose import rate_names

    mode = mode or record.modes.default_working
    if latex is not None:
        if pose or capacity or load is not None or velocity or acceleration:
            raise UsageError("--latex stands alone: formulas hold for every pose", hint="with --mode, if at all")
        from assur.cli import motion_written

        return motion_written.outcome(record, mode, latex)
    if capacity and (load is not None or no_gravity or velocity or acceleration):
        raise UsageError("--capacity: at rest under gravity", hint="leave out --load, --no-gravity and motions")
    if plane is not None:
        if pose or not capacity:
            raise UsageError("--map goes with --capacity, and without --pose", hint="--at holds coordinates of a map")
        from assur.cli import machine_map

        asked = mode, box, (), "32"
        return machine_map.over_plane(machine_map.FORCES, record, plane, at, asked, nodes, output, shared)
    if box or at or output is not None:
        raise UsageError("--box, --at and --output go with --map", hint="add --capacity --map x,z")
    if capacity and not pose:
        from assur.cli import borne
        from assur.kinematics.pose import pose_of

        return borne.outcome(record, pose_of(record, record.home_values), mode)
    if not pose:
        raise UsageError("--pose is missing", hint=f"--pose {' '.join(record.platform.pose)}")
    place = pose_from_border(record, numbers(pose, record.platform.pose, f"pose of {record.name}"))
    if capacity:
        from assur.cli import borne

        return borne.outcome(record, place, mode)
    names = rate_names(record.platform.pose)
    rates = [
        numbers(given, names, f"{what} of {record.name}") if given else [0.0] * len(names)
        for given, what in ((velocity, "velocity"), (acceleration, "acceleration"))
    ]
    return forced.outcome(record, place, mode, wrench(load), not no_gravity, rates)
