"""`assur certify`: a proof of what a working mode reaches, or of a path, as a file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from assur.cli.options import (
    REGION,
    SHARED_DEFAULTS,
    MechanismName,
    Outcome,
    RegionOptions,
    Shared,
    WorkingMode,
)
from assur.errors import UsageError


def certify(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[str, Parameter(name=("-o", "--output"), metavar="FILE", help="Where the proof goes (.json).")],
    kind: Annotated[
        Literal["workspace", "box", "path"],
        Parameter(
            help="Bounds of the volume; whether all of the box is reached and free of singularities; a path that is."
        ),
    ] = "workspace",
    mode: WorkingMode = None,
    where: RegionOptions = REGION,
    start: Annotated[
        str | None,
        Parameter(name="--from", metavar="X,Y,..", help="A pose, of --kind path: values in order, or NAME=VALUE."),
    ] = None,
    end: Annotated[
        str | None, Parameter(name="--to", metavar="X,Y,..", help="Another pose, of --kind path: where it leads.")
    ] = None,
    gap: Annotated[
        str | None,
        Parameter(metavar="SHARE", help="Share of the volume that may stay open; 0.01, or 0.0001 of --kind box."),
    ] = None,
    finest: Annotated[
        str, Parameter(metavar="SHARE", help="Halve no side below this share of the box's; no limit if left out.")
    ] = "0",
    most: Annotated[
        str, Parameter(metavar="LEAVES", help="Leaves of the proof at most; 100000 if left out.")
    ] = "100000",
    resume: Annotated[bool, Parameter(help="Carry on the certificate that the file has, where it has one.")] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Prove what a working mode reaches, and write the proof to a file.

    The file holds the formulas and a tree of boxes, each of which is inside,
    outside, or left open; `assur verify` checks every one of them again. After
    Ctrl-C what is proved is kept, the rest is open, and --resume carries on.
    --kind path looks for one inside --box, as `assur aspects` does, with boxes
    down to --finest, and proves it; where there is none no file is written.
    Exit code of --kind box and path, 4: it is proved not to be so; 5: undecided.
    --box and --stroke may be repeated; lengths and angles are in the
    mechanism's units. Degrees become floats in rad, those of a box of --kind box
    rounded outwards.

    For example:
        assur certify zeng2019 -o cert.json
        assur certify zeng2019 -o b.json --kind box --box x=-20:0 --box z=400:420
        assur certify fivebar -o p.json --kind path --from -60,150 --to 60,220
    """
    record = shared.mechanism(mechanism)
    from assur.certificates.certificate import certificate
    from assur.cli.certified_path import written
    from assur.cli.certified_regions import outer_box
    from assur.cli.numbers import number, whole_number
    from assur.cli.paths import output_file
    from assur.cli.progress import progress
    from assur.cli.region_question import question

    _compatible(kind, start, end, gap, resume)
    asked = question(record, mode, where)
    target = output_file(output, (".json",))
    share = None if gap is None else number(gap, "--gap")
    least, leaves = number(finest, "--finest"), whole_number(most, "--most")
    if start is not None and end is not None:
        from assur.cli import certified_path

        ends = certified_path.TypedEnds(start, end)
        return certified_path.outcome(record, asked, ends, least, leaves, target, shared)
    with progress("certify", shared) as step:
        found = certificate(
            record,
            asked.mode,
            outer_box(record, asked.box, asked.held) if kind == "box" else asked.box,
            asked.strokes,
            asked.held,
            kind="box" if kind == "box" else "workspace",
            gap=share,
            finest=least,
            most=leaves,
            progress=step,
            start=_earlier(target) if resume and target.exists() else None,
        )
    return written(found, target, record, shared)


def _compatible(kind: str, start: str | None, end: str | None, gap: str | None, resume: bool) -> None:
    if kind != "path":
        if start is not None or end is not None:
            raise UsageError("--from and --to are of a path", hint="add --kind path")
        return
    if start is None or end is None:
        raise UsageError("--kind path: from which pose to which?", hint="add --from and --to")
    if gap is not None or resume:
        raise UsageError("--kind path has no --gap and no --resume", hint="leave them out: a path is proved whole")


def _earlier(path: Path) -> Mapping[str, Any]:
    """The certificate of a file; one that proves nothing is refused before it is carried on."""
    from assur.results.reading import MOST_CERTIFICATE, file_content
    from assur.verifier.reading import RefusedError, read

    try:
        return read(file_content(path, MOST_CERTIFICATE))
    except RefusedError as error:
        raise UsageError(f"cannot carry on {path}: {error}", hint="leave --resume out to begin anew") from error
