"""`assur forces`: what actuators exert and joints bear, for gravity, a load and a motion."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import (
    NO_MAP,
    POSE,
    SHARED_DEFAULTS,
    Load,
    MapOptions,
    MechanismName,
    NoGravity,
    Outcome,
    PoseOptions,
    Shared,
    refuse,
)
from assur.errors import UsageError


def forces(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
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
    over: MapOptions = NO_MAP,
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
    which forces on the platform the actuators hold at rest, at a pose
    (home's if left out) or, with --map, over the workspace, and how fast they move the platform. With --latex:
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
    mode, motion = at.mode_of(record), {"velocity": velocity, "acceleration": acceleration}
    acting = {"load": load, "no_gravity": no_gravity, **motion}
    if latex is not None:
        from assur.cli import motion_written

        refuse("formulas of --latex hold for every pose", "leave it out", pose=at.pose, capacity=capacity, **acting)
        refuse("of a map alone", "leave it out beside --latex", **vars(over))
        return motion_written.outcome(record, mode, latex)
    if capacity:
        refuse("--capacity is at rest under gravity", "leave it out", **acting)
    if over.map_ is not None:
        from assur.cli import machine_map, mapped

        if not capacity:
            raise UsageError("--map: of which forces?", hint="--map goes with --capacity")
        refuse("a map is of many poses", "--at holds coordinates of a map", pose=at.pose)
        return mapped.over_plane(machine_map.FORCES, record, mode, over, shared)
    refuse("of a map alone", "add --capacity --map x,z, or leave it out", **vars(over))
    if capacity:
        from assur.cli import borne

        return borne.outcome(record, at.pose_or_home(record), mode)
    from assur.cli import forced
    from assur.cli.numbers import numbers, wrench
    from assur.model.pose import rate_names

    pose, names = at.pose_of(record), rate_names(record.platform.pose)
    rates = [
        numbers(given, names, f"{what} of {record.name}") if given else [0.0] * len(names)
        for what, given in motion.items()
    ]
    return forced.outcome(record, pose, mode, wrench(load), not no_gravity, rates)
