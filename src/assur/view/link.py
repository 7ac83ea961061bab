"""A link: dimensions, joint values and viewpoint as the query of an address, and back; every number to its last bit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from urllib.parse import parse_qs, urlencode, urlsplit

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.view.snapshot import Snapshot, start, with_values

FloatArray = NDArray[np.float64]
LONGEST = 6000
"""Characters of a query: what a browser sends in one line, and more than any mechanism needs."""

FIELDS = frozenset({"mechanism", "set", "at", "camera"})
"""What a link can hold."""

HINT = "copy the line 'link' of the view, or the address of the page with it"


@dataclass(frozen=True)
class Viewpoint:
    """Where the reader stands, what is looked at, in the mechanism's unit, and what is upwards."""

    position: tuple[float, float, float]
    look_at: tuple[float, float, float]
    up: tuple[float, float, float] = (0.0, 0.0, 1.0)

    def times(self, scale: float) -> Viewpoint:
        """The same in another unit of length."""
        position, look_at = (
            (scale * part[0], scale * part[1], scale * part[2]) for part in (self.position, self.look_at)
        )
        return Viewpoint(position, look_at, self.up)


def query(snapshot: Snapshot, viewpoint: Viewpoint | None = None) -> str:
    """The query that restores a snapshot; the joint values say its mode, its inputs and its pose.

    >>> from assur.model.registry import load_record
    >>> query(start(load_record("fivebar", l1=110.0)), Viewpoint((1.0, 2.0, 3.0), (0.0, 0.0, 0.0)))[:35]
    'mechanism=fivebar&set=l1%3A110.0&at'
    """
    fields = [("mechanism", snapshot.record.name)]
    fields += [("set", f"{name}:{value!r}") for name, value in snapshot.record.overrides.items()]
    fields.append(("at", _numbers(snapshot.values)))
    if viewpoint is not None:
        fields.append(("camera", _numbers(np.array([*viewpoint.position, *viewpoint.look_at, *viewpoint.up]))))
    return urlencode(fields, safe=",")


def restored(record: MechanismRecord, text: str) -> tuple[Snapshot, Viewpoint | None]:
    """The snapshot and the viewpoint of a query or of a whole link, for the mechanism with the dimensions of its file.

    Errors: UsageError where it is no link of this mechanism, or its joint values are no assembly.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> before = start(load_record("fivebar", l1=110.0))
    >>> after, viewpoint = restored(record, query(before))
    >>> bool(np.max(np.abs(after.values - before.values)) < 1e-12), dict(after.record.overrides), viewpoint
    (True, {'l1': 110.0}, None)
    """
    if len(text) > LONGEST:
        raise UsageError(f"a link of {len(text)} characters; at most {LONGEST} are read")
    fields = parse_qs(urlsplit(text).query if "?" in text else text)
    if text and not FIELDS & set(fields):
        raise UsageError(f"this is no link of a view: '{text[:40]}'", hint=HINT)
    names = fields.get("mechanism", [record.name])
    if names != [record.name]:
        raise UsageError(f"this is a link of {', '.join(names)}, not of {record.name}", hint=f"assur view {names[0]}")
    changed = {}
    for parameter in fields.get("set", []):
        name, _, value = parameter.partition(":")
        changed[name] = float(_read(value, 1)[0])
    changed_record = with_parameters(record, **changed) if changed else record
    snapshot = start(changed_record)
    if "at" in fields:
        snapshot = with_values(snapshot, _read(fields["at"][-1], len(snapshot.values)))
    if "camera" not in fields:
        return snapshot, None
    parts = _read(fields["camera"][-1], 9).tolist()
    return snapshot, Viewpoint(*(tuple(parts[k : k + 3]) for k in (0, 3, 6)))


def _numbers(values: FloatArray) -> str:
    return ",".join(repr(float(value)) for value in values)


def _read(text: str, count: int) -> FloatArray:
    parts = text.split(",")
    try:
        numbers = [float(part) for part in parts]
    except ValueError:
        raise UsageError(f"a link with '{text[:40]}' where numbers are wanted") from None
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise UsageError(f"a link with {len(numbers)} numbers where {count} finite ones are wanted")
    return np.array(numbers)
