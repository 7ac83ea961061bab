"""What was read of mechanisms' files, kept in the user's cache: plain data, by the text of a file and by what read it.

An entry holds every part of a record but what its file's place and text say again: numbers as JSON has them, which
reads back the same floats, arrays with their shape, classes of the record by name. Its first line is a digest of the
rest; what is damaged, was written by another version of the reader, or could be written by others, is read anew.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from assur.cache import keep, own_content
from assur.joints.catalogue import JOINT_TYPES
from assur.joints.joint_type import JointType
from assur.model import formula, machine_data, mechanism, syntax, written
from assur.model.file.description import Description
from assur.model.mechanism import MechanismRecord
from assur.version import VERSION

KIND = "readings"
LARGEST = 10_000_000
"""Bytes of an entry; a larger one is none of ours."""
READERS = ("joints", "model", "model/file", "numerics")
"""Folders of the code that reads: where one of its files changes, what was read before counts no more."""
ELSEWHERE = ("file", "folder", "description", "closed_form", "closed_form_text", "closed_form_not_run", "overrides")
"""Fields that a file's place and text say, or that are not of the file."""
_CLASSES: dict[str, type] = {
    f"{module.__name__.rpartition('.')[2]}.{name}": own
    for module in (mechanism, machine_data, formula, syntax, written)
    for name, own in vars(module).items()
    if isinstance(own, type) and is_dataclass(own) and own.__module__ == module.__name__
}


def kept_reading(text: str, path: Path) -> MechanismRecord | None:
    """The record of the text of a mechanism's file as it was kept, None where it was not.

    Example: what is kept is what was read.

    >>> from assur.model.file.reader import read_mechanism
    >>> read = read_mechanism(Path(mechanism.__file__).parents[1] / "mechanisms/fivebar/mechanism.toml")
    >>> keep_reading(read)
    >>> kept = kept_reading(read.description.text, read.file)
    >>> kept.home.tolist() == read.home.tolist(), kept.file == read.file
    (True, True)
    """
    content = own_content(KIND, _name(text), LARGEST)
    digest, _, body = (content or b"").partition(b"\n")
    if not body or digest.decode("ascii", "replace") != hashlib.sha256(body).hexdigest():
        return None
    try:
        parts = {name: _value(part) for name, part in json.loads(body).items()}
        return MechanismRecord(file=path, folder=path.parent, description=Description(path, text), **parts)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None


def keep_reading(record: MechanismRecord) -> None:
    """Keep what was read of a file; a cache that cannot be written is no fault."""
    if record.description is None:
        return
    own = {item.name: getattr(record, item.name) for item in fields(MechanismRecord) if item.name not in ELSEWHERE}
    body = json.dumps({name: _data(value) for name, value in own.items()}).encode()
    with suppress(OSError):
        content = hashlib.sha256(body).hexdigest().encode() + b"\n" + body
        keep(KIND, _name(record.description.text), content)


def _name(text: str) -> str:
    parts = (VERSION, _readers(), text)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest() + ".json"


@lru_cache(maxsize=1)
def _readers() -> str:
    """Names, sizes and times of the files that read."""
    home = Path(__file__).parents[1]
    entries = (entry for folder in READERS for entry in os.scandir(home / folder) if entry.name.endswith(".py"))
    return repr(sorted((entry.path, entry.stat().st_size, entry.stat().st_mtime_ns) for entry in entries))


def _data(value: Any) -> Any:
    """As JSON has it: tuples as lists, all else with its kind."""
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, tuple):
        return [_data(part) for part in value]
    if isinstance(value, np.ndarray) and value.dtype == np.float64:
        return {"array": [list(value.shape), value.ravel().tolist()]}
    if isinstance(value, frozenset):
        return {"names": sorted(value)}
    if isinstance(value, Mapping):
        return {"table": {name: _data(part) for name, part in value.items()}}
    if isinstance(value, JointType):
        return {"joint type": value.name}
    kind = f"{type(value).__module__.rpartition('.')[2]}.{type(value).__qualname__}"
    return {kind: [_data(getattr(value, item.name)) for item in fields(_CLASSES[kind])]}


def _value(data: Any) -> Any:
    """What `_data` was given."""
    if isinstance(data, list):
        return tuple([_value(part) for part in data])
    if not isinstance(data, dict):
        return data
    ((kind, body),) = data.items()
    if kind in _READ:
        return _READ[kind](body)
    return _CLASSES[kind](*[_value(part) for part in body])


_READ: dict[str, Callable[[Any], Any]] = {
    "array": lambda body: np.array(body[1], dtype=float).reshape(body[0]),
    "names": frozenset,
    "table": lambda body: {name: _value(part) for name, part in body.items()},
    "joint type": JOINT_TYPES.__getitem__,
}
