"""`assur direct`: every pose at given inputs."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.numbers import numbers
from assur.cli.options import SHARED_DEFAULTS, Crossed, MechanismName, MethodName, Outcome, Shared


def direct(
    mechanism: MechanismName,
    /,
    *inputs: Annotated[str, Parameter(metavar="INPUT", help="One value per input, in the order of `assur show`.")],
    mode: Annotated[
        str | None, Parameter(help="Only this assembly mode, as +++ (`assur show` names its signs).")
    ] = None,
    method: MethodName = "auto",
    crossed: Crossed = False,
    certify: Annotated[
        bool,
        Parameter(help="Prove every pose by intervals, and that there is no other. With --method search: box by box."),
    ] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Every pose of the platform at given inputs.

    Each solution comes with its assembly mode, its working mode, its status and
    the gap that is left when every loop of the joint graph is closed with it.
    It says which strokes and limits of joints it exceeds; nothing is dropped.
    Exit code 4: it is proved that there is none; 5: undecided; 3: the formulas
    of the file give what is no solution.

    With --certify each answer has bounds, and is proved or undecided, never a
    guess. Every number given counts as the float that is nearest to it.

    For example:
        assur direct zeng2019 162.6907 -143.3209 -24.6776
        assur direct zeng2019 162.6907 -143.3209 -24.6776 --certify
        assur direct fivebar 127 53 --set l2=200 --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli.interruption import handing_over
    from assur.cli.positions import outcome
    from assur.kinematics.answers.at_border import inputs_from_border
    from assur.kinematics.answers.solution_set import SolutionSet
    from assur.kinematics.border import drive_names, input_names

    names = input_names(record) if len(inputs) == len(record.inputs) else drive_names(record)
    values = numbers(inputs, names, f"inputs of {record.name}")
    given = inputs_from_border(record, values)
    if certify:
        from assur.cli import certified_solutions
        from assur.kinematics.certified.certify import certified_direct

        way = certified_solutions.way_of(method, mode, crossed=crossed)
        return certified_solutions.outcome(record, certified_direct(record, given, way))
    with handing_over(SolutionSet, lambda solutions: outcome(record, solutions)):  # type: ignore[type-abstract]
        return outcome(record, record.direct(given, mode, method, crossed=crossed))
