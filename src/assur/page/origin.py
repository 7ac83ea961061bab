"""What a file is a copy of, and what differs: a page of other dimensions must not pass for one of the original."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from assur.audit.audit import reference_of
from assur.audit.reference import ERRATA, FOLDER
from assur.errors import UsageError
from assur.model.file.reader import read_mechanism
from assur.model.mechanism import MechanismRecord
from assur.model.registry import FILE, names

SAME = 1e-12
"""Relative: two values that differ by less are one dimension."""


@dataclass(frozen=True)
class Original:
    """What a mechanism is compared with.

    Attributes:
        name: as a page says it: a name of the catalogue, or "its file" where only dimensions were changed on the way.
        values: name -> value of each parameter of the original, in the units of its file.
    """

    name: str
    values: dict[str, float]

    def other(self, name: str, value: float) -> float | None:
        """The original's value of a parameter where it is another one; None where it is the same, or not there."""
        there = self.values.get(name, value)
        return None if abs(there - value) <= SAME * max(abs(there), abs(value)) else there


def original(record: MechanismRecord) -> Original | None:
    """What a mechanism is a copy of: that of the catalogue with its title and source, or its own file.

    None for one of the catalogue as it stands there, and for a file of a user's own.

    >>> from assur.model.registry import load_record
    >>> changed = load_record("zeng2019", l2=300)
    >>> found = original(changed)
    >>> found.name, found.other("l2", 300.0), found.other("l3", 140.0)
    ('its file', 280.0, None)
    >>> original(load_record("zeng2019")) is None
    True
    """
    model = _model(record)
    if model is not None and not model.file.samefile(record.file):
        return Original(model.name, _values(model))
    return Original("its file", _values(read_mechanism(record.file))) if record.overrides else None


def left_out(record: MechanismRecord) -> str:
    """Why the errata of the source are not those of this mechanism; empty where they are, or where none are known.

    Errors: MechanismFileError where the reference data have faults.

    >>> from assur.model.registry import load_record
    >>> left_out(load_record("zeng2019", l2=300))
    'those of the source are left out: l2 = 300, and the reference data of zeng2019 are for l2 = 280'
    >>> left_out(load_record("zeng2019"))
    ''
    """
    if has_errata(record):
        try:
            reference_of(record)
        except UsageError as error:
            return f"those of the source are left out: {error.message}"
        return ""
    model = _model(record)
    if model is None or not has_errata(model):
        return ""
    return f"not looked for in this file; those of its source are for {model.name}"


def has_errata(record: MechanismRecord) -> bool:
    """Whether errata of its source stand beside a mechanism's file."""
    return record.folder is not None and (record.folder / FOLDER / ERRATA).is_file()


def _model(record: MechanismRecord) -> MechanismRecord | None:
    """The mechanism of the catalogue, without its closed form, that has the title and the source of this one."""
    if not record.title or not record.source:
        return None
    folder = Path(str(files("assur"))) / "mechanisms"
    for path in (folder / name / FILE for name in names()):
        said = tomllib.loads(path.read_text(encoding="utf-8"))
        if (said.get("title"), said.get("source")) == (record.title, record.source):
            return read_mechanism(path)
    return None


def _values(record: MechanismRecord) -> dict[str, float]:
    return {name: item.value for name, item in record.parameters.items()}
