"""`assur workspace`: the poses that one working mode reaches."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import (
    REGION,
    SHARED_DEFAULTS,
    MechanismName,
    Outcome,
    RegionOptions,
    Shared,
    WorkingMode,
    refuse,
)


def workspace(
    mechanism: MechanismName,
    /,
    *,
    mode: WorkingMode = None,
    where: RegionOptions = REGION,
    resolution: Annotated[
        str | None,
        Parameter(metavar="CELLS", help="Cells along each coordinate; 64, or 20 if followed in space."),
    ] = None,
    section: Annotated[
        tuple[str, ...],
        Parameter(metavar="VALUE", help="Cut across the last coordinate; the file's sections if left out."),
    ] = (),
    near: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="How near a parallel singularity is near; 3.5 % of the size if left out."),
    ] = None,
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="Write the answer (.json) or surface (.obj)."),
    ] = None,
    certify: Annotated[
        bool, Parameter(negative="", help="Prove bounds of the volume and of the sections, by intervals.")
    ] = False,
    gap: Annotated[
        str | None,
        Parameter(metavar="SHARE", help="With --certify: by how much the bounds may differ; 1e-3 if left out."),
    ] = None,
    finest: Annotated[
        str | None,
        Parameter(metavar="LENGTH", help="With --certify, in place of a gap: size at which boxes are no longer cut."),
    ] = None,
    boxes: Annotated[
        str | None,
        Parameter(metavar="N", help="Of a proof: boxes looked at, at most; 10 million, some two minutes, if left out."),
    ] = None,
    prove: Annotated[
        str | None,
        Parameter(metavar="NAME=LOW:HIGH,..", help="Prove that all of this box is reached and none of it singular."),
    ] = None,
    largest: Annotated[
        Literal["cube", "cylinder", "ball"] | None,
        Parameter(help="The largest that is proved in the same sense, about the point --around."),
    ] = None,
    around: Annotated[str | None, Parameter(metavar="NAME=VALUE,..", help="With --largest: the middle.")] = None,
    ratio: Annotated[
        str | None, Parameter(metavar="NUMBER", help="With --largest cylinder: height over diameter; 1 if left out.")
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """The workspace of one working mode: volume, sections, loci.

    The volume comes with an estimate of its error, from two resolutions. Where
    a factor of det Jp vanishes inside, the surface's area is given, and the
    share of the volume that is near one. --box, --stroke and --section may be
    repeated; lengths and angles are in the mechanism's units.

    With --certify, --prove or --largest the answer is a proof by intervals and
    needs a closed form. It ends whatever is asked: what --boxes or the floats
    leave open is undecided, and said to be. Ctrl-C ends it with the bounds
    reached. Exit code 4: a pose fails, which is shown; 5: undecided.

    For example:
        assur workspace zeng2019
        assur workspace zeng2019 --box x=-110:80 --stroke -300:300 -o out.obj
        assur workspace zeng2019 --mode ++++- --stroke yA1=-200:200 --json
        assur workspace planar_3rpr --at phi=10
        assur workspace zeng2019 --certify --gap 1e-5
        assur workspace zeng2019 --prove x=-40:0,y=-50:50,z=380:400
        assur workspace zeng2019 --largest cube --around x=-40,y=0,z=400
    """
    record = shared.mechanism(mechanism)
    from assur.cli import region_question, regions

    asked = region_question.question(record, mode, where, resolution, section, near)
    if certify or prove is not None or largest is not None:
        from assur.cli import certified_regions

        elsewhere = "leave it out; `assur certify` writes a proof to a file"
        refuse("of the estimate, not of a proof", elsewhere, resolution=resolution, near=near, output=output)
        if prove is not None or largest is not None:
            refuse(
                "of the whole workspace, not of --prove and --largest", "leave it out", certify=certify, section=section
            )
        if largest is not None:
            refuse("--largest looks as far as it is reached", "leave it out", box=where.box)
        proof = certified_regions.ProofQuestion(gap, finest, boxes, prove, largest, around, ratio)
        return certified_regions.outcome(record, asked, proof, shared)
    refuse("part of a proof", "add --certify", gap=gap, finest=finest, boxes=boxes)
    refuse("part of a proof", "add --largest cube", around=around)
    refuse("part of a proof", "add --largest cylinder", ratio=ratio)
    target = regions.target(output) if output is not None else None
    return regions.outcome(record, asked, target, shared)
