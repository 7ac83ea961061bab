"""`assur doctor`: whether this installation can be trusted."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain


def doctor(
    *,
    output: Annotated[
        str, Parameter(name=("-o", "--output"), metavar="DIR", help="Where output is to go; ./out if left out.")
    ] = "out",
    shared: Plain = PLAIN,
) -> Outcome:
    """Check the installation: Python, packages, pins, and the numbers.

    The numbers: home of every mechanism is assembled from its joint graph
    alone, and the closed form must find the same configuration; every solution
    of the closed form must close the joint graph. Exit code 1: something that
    is needed is missing, or a number is wrong. Nothing is changed.

    For example:
        assur doctor
        assur doctor --json
    """
    from assur.cli import checkup

    return checkup.outcome(output, shared)
