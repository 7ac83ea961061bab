"""Reads a mechanism file: text -> form -> record, with every fault of the file in one error."""

from __future__ import annotations

from pathlib import Path

from assur.errors import UsageError
from assur.model.file.build import built
from assur.model.file.description import Description, description_text
from assur.model.file.faults import Faults
from assur.model.file.kind import is_topology
from assur.model.mechanism import MechanismRecord


def read_mechanism(path: Path) -> MechanismRecord:
    """The record of a mechanism file, without its closed form.

    Errors:
        MechanismFileError: the file has faults; all of them are in it.
        UsageError: there is no such file, it cannot be read, or it is a topology file.
    """
    return read_text(description_text(path), path)


def read_text(text: str, path: Path) -> MechanismRecord:
    """The record of the text of a mechanism file; `path` is what its errors name.

    Errors:
        MechanismFileError: the file has faults; all of them are in it.
        UsageError: it is a topology file, which has no dimensions.

    Example:
        >>> from importlib.resources import files
        >>> text = files("assur").joinpath("mechanisms/zeng2019/mechanism.toml").read_text(encoding="utf-8")
        >>> record = read_text(text, Path("zeng2019.toml"))
        >>> len(record.joints), record.joint("R3").name, record.parameters["l2"].value
        (17, 'D1', 280.0)
    """
    record, faults = examined(text, path)
    faults.raise_any()
    return record


def examined(text: str, path: Path) -> tuple[MechanismRecord, Faults]:
    """The record of a text with the faults that it has; where there are some, parts of the record are unknown.

    Errors:
        MechanismFileError: faults that leave nothing to look at further, as text that is not TOML.
        UsageError: as `read_text`.
    """
    description = Description(path, text)
    if is_topology(description.source.data):
        raise UsageError(f"{path} is a topology without dimensions", hint=f"assur topology {path}")
    faults = description.form.faults.copy()
    return built(description, {}, faults), faults
