"""Writing an export: one file, and for URDF the loops in a second one beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from assur.export.mjcf import mjcf
from assur.export.sdf import sdf
from assur.export.sidecar import sidecar
from assur.export.urdf import urdf
from assur.model.mechanism import MechanismRecord
from assur.results.files import write_whole
from assur.results.json_text import json_text

Format = Literal["mjcf", "sdf", "urdf"]
ENDINGS: dict[Format, tuple[str, ...]] = {"mjcf": (".xml", ".mjcf"), "sdf": (".sdf",), "urdf": (".urdf",)}


def export(record: MechanismRecord, form: Format, path: Path) -> tuple[Path, ...]:
    """Write a mechanism in a simulator's form; returns the files written.

    The file beside a URDF file is called like it, but ends in .loops.json.
    """
    if form == "mjcf":
        return (write_whole(path, mjcf(record)),)
    if form == "sdf":
        return (write_whole(path, sdf(record)),)
    text, loops = urdf(record), json_text(sidecar(record, path.name)) + "\n"
    return write_whole(path, text), write_whole(path.with_suffix(".loops.json"), loops)
