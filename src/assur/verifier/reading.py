"""Reading a certificate: one JSON object of exactly the keys that the format has, every number an exact hex float."""

from __future__ import annotations

import hashlib
import json
import math
from typing import Any

FORMAT, VERSION = "assur certificate", 1
LARGEST = 10**9
KEYS = {
    "": {"format", "version", "kind", "made_by", "statement", "program", "claims", "proof", "sha256"},
    "statement": {"mechanism", "files", "parameters", "mode", "strokes", "held", "coordinates", "box"},
    "program": {"operations", "margins", "nonzero", "factors"},
}
PATH = KEYS["statement"] - {"box"} | {"from", "to", "points", "boxes"}
"""Keys of a statement about a path."""


class RefusedError(Exception):
    """The certificate proves nothing: what it says does not hold."""


class MalformedError(RefusedError):
    """It is no whole certificate."""


def read(data: bytes) -> dict[str, Any]:
    """The certificate as plain data, if it is whole and as it was written."""
    if len(data) > LARGEST:
        raise MalformedError(f"{len(data)} bytes; a certificate has at most {LARGEST}")
    try:
        document = json.loads(
            data.decode("utf-8"), object_pairs_hook=_object, parse_float=number, parse_constant=number
        )
    except (ValueError, RecursionError) as error:
        raise MalformedError(f"not JSON, or cut short: {error}") from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise MalformedError(f"no certificate: its format is not {FORMAT!r}")
    if document.get("version") != VERSION:
        raise MalformedError(f"version {document.get('version')!r} of the format; this verifier knows {VERSION}")
    for part, usual in KEYS.items():
        keys = PATH if part == "statement" and document["kind"] == "path" else usual
        found = document[part] if part else document
        if not isinstance(found, dict) or set(found) != keys:
            raise MalformedError(f"{part or 'the certificate'} does not have the keys {', '.join(sorted(keys))}")
    rest = {key: value for key, value in document.items() if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    if hashlib.sha256(text.encode()).hexdigest() != document["sha256"]:
        raise MalformedError("edited or damaged: its checksum is not that of its content")
    return document


def number(text: str) -> float:
    """A finite float from its one hex spelling, such as 0x1.8000000000000p+1."""
    value = float.fromhex(text)
    if not math.isfinite(value) or value.hex() != text:
        raise ValueError(f"{text[:40]!r} is no finite float in its hex spelling")
    return value


def names(value: list[str]) -> list[str]:
    """A list of different texts."""
    if type(value) is not list or len(set(value)) != len(value) or any(type(item) is not str for item in value):
        raise ValueError(f"{str(value)[:40]!r} is no list of different names")
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key twice in one object")
    return found
