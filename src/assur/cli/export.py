"""`assur export`: a mechanism as a file that a simulator reads."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def export(
    mechanism: MechanismName,
    /,
    *,
    format_: Annotated[
        Literal["mjcf", "sdf", "urdf"],
        Parameter(name="--format", help="mjcf (MuJoCo) if left out; sdf (Gazebo, Drake); urdf with a file of loops."),
    ] = "mjcf",
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="The file to be written; NAME.xml, .sdf or .urdf."),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Write a mechanism for a simulator, in m and rad, standing at home.

    MJCF closes the loops by stiff constraints and has a servo for each input.
    SDF has every joint as it is. URDF is a tree; its loops stand in a file
    beside it, FILE.loops.json. Masses are nominal: 1 kg for each link.

    For example:
        assur export fivebar -o fivebar.xml
        assur export zeng2019 --format urdf -o zeng.urdf
    """
    record = shared.mechanism(mechanism)
    from assur.cli.output import heading
    from assur.cli.paths import output_file
    from assur.export.bodies import MASS
    from assur.export.files import ENDINGS, export

    endings = ENDINGS[format_]
    path = output_file(output or f"{record.name}{endings[0]}", endings)
    written = [str(item) for item in export(record, format_, path)]
    data = {"mechanism": record.name, "format": format_, "files": written, "nominal_mass_kg": MASS}
    lines = [heading(f"{record.name}, {format_}"), *(f"written: {name}" for name in written)]
    return Outcome(data, lambda: [*lines, f"masses are nominal: {MASS:g} kg for each link"])
