"""Writing an export: one file, or several: loops beside URDF, a bill of materials beside STEP, a folder of STL."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from assur.errors import OutputError
from assur.export.mjcf import mjcf
from assur.export.sdf import sdf
from assur.export.sidecar import sidecar
from assur.export.urdf import urdf
from assur.model.mechanism import MechanismRecord
from assur.results.files import write_whole
from assur.results.json_text import json_text

Format = Literal["mjcf", "sdf", "urdf", "step", "glb", "stl", "bom", "c"]
ENDINGS: dict[Format, tuple[str, ...]] = {
    "mjcf": (".xml", ".mjcf"),
    "sdf": (".sdf",),
    "urdf": (".urdf",),
    "step": (".step", ".stp"),
    "glb": (".glb",),
    "stl": (),
    "bom": (".csv",),
    "c": (".c",),
}
"""Endings of the file; none where a folder is written."""

BILL = "bom.csv"


def export(record: MechanismRecord, form: Format, path: Path, *, servos: bool = False) -> tuple[Path, ...]:
    """Write a mechanism in one form; returns the files written. Of STL the path is that of a folder.

    `servos`: of MJCF, position servos in place of motors. Beside FILE.urdf stands FILE.loops.json, beside FILE.step
    FILE.bom.csv, and in the folder of STL files bom.csv.
    """
    if form == "mjcf":
        return (write_whole(path, mjcf(record, servos=servos)),)
    if form == "sdf":
        return (write_whole(path, sdf(record)),)
    if form == "c":
        from assur.export.c99 import c99_text

        return (write_whole(path, c99_text(record)),)
    if form in ("step", "glb", "stl", "bom"):
        return _prototype(record, form, path)
    text, loops = urdf(record), json_text(sidecar(record, path.name)) + "\n"
    return write_whole(path, text), write_whole(path.with_suffix(".loops.json"), loops)


def _prototype(record: MechanismRecord, form: Format, path: Path) -> tuple[Path, ...]:
    """What is drawn, for CAD, viewers and printers."""
    from assur.export.cad.bill import bill, bill_csv
    from assur.kinematics.home import home_values

    if form == "glb":
        from assur.export.cad.glb import glb
        from assur.scene.motion import closed_motion

        return (write_whole(path, glb(record, closed_motion(record))),)
    if form == "step":
        from assur.export.cad.step import step

        beside = path.with_suffix(f".{BILL}")
        return write_whole(path, step(record, home_values(record))), write_whole(beside, bill_csv(bill(record)))
    if form == "bom":
        return (write_whole(path, bill_csv(bill(record))),)
    from assur.export.cad.stl import stl_files

    if not path.is_dir():
        raise OutputError(f"cannot write into {path}: it is no folder", hint=f"mkdir -p {path}")
    files = {**stl_files(record), BILL: bill_csv(bill(record)).encode()}
    return tuple(write_whole(path / name, content) for name, content in files.items())
