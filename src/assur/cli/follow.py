"""`assur follow`: a path of poses or inputs, followed in one mode until something stops it."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def follow(
    mechanism: MechanismName,
    /,
    *,
    to: Annotated[
        tuple[str, ...],
        Parameter(
            consume_multiple=1,
            metavar="VALUE",
            help="Where to go: one value per coordinate; the values of several points for a polyline.",
        ),
    ],
    from_: Annotated[
        tuple[str, ...],
        Parameter(
            name="--from", consume_multiple=1, metavar="VALUE", help="Where to begin; home of the file if left out."
        ),
    ] = (),
    along: Annotated[
        Literal["pose", "inputs"], Parameter(help="What is given, by --from and --to: poses (pose) or inputs (inputs).")
    ] = "pose",
    mode: Annotated[
        str | None,
        Parameter(help="Mode at --from: working for poses, assembly for inputs; the file's default if left out."),
    ] = None,
    turns: Annotated[
        Literal["short", "given"], Parameter(help="Angles go the short way (short) or by the numbers given (given).")
    ] = "short",
    no_limits: Annotated[bool, Parameter(help="Leave strokes of inputs and limits of joints aside.")] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """A path from point to point, straight in poses or in inputs, the mode kept.

    It stops before it would meet a singularity, the border of reach or a limit of
    the file, and says which; it never jumps to another mode. Exit code 6: it
    stopped before the end; 4: it is proved that the mechanism does not reach
    --from; 5: undecided.

    For example:
        assur follow fivebar --from 0 200 --to 60 220
        assur follow zeng2019 --along inputs --to 200 -200 50
    """
    record = shared.mechanism(mechanism)
    from assur.cli.followed import outcome

    return outcome(record, along, from_, to, mode=mode, turns=turns, use_limits=not no_limits)
