"""Errata of a source: each stands with evidence that is computed anew whenever it is asked for.

`reference/errata.toml` has a table for every erratum. Its `evidence`, as "direct.false_root", names a function
of `reference/evidence/direct.py`, which takes the record and returns an `Evidence`. Evidence is Python: that of a
mechanism which is not built in runs with leave only (`assur.model.consent`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import cast

from pydantic import RootModel

from assur.audit.reference import ERRATA, checked, reference_folder
from assur.audit.rows import Erratum, Evidence
from assur.errors import MechanismFileError, Problem
from assur.model.consent import may_run
from assur.model.file.schema import Entry
from assur.model.file.toml_source import read_toml
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text

EVIDENCE = "evidence"
NOT_RUN = Evidence(None, "not run: it is Python that came with the mechanism's file")


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
    return tuple(erratum(record, name) for name in _entries(reference_folder(record) / ERRATA))


def erratum(record: MechanismRecord, name: str) -> Erratum:
    """One of them, by its id."""
    path = reference_folder(record) / ERRATA
    return _erratum(record, name, _entries(path)[name], path)


def _entries(path: Path) -> dict[str, ErratumEntry]:
    if not path.is_file():
        return {}
    source = read_toml(file_text(path), str(path))
    return checked(ErrataFile, source, path).root


def _erratum(record: MechanismRecord, name: str, entry: ErratumEntry, path: Path) -> Erratum:
    function = _function(record, name, entry.evidence, path)
    result = NOT_RUN if function is None else function(record)
    if not isinstance(result, Evidence) or (function and not isinstance(result.holds, bool)):
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
        evidence=result,
        not_computed=entry.not_computed,
        status=entry.status,
    )


def _function(
    record: MechanismRecord, name: str, evidence: str, path: Path
) -> Callable[[MechanismRecord], object] | None:
    """The function that an erratum names, from a file of the evidence folder; None where it may not run."""
    stem, _, function = evidence.partition(".")
    file = path.parent / EVIDENCE / f"{stem}.py"
    allowed = f"file.function of the folder '{EVIDENCE}'"
    if not stem.isidentifier() or not function.isidentifier() or not file.is_file():
        raise _fault(path, name, f"no function '{evidence}'", allowed)
    text = file_text(file)
    if not may_run(file, text.encode(), "evidence is Python", "nothing is said of the erratum"):
        return None
    member = vars(_module(file, text, f"assur_evidence_of_{record.name}_{stem}")).get(function)
    if not callable(member):
        raise _fault(path, name, f"no function '{evidence}'", allowed)
    return cast("Callable[[MechanismRecord], object]", member)


@lru_cache(maxsize=16)
def _module(file: Path, text: str, name: str) -> ModuleType:
    """The same for all errata of a file, so that it may keep what several of its functions compute."""
    module = ModuleType(name)
    module.__file__ = str(file)
    exec(compile(text, str(file), "exec"), vars(module))  # built in, or with leave
    return module


def _fault(path: Path, name: str, offending: str, allowed: str) -> MechanismFileError:
    place = f"{name}.evidence" if name else ""
    return MechanismFileError([Problem(str(path), None, place, offending, f"allowed: {allowed}")])
