"""`assur crosscheck`: our kinematics against an engine that reads the exported file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.results.answers.comparison import CrossCheckAnswer

CLAIM_FAILS = 1


def crosscheck(
    mechanism: MechanismName,
    /,
    *,
    engine: Annotated[
        Literal["mujoco"], Parameter(help="The engine; it comes with the extra sim: pip install '.[sim]'.")
    ] = "mujoco",
    samples: Annotated[str, Parameter(metavar="COUNT", help="Random poses; 20 if left out.")] = "20",
    seed: Annotated[str, Parameter(metavar="NUMBER", help="Of the random poses; 0 if left out.")] = "0",
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Compare every mode's solutions with a simulator's own kinematics.

    The engine loads the exported file. At random poses, and at inputs that
    reach one, the frames of all links, its loop constraints, inputs, freedoms
    and Jacobian are compared with ours, where its own Newton iteration ends
    from nearby, and, where the file says all masses, the forces of the actuators
    in motion, by its masses and constraints. Exit code 1: a difference is larger than rounding.

    For example:
        assur crosscheck fivebar --engine mujoco
        assur crosscheck zeng2019 --samples 100 --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli.interruption import handing_over
    from assur.cli.numbers import whole_number
    from assur.cli.progress import progress
    from assur.crosscheck.crosscheck import crosscheck
    from assur.errors import UsageError
    from assur.results.answers.comparison import CrossCheckAnswer

    poses, start = whole_number(samples, "--samples"), whole_number(seed, "--seed")
    if poses < 1 or start < 0:
        raise UsageError(f"--samples {poses}, --seed {start}: at least 1 pose, and a seed that is not negative")
    with handing_over(CrossCheckAnswer, _outcome), progress("crosscheck", shared):
        found = crosscheck(record, engine, samples=poses, seed=start)
    return _outcome(found)


def _outcome(comparison: CrossCheckAnswer) -> Outcome:
    return Outcome(comparison, lambda: _shown(comparison), 0 if comparison.holds else CLAIM_FAILS)


def _shown(comparison: CrossCheckAnswer) -> Iterable[RenderableType]:
    from assur.cli.output import heading, table
    from assur.results.plain_text import count

    said = (
        "agree"
        if comparison.holds
        else "DIFFER"
        if comparison.differences
        else "nothing to compare: no pose was reached"
    )
    yield heading(f"{comparison.mechanism}, assur and MuJoCo {comparison.version}: {said}")
    for problem, modes in comparison.modes.items():
        yield f"{problem}: {count(sum(modes.values()), 'solution')} in {count(len(modes), 'mode')}"
    rows = [
        (item.kind, f"{item.largest:.1e}", f"{item.tolerance:.0e}", str(item.count), item.mode)
        for item in comparison.differences
    ]
    styles = ["" if item.holds else "bold red" for item in comparison.differences]
    yield ""
    columns = ("compared", "largest", "allowed", "times", "in mode")
    yield table(columns, rows, left=("compared", "in mode"), styles=styles)
    yield "lengths as shares of the characteristic length, turns in rad"
