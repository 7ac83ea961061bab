"""`assur certify`: a proof of what a working mode reaches, as a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from assur.cli.options import (
    SHARED_DEFAULTS,
    Box,
    Held,
    MechanismName,
    Outcome,
    Shared,
    Stroke,
    WorkingMode,
)
from assur.errors import UsageError


def certify(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[str, Parameter(name=("-o", "--output"), metavar="FILE", help="Where the proof goes (.json).")],
    kind: Annotated[
        Literal["workspace", "box"],
        Parameter(help="Bounds of the volume, or whether all of the box is reached and free of singularities."),
    ] = "workspace",
    mode: WorkingMode = None,
    box: Box = (),
    stroke: Stroke = (),
    at: Held = (),
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
    --box and --stroke may be repeated; lengths and angles are in the
    mechanism's units. Degrees become floats in rad, those of a box of --kind box
    rounded outwards.

    For example:
        assur certify zeng2019 -o cert.json
        assur certify zeng2019 -o b.json --kind box --box x=-20:0 --box z=400:420
    """
    record = shared.mechanism(mechanism)
    from assur.certificates.certificate import certificate
    from assur.certificates.summary import claim_lines, statement_lines
    from assur.cli.certified_regions import outer_box
    from assur.cli.numbers import number, whole_number
    from assur.cli.output import heading
    from assur.cli.paths import output_file
    from assur.cli.progress import progress
    from assur.cli.regions import question

    asked = question(record, mode, box, stroke, None, (), None, at)
    target = output_file(output, (".json",))
    share = None if gap is None else number(gap, "--gap")
    least, leaves = number(finest, "--finest"), whole_number(most, "--most")
    with progress("certify", shared) as step:
        found = certificate(
            record,
            asked.mode,
            outer_box(record, asked.box, asked.held) if kind == "box" else asked.box,
            asked.strokes,
            asked.held,
            kind=kind,
            gap=share,
            finest=least,
            most=leaves,
            progress=step,
            start=_earlier(target) if resume and target.exists() else None,
        )
    found.write(target)
    document = found.to_json()
    first, *rest = [*statement_lines(document, record), *claim_lines(document, record)]
    lines = [*rest, "how: interval arithmetic, not yet checked by `assur verify`", f"written: {target}"]
    data = {key: value for key, value in document.items() if key not in ("program", "proof")}
    return Outcome({**data, "written": str(target)}, lambda: [heading(first), *lines])


def _earlier(path: Path) -> dict[str, Any]:
    """The certificate of a file; one that proves nothing is refused before it is carried on."""
    from assur.verifier.reading import RefusedError, read

    try:
        return read(path.read_bytes())
    except RefusedError as error:
        raise UsageError(f"cannot carry on {path}: {error}", hint="leave --resume out to begin anew") from error
