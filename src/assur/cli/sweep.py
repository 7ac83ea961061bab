"""`assur sweep`: a grid of poses or inputs, of any size, solved into files; in parts, and on many machines."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared
from assur.errors import UsageError


def sweep(
    mechanism: MechanismName | None = None,
    /,
    *,
    output: Annotated[
        str,
        Parameter(name=("-o", "--output"), metavar="DIR", help="Folder of the files, made where it is missing."),
    ],
    along: Annotated[
        tuple[str, ...],
        Parameter(
            metavar="NAME=LOW:HIGH:COUNT,..",
            help="Places along one coordinate, both ends too; NAME=COUNT takes the file's box or stroke.",
        ),
    ] = (),
    at: Annotated[tuple[str, ...], Parameter(metavar="NAME=VALUE,..", help="Hold coordinates.")] = (),
    dimension: Annotated[
        tuple[str, ...],
        Parameter(
            metavar="NAME=LOW:HIGH:COUNT,..",
            help="Values of a dimension, each with all of the grid; where nothing else is given, at home.",
        ),
    ] = (),
    problem: Annotated[
        Literal["inverse", "direct"], Parameter(help="The grid is one of poses (inverse) or of inputs (direct).")
    ] = "inverse",
    mode: Annotated[
        str | None,
        Parameter(help="One mode, or 'all'. If left out: the file's working mode (inverse), all (direct)."),
    ] = None,
    keep: Annotated[
        tuple[str, ...],
        Parameter(metavar="NAME,..", help="What to keep; inputs,status (inverse) or poses,exists (direct)."),
    ] = (),
    threads: Annotated[str, Parameter(metavar="COUNT", help="How many work on it; as many as cores.")] = "0",
    shard: Annotated[
        str | None,
        Parameter(metavar="I/N", help="Work out the I-th of N parts of the grid alone, I from 1 on."),
    ] = None,
    merge: Annotated[
        tuple[str, ...],
        Parameter(metavar="DIR..", consume_multiple=True, help="Join the shards in these folders; alone, with -o."),
    ] = (),
    scheduler: Annotated[
        str | None,
        Parameter(metavar="ADDRESS", help="Let the workers of a Dask cluster do it, as tcp://localhost:8786."),
    ] = None,
    repair: Annotated[bool, Parameter(help="Compute again what is damaged in the folder.")] = False,
    certify: Annotated[bool, Parameter(show=False, help="Refused, with what proves.")] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    r"""Solve a grid of poses or inputs, into files.

    Any number of poses, 10^9 too: memory is that of a few blocks, and what the
    files will take is told before. After Ctrl-C (exit code 130), or a kill, the
    same command goes on where it stopped, to the same bytes; until all is done
    the arrays end in .part. Every block has a checksum: what is damaged is told
    (exit code 3), and --repair computes it again. A folder of another grid is
    refused. --along and --at are given once per coordinate, or with commas
    between; lengths and angles are in the mechanism's units, in the files too.
    Where there is no solution the numbers are NaN. Without a closed form poses
    or inputs are followed to from home and from neighbours; what is not reached
    so is undecided.

    --dimension sweeps a dimension too, alone or with a grid: each mechanism is
    the one of --set. Where the file does not allow the dimensions, or without a
    closed form its home does not close, the status is no_mechanism, with the reason.

    Beyond one machine: --shard 2/7 works out a part, --merge joins the parts to
    the bytes of a single run; --scheduler uses a Dask cluster (pip install
    '.[cluster]').

    To keep: inputs or poses, exists, status; of the inverse problem in one mode
    also det_jp, det_jq, factors, condition_index (1/cond of Jp^-1 Jq) and
    smallest (its smallest singular value). Each is a .npy file; sweep.json says
    what they hold.

    For example:
        assur sweep zeng2019 --along x=200 --along y=50 --along z=200 -o out/grid
        assur sweep zeng2019 --along x=-110:80:96 --along z=300:450:76 --at y=0 \
            --keep inputs,condition_index -o out/plane
        assur sweep fivebar --problem direct --along theta1=0:180:361 \
            --along theta2=0:180:361 -o out/poses
        assur sweep zeng2019 --dimension l2=250:300:51 --along z=300:450:76 \
            --at x=0,y=0 -o out/lengths
        assur sweep --merge out/part-1 out/part-2 -o out/whole
    """
    from assur.cli import sweep_answer, sweep_grid
    from assur.cli.numbers import whole_number
    from assur.results.store.layout import Shard

    if certify:
        raise UsageError(
            "--certify: a sweep answers at the places of its grid, by the closed form or by following, and proves none",
            hint="`assur workspace --certify` bounds a region, `assur inverse --certify` proves one pose",
        )
    workers = whole_number(threads, "--threads")
    part = Shard.read(shard) if shard is not None else None
    request = sweep_answer.Request(output, workers, part, scheduler, repair)
    if merge:
        if mechanism or along or at or dimension or mode or keep or shard or scheduler:
            raise UsageError("--merge stands alone, with -o and --repair", hint="the shards know of what they are")
        return sweep_answer.merged(merge, request, shared)
    if mechanism is None:
        raise UsageError("no mechanism to sweep", hint="name one, or give the folders of shards to --merge")
    record = shared.mechanism(mechanism)
    grid = sweep_grid.asked(record, problem, along, at, dimension)
    kept = tuple(name.strip() for text in keep for name in text.split(","))
    return sweep_answer.outcome(record, mechanism, grid, problem, mode, kept, request, shared)
