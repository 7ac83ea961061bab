"""Errata of a source: each stands with evidence that is computed anew whenever it is asked for.

`reference/errata.toml` has a table for every erratum. Its `evidence`, as "direct.false_root", names a function
of `reference/evidence/direct.py`, which takes the record and returns an `Evidence`; the file is loaded by path,
as `closed_form.py` is.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import cast

from pydantic import RootModel

from assur.audit.reference import ERRATA, checked, reference_folder
from assur.audit.rows import Erratum, Evidence
from assur.errors import MechanismFileError, Problem, UnknownNameError
from assur.model.file.schema import Entry
from assur.model.file.toml_source import read_toml
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text

EVIDENCE = "evidence"


class ErratumEntry(Entry):
    """An erratum as its file says it."""

    where: str
    printed: str
    finding: str
    evidence: str
    not_computed: str = ""
    status: str = "unreported"


class ErrataFile(RootModel[dict[str, ErratumEntry]]):
    """Errata by id."""


def errata(record: MechanismRecord) -> tuple[Erratum, ...]:
    """Every erratum of a mechanism's source with its evidence, in the order of the file; none without a file.

    Errors:
        MechanismFileError: a file has faults, or an erratum names evidence that is not there.
    """
    path = reference_folder(record) / ERRATA
    return tuple(_erratum(record, name, entry, path) for name, entry in _entries(path).items())


def erratum(record: MechanismRecord, name: str) -> Erratum:
    """One erratum by its id, with its evidence.

    >>> from assur.model.registry import load_record
    >>> erratum(load_record("zeng2019"), "E10").evidence.holds
    True
    """
    path = reference_folder(record) / ERRATA
    entries = _entries(path)
    if name not in entries:
        raise UnknownNameError(f"erratum of {record.name}", name, entries)
    return _erratum(record, name, entries[name], path)


def _entries(path: Path) -> dict[str, ErratumEntry]:
    if not path.is_file():
        return {}
    source = read_toml(file_text(path), str(path))
    return checked(ErrataFile, source, path).root


def _erratum(record: MechanismRecord, name: str, entry: ErratumEntry, path: Path) -> Erratum:
    found = _function(record, name, entry.evidence, path)(record)
    if not isinstance(found, Evidence) or not isinstance(found.holds, bool):
        raise _fault(
            path,
            name,
            f"'{entry.evidence}' returns no Evidence whose `holds` is a bool",
            "a function that returns an Evidence",
        )
    return Erratum(
        id=name,
        where=entry.where,
        printed=entry.printed,
        finding=entry.finding,
        evidence_name=entry.evidence,
        evidence=found,
        not_computed=entry.not_computed,
        status=entry.status,
    )


def _function(record: MechanismRecord, name: str, evidence: str, path: Path) -> Callable[[MechanismRecord], object]:
    """The function that an erratum names, from a file of the evidence folder."""
    stem, _, function = evidence.partition(".")
    file = path.parent / EVIDENCE / f"{stem}.py"
    found = (
        getattr(_module(file, f"assur_evidence_of_{record.name}_{stem}"), function, None) if file.is_file() else None
    )
    if not callable(found):
        raise _fault(path, name, f"no function '{evidence}'", f"file.function of the folder '{EVIDENCE}'")
    return cast("Callable[[MechanismRecord], object]", found)


def _module(file: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise _fault(file, "", "no Python file", "a Python file")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _fault(path: Path, name: str, found: str, allowed: str) -> MechanismFileError:
    place = f"{name}.evidence" if name else ""
    return MechanismFileError([Problem(str(path), None, place, found, f"allowed: {allowed}")])
