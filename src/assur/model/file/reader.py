"""Reads a mechanism file: text -> form -> record, with every fault of the file in one error."""

from __future__ import annotations

import os
from pathlib import Path

from assur.errors import MechanismFileError, Problem, UsageError
from assur.model.file.build import built
from assur.model.file.description import Description
from assur.model.file.faults import Faults
from assur.model.file.form import check_form
from assur.model.file.toml_source import read_toml
from assur.model.file.topology_schema import is_topology
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text


def read_mechanism(path: Path) -> MechanismRecord:
    """The record of a mechanism file, without its closed form.

    Errors:
        MechanismFileError: the file has faults; all of them are in it.
        UsageError: there is no such file, it cannot be read, or it is a topology file.
    """
    return read_text(description_text(path), path)


def with_ending(text: str) -> str:
    """The hint that a file has the name but for its ending; empty where there is none.

    >>> with_ending("no such file")
    ''
    """
    there = text.strip() and os.path.isfile(f"{text}.toml")  # noqa: PTH113  # which a name that is none does not upset
    return f"did you mean {text}.toml?" if there else ""


def description_text(path: Path) -> str:
    """The text of a mechanism's or a topology's file.

    Errors: as `assur.results.reading.file_text`.
    """
    return file_text(path, hint=with_ending(str(path)))


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
    source = read_toml(text, str(path))
    if is_topology(source.data):
        raise UsageError(f"{path} is a topology without dimensions", hint=f"assur topology {path}")
    faults = Faults(str(path), source)
    entry, cut = check_form(source.data, faults)
    if entry is None:
        faults.raise_any()
        raise MechanismFileError([Problem(str(path), None, "", "a broken document", "allowed: the form of a file")])
    return built(Description(path, source, entry, cut), {}, faults), faults
