"""Errata of a source: each stands with evidence that is computed anew whenever it is asked for.

`reference/errata.toml` has a table for every erratum; `evidence` names a function of `reference/evidence.py`,
which takes the record and returns an `Evidence`. It is loaded by path, as `closed_form.py` is.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

from pydantic import RootModel

from assur.audit.reference import ERRATA, checked, reference_folder
from assur.audit.rows import Erratum, Evidence
from assur.errors import MechanismFileError, Problem
from assur.model.mechanism import MechanismRecord
from assur.model.schema import Entry
from assur.model.toml_source import read_toml

EVIDENCE = "evidence.py"


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
    if not path.is_file():
        return ()
    source = read_toml(path.read_text(encoding="utf-8"), str(path))
    entries = checked(ErrataFile, source, path).root
    module = _load(path.parent / EVIDENCE, f"assur_evidence_of_{record.name}")
    return tuple(_erratum(record, name, entry, module, path) for name, entry in entries.items())


def _erratum(record: MechanismRecord, name: str, entry: ErratumEntry, module: ModuleType, path: Path) -> Erratum:
    function: Callable[[MechanismRecord], Any] | None = getattr(module, entry.evidence, None)
    if function is None:
        raise MechanismFileError(
            [Problem(str(path), None, f"{name}.evidence", f"no function '{entry.evidence}'", f"one of {EVIDENCE}")]
        )
    found = function(record)
    if not isinstance(found, Evidence):
        raise MechanismFileError(
            [Problem(str(path), None, f"{name}.evidence", f"{entry.evidence} returns no Evidence", "an Evidence")]
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


def _load(path: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path) if path.is_file() else None
    if spec is None or spec.loader is None:
        raise MechanismFileError(
            [Problem(str(path), None, "", "no such file", f"the functions that {ERRATA} names")]
        )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
