"""`assur aspects`: the connected singularity-free parts of the workspace of a working mode, with proof."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import REGION, SHARED_DEFAULTS, MechanismName, Outcome, RegionOptions, Shared


def aspects(
    mechanism: MechanismName,
    /,
    *,
    mode: Annotated[
        str | None,
        Parameter(help="Working mode, as ++-++, or all; the default of the mechanism's file if left out."),
    ] = None,
    where: RegionOptions = REGION,
    finest: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="Size at which boxes are no longer cut; a share of the box if left out."),
    ] = None,
    start: Annotated[
        str | None,
        Parameter(name="--from", metavar="X,Y,..", help="A pose: values of the coordinates that vary, or NAME=VALUE."),
    ] = None,
    end: Annotated[
        str | None,
        Parameter(name="--to", metavar="X,Y,..", help="Another pose: is it in the same aspect, and by which path?"),
    ] = None,
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="Draw them (.svg, .png, .pdf), or write them (.json)."),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """The aspects of a working mode: connected parts without singularities.

    In one aspect every pose is reached, and no factor of det Jp or det Jq is
    zero. Boxes joined by faces prove what is connected; signs of factors, and
    the lack of any chain of undecided boxes, prove what is not. Volumes come
    with proved bounds. All of it holds inside the box that is looked at.

    With --from alone: in which aspect that pose lies. With --from and --to: a
    path between the two, piece by piece inside boxes that prove it; the path is
    then checked by the closed form and followed on the joint graph. Exit code
    4: not the same aspect, or a pose is not reached; 5: undecided.

    For example:
        assur aspects zeng2019 -o aspects.svg
        assur aspects fivebar --mode all --box x=-300:300 --box y=-300:300
        assur aspects zeng2019 --from -40,-100,250 --to 60,100,300
    """
    record = shared.mechanism(mechanism)
    from assur.cli import aspects_answer

    asked = aspects_answer.AspectQuestion(mode, where, finest, start, end, output)
    return aspects_answer.outcome(record, asked, shared)
