"""`assur stiffness`: how the platform gives way at a pose, and what gives way."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared, WorkingMode


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

    For example:
        assur stiffness zeng2019 --pose -15.4714 9.6849 456.3315
        assur stiffness orthoglide --pose 0 0 0 --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli import stiffness_answer
    from assur.cli.numbers import numbers
    from assur.errors import UsageError
    from assur.kinematics.answers.at_border import pose_from_border

    if not pose:
        raise UsageError("--pose is missing", hint=f"--pose {' '.join(record.platform.pose)}")
    place = pose_from_border(record, numbers(pose, record.platform.pose, f"pose of {record.name}"))
    return stiffness_answer.outcome(record, place, mode or record.modes.default_working, shear=not no_shear)
