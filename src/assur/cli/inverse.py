"""`assur inverse`: all inputs at a given pose."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.numbers import numbers
from assur.cli.options import SHARED_DEFAULTS, Crossed, MechanismName, MethodName, Outcome, Shared


def inverse(
    mechanism: MechanismName,
    /,
    *pose: Annotated[str, Parameter(metavar="COORDINATE", help="One value per pose coordinate, such as x y z.")],
    mode: Annotated[
        str | None, Parameter(help="Only this working mode, as ++-++ (`assur show` names its signs).")
    ] = None,
    method: MethodName = "auto",
    crossed: Crossed = False,
    certify: Annotated[
        bool, Parameter(help="Prove all inputs by intervals, and that there are no others, or say what is undecided.")
    ] = False,
    whole: Annotated[
        bool, Parameter(name="--all", negative="", help="List every solution, where else the ways of limbs are listed.")
    ] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """All inputs that hold the platform at a given pose.

    Each solution comes with its working mode, its assembly mode, its status and
    the gap that is left when every loop of the joint graph is closed with it.
    It says which strokes and limits of joints it exceeds; nothing is dropped.
    Where more than 16 solutions are all choices of one way a limb, these ways
    are listed, and all of them with --all.
    Exit code 4: it is proved that there is none; 5: undecided; 3: the formulas
    of the file give what is no solution.

    For example:
        assur inverse zeng2019 -15.4714 9.6849 456.3315
        assur inverse zeng2019 -15.4714 9.6849 456.3315 --mode ++-++
        assur inverse zeng2019 -15.4714 9.6849 456.3315 --certify
    """
    record = shared.mechanism(mechanism)
    from assur.cli.interruption import handing_over
    from assur.cli.positions import outcome
    from assur.kinematics.answers.at_border import pose_from_border
    from assur.kinematics.answers.solution_set import SolutionSet

    values = numbers(pose, record.platform.pose, f"pose of {record.name}")
    given = pose_from_border(record, values)
    if certify:
        from assur.cli import certified_solutions
        from assur.kinematics.certified.certify import certified_inverse

        way = certified_solutions.way_of(method, mode, crossed=crossed)
        return certified_solutions.outcome(record, certified_inverse(record, given, way))
    with handing_over(SolutionSet, lambda solutions: outcome(record, solutions)):  # type: ignore[type-abstract]
        return outcome(record, record.inverse(given, mode, method, crossed=crossed), whole=whole)
