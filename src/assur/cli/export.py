"""`assur export`: a mechanism as a file that a simulator, a CAD program, a viewer or a printer reads."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome
from assur.results.answers.answer import ABSENT

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import RenderableType

    from assur.export.files import Format
    from assur.mechanism import Mechanism
    from assur.results.answers.files import WrittenExport

SIMULATED = ("mjcf", "sdf", "urdf")
UNDRAWN = (*SIMULATED, "glb", "c")
"""What has no bill of materials."""


def export(
    mechanism: MechanismName,
    /,
    *,
    format_: Annotated[
        Literal["mjcf", "sdf", "urdf", "step", "glb", "stl", "bom", "c"],
        Parameter(
            name="--format",
            help="For simulators mjcf (MuJoCo, Newton, Drake, Pinocchio; if left out), sdf (Gazebo), urdf (a tree, with"
            " a file of loops beside it); for prototypes step (CAD; it needs the extra cad), stl (printers), glb"
            " (moving), bom (parts and bearings); for controllers c (the closed form in C99).",
        ),
    ] = "mjcf",
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"), metavar="FILE", help="The file to be written, NAME.xml and so on; of stl a folder."
        ),
    ] = None,
    servos: Annotated[
        bool,
        Parameter(
            name="--servos",
            negative=(),
            help="Of mjcf: position servos, whose control is the printed input, in place of motors.",
        ),
    ] = False,
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """Write a mechanism for a simulator, for CAD, viewers, printers or controllers.

    Simulator files are in m and rad, standing at home. MJCF closes the loops by
    points that stay together and has a motor for each input: MuJoCo, Newton and
    Drake read both, Pinocchio the loops. What ties a screw's turn to its advance
    only MuJoCo and Newton read. SDF 1.9 has every joint as it is, and no motors:
    libsdformat 12 and newer (Gazebo) read it, Drake refuses its loops. URDF is a
    tree, which all of them read; no engine reads its loops, which stand in a
    file beside it, FILE.loops.json. Masses are those of the mechanism's file; where
    it does not say all of them they are nominal: 1 kg for each link.

    Prototype files have links with bores, pins, rails and carriages; lengths
    that the joint graph gives are kept, all others are drawn, to begin with.
    STEP is an assembly of named solids in mm, STL one watertight file per link
    in mm; beside both a bill of materials. GLB moves once round and back.

    C99 is the closed form in one file, for a controller: direct and inverse
    problem with Jacobians, margins and factors, nothing allocated, -lm alone.

    For example:
        assur export fivebar -o fivebar.xml
        assur export fivebar --servos -o fivebar-servos.xml
        assur export zeng2019 --format urdf -o zeng.urdf
        assur export zeng2019 --format step --thickness 12 -o zeng.step
        assur export zeng2019 --format stl -o printed
        assur export zeng2019 --format c -o zeng2019.c
    """
    record = shared.mechanism(mechanism)
    from assur.cli.progress import progress
    from assur.errors import UsageError
    from assur.export.cad.bill import bill
    from assur.export.files import export
    from assur.results.answers.files import WrittenExport

    if servos and format_ != "mjcf":
        raise UsageError(f"--servos: {format_} has no actuators", hint="it is for mjcf")
    if format_ == "c" and shared.thickness is not None:
        raise UsageError("--thickness: formulas have none", hint="it is for step, stl, glb and bom")
    if format_ in SIMULATED and shared.thickness is not None:
        raise UsageError(
            f"--thickness: {format_} has balls and arms of its own sizes", hint="it is for step, stl, glb and bom"
        )
    path = _path(record, format_, output)
    with progress("export", shared):
        written = [str(item) for item in export(record, format_, path, servos=servos)]
        rows = () if format_ in UNDRAWN else bill(record)
    answer = WrittenExport(record.name, format_, tuple(written))
    if format_ in SIMULATED:
        from assur.export.bodies import MASS
        from assur.machine.masses.link_masses import masses

        if masses(record).lacking:
            answer = replace(answer, nominal_mass_kg=MASS)
    elif format_ != "c":
        from assur.scene.sizes import thickness

        answer = replace(answer, bill=rows or ABSENT, thickness=thickness(record))
    return Outcome(answer, lambda: _shown(record, answer))


def _path(record: Mechanism, form: Format, output: str | None) -> Path:
    """Where it goes; looked at before the work begins, and of STEP that there is what makes it."""
    from assur.cli.paths import output_file, output_folder
    from assur.export.files import ENDINGS

    if form == "step":
        from assur.export.cad.kernel import needed

        needed()
    endings = ENDINGS[form]
    if not endings:
        return output_folder(output or f"{record.name}-{form}")
    return output_file(output or f"{record.name}{'.bom' if form == 'bom' else ''}{endings[0]}", endings)


def _shown(record: Mechanism, data: WrittenExport) -> Iterable[RenderableType]:
    from assur.cli.output import heading, table

    yield heading(f"{record.name}, {data.format}")
    files = data.files
    yield (
        f"written: {len(files)} files in {files[0].rpartition('/')[0] or '.'}"
        if len(files) > 3
        else "\n".join(f"written: {name}" for name in files)
    )
    if data.nominal_mass_kg is not ABSENT:
        yield f"masses are nominal: {data.nominal_mass_kg:g} kg for each link"
    elif data.format in SIMULATED:
        yield "masses are those of the mechanism's file: see assur show --masses"
    rows = () if data.bill is ABSENT else data.bill
    for kind, title in (("make", "to make, sizes in mm"), ("buy", "to buy")):
        chosen = [(str(row.count), row.what, " ".join(row.names)) for row in rows if row.kind == kind]
        if chosen:
            yield ""
            columns = ("count", "what", "links" if kind == "make" else "joints")
            yield table(columns, chosen, title=title, left=columns[1:], wrap=columns[1:])
    if data.thickness is not ABSENT:
        yield (
            f"as drawn, a beginning and not a design: flat bars are {data.thickness:.3g} {record.unit} thick, and"
            " widths, pins, balls and rails go with them; --thickness says otherwise"
        )
