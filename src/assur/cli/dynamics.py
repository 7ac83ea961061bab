"""`assur dynamics`: forces along a motion in time, the motion by given forces, small motions about a pose."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import (
    POSE,
    SHARED_DEFAULTS,
    Load,
    MechanismName,
    NoGravity,
    Outcome,
    PoseOptions,
    Shared,
    refuse,
)
from assur.errors import UsageError

ENDINGS = (".csv", ".png", ".pdf", ".svg")


def dynamics(
    mechanism: MechanismName,
    /,
    *,
    motion: Annotated[
        str | None,
        Parameter(metavar="FILE", help="A .toml file with [harmonic], [samples] or [forces], or samples as .csv."),
    ] = None,
    forward: Annotated[
        bool, Parameter(help="Let the mechanism run by the forces of the file, or by those that its motion asks for.")
    ] = False,
    linear: Annotated[
        bool, Parameter(help="Small motions about --pose while the actuators hold it by forces that stay as they are.")
    ] = False,
    at: PoseOptions = POSE,
    load: Load = None,
    no_gravity: NoGravity = False,
    no_limits: Annotated[bool, Parameter(help="Leave strokes of inputs and limits of joints aside.")] = False,
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="Rows by moments as .csv, which --motion reads again, or a figure as .png, .pdf or .svg.",
        ),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Forces of the actuators along a motion in time, and motions by forces.

    The file has the pose in the mechanism's units: [harmonic] centre, amplitude,
    omega [rad/s], phase [rad] with pose = centre + amplitude sin(omega t + phase),
    or [samples] t, pose; or a .csv with columns t, x, y, z, with units as
    "x [m]" or without, as a page records and -o writes it. It is followed in one
    mode; where it leaves that, the workspace or the limits of the file it is
    refused, with the moment and the margin. Answers: peak and rms of each actuator and its share of the limits of
    force, speed and power. With --forward the equation of motion is integrated,
    loops closed at every step, from rest at pose = .. until t_end = .., by
    constant [forces] or by t and values in it; a limit or a singularity ends it.
    With --linear: M a + C v + K x = 0 about a pose that constant forces hold, C of
    viscous friction; its poles, frequencies without C, whether it is stable.
    Exit code 6: it ended before its end; 4: the mode does not reach the start.

    For example:
        assur dynamics delta_4s --motion circle.toml -o forces.csv
        assur dynamics zeng2019 --motion fall.toml --forward
        assur dynamics linear_delta_4s --linear
    """
    record = shared.mechanism(mechanism)
    from pathlib import Path

    from assur.cli.numbers import wrench

    mode = at.mode_of(record)
    acting = wrench(load), not no_gravity
    if linear:
        from assur.cli import linearised

        other = {"motion": motion, "forward": forward, "no_limits": no_limits, "output": output}
        refuse("--linear is about one pose", "leave it out", **other)
        return linearised.outcome(record, at.pose_or_home(record), mode, acting)
    refuse("the file of --motion says where it begins", "leave it out, or ask for --linear", pose=at.pose)
    if motion is None:
        raise UsageError("--motion is missing", hint="--motion motion.toml, with [harmonic], [samples] or [forces]")
    from assur.cli import timed
    from assur.cli.paths import output_file
    from assur.machine.dynamics.motion_file import MotionFile, read_motion
    from assur.machine.dynamics.prescribed_motion import sampled

    path = output_file(output, ENDINGS) if output is not None else None
    if motion.lower().endswith(".csv"):
        from assur.cli.pose_table import timed_poses

        read = MotionFile(sampled(record, *timed_poses(record, motion)), None)
    else:
        read = read_motion(record, Path(motion))
    return timed.outcome(record, read, mode, acting, forward=forward, use_limits=not no_limits, path=path)
