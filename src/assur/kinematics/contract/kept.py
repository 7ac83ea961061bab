"""That a closed form has passed, kept in the user's cache: plain data, by what was checked and by what.

The name of an entry is a digest of the folder's files, of the dimensions, of assur's version and of the code of this
folder. An entry counts only where it says, word for word, what would be written there; anything else is computed again.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, get_args

from assur.cache import keep, own_content
from assur.kinematics.contract.extent import Extent
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM
from assur.version import VERSION

FOLDER = "closed_forms"
ENDINGS = (".py", ".toml")
"""What of a folder an answer may depend on."""
LARGEST = 10_000
"""Bytes of an entry; a larger one is none of ours."""
Scope = Literal["any", "own"]
SCOPES: tuple[Scope, ...] = get_args(Scope)
"""Whether an entry is about the dimensions of a record alone, or about any."""


def has_passed(record: MechanismRecord, extent: Extent, scope: Scope) -> bool:
    """Whether the cache says that this closed form passed a check of that extent."""
    entry = _entry(record, extent, scope)
    content = own_content(FOLDER, _name(entry), LARGEST)
    try:
        return content is not None and bool(json.loads(content) == entry)
    except (ValueError, RecursionError):
        return False


def keep_passed(record: MechanismRecord, extent: Extent, scope: Scope) -> None:
    """Note it; a cache that cannot be written is no fault."""
    entry = _entry(record, extent, scope)
    with suppress(OSError):
        keep(FOLDER, _name(entry), (json.dumps(entry, indent=1, sort_keys=True) + "\n").encode())


def _entry(record: MechanismRecord, extent: Extent, scope: Scope) -> dict[str, Any]:
    own = {name: float(value).hex() for name, value in sorted(record.overrides.items())}
    return {
        "mechanism": record.name,
        "extent": dataclasses.asdict(extent),
        "passed": True,
        "assur": VERSION,
        "laws": _laws(),
        "dimensions": "any" if scope == "any" else own,
        "files": {**dict(_digests(record.file)), **_of_record(record)},
    }


def _name(entry: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(entry, sort_keys=True).encode()).hexdigest() + ".json"


def _digests(file: Path) -> Iterator[tuple[str, str]]:
    """Name and digest of the mechanism's file and of all beside it that can be read with it."""
    beside = [path for path in file.parent.iterdir() if path.suffix in ENDINGS]
    for path in sorted({*beside, file}):
        if path.is_file():
            yield path.name, hashlib.sha256(path.read_bytes()).hexdigest()


def _of_record(record: MechanismRecord) -> dict[str, str]:
    """What the record was made of as it was read then: what stands in these files by now was not checked."""
    description = record.description
    texts = {record.file.name: description.text if description else "", CLOSED_FORM: record.closed_form_text}
    return {name: hashlib.sha256(text.encode()).hexdigest() for name, text in texts.items()}


@lru_cache(maxsize=1)
def _laws() -> str:
    """A digest of the code that checks: another law, another answer."""
    texts = (path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))
    return hashlib.sha256(b"\0".join(texts)).hexdigest()
