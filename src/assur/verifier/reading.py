"""Reading a certificate: one JSON object of exactly the keys and types of the format, numbers as exact hex floats."""

from __future__ import annotations

import hashlib
import json
import math
import re
from typing import Any

FORMAT, VERSION = "assur certificate", 3
LARGEST = 10**9
KEYS = {
    "": {"format", "version", "kind", "made_by", "statement", "program", "exact", "claims", "proof", "sha256"},
    "statement": {"mechanism", "files", "parameters", "mode", "strokes", "held", "coordinates", "box"},
    "program": {"operations", "margins", "nonzero", "factors", "joints", "jp", "jq"},
    "exact": {"says", "parallel", "serial"},
}
EXACT = "the formulas close the joint graph: exact, error < 1e-15"
OF_THESE = f"with these dimensions {EXACT}"
AT_PLACES = "the formulas were held at places only, not in exact arithmetic"
SAYINGS = (EXACT, OF_THESE, AT_PLACES)
PATH = KEYS["statement"] - {"box"} | {"from", "to", "points", "boxes"}
"""Keys of a statement about a path."""

CLOSED_FORM = "closed_form.py"


class RefusedError(Exception):
    """The certificate proves nothing: what it says does not hold."""


class MalformedError(RefusedError):
    """It is no whole certificate."""


def require(fine: Any, refusal: str) -> None:
    """Errors: RefusedError, where it is not fine."""
    if not fine:
        raise RefusedError(refusal)


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
    try:
        return _whole(document)
    except (TypeError, ValueError, RecursionError) as error:
        raise MalformedError(f"not in this format: {error}") from error


def _whole(document: Any) -> dict[str, Any]:
    """What was read, if it has the keys, the types and the checksum of a certificate."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise MalformedError(f"no certificate: its format is not {FORMAT!r}")
    if [type(document.get("version")), document.get("version")] != [int, VERSION]:
        raise MalformedError(f"version {document.get('version')!r} of the format; this verifier knows {VERSION}")
    for part, usual in KEYS.items():
        keys = PATH if part == "statement" and document["kind"] == "path" else usual
        keyed = document[part] if part else document
        if not isinstance(keyed, dict) or set(keyed) != keys:
            raise MalformedError(f"{part or 'the certificate'} does not have the keys {', '.join(sorted(keys))}")
    rest = {key: value for key, value in document.items() if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    if hashlib.sha256(text.encode()).hexdigest() != document["sha256"]:
        raise MalformedError("edited or damaged: its checksum is not that of its content")
    printable(document["made_by"])
    _statement(document["statement"])
    _exact(document["exact"])
    return document


def _exact(exact: dict[str, Any]) -> None:
    """Check what says how surely the formulas are those of the joint graph; the verifier finds that out by itself."""
    if printable(exact["says"]) not in SAYINGS:
        raise ValueError(f"{exact['says'][:80]!r} is nothing that is said of formulas")
    for key in ("parallel", "serial"):
        names(exact[key])


def _statement(statement: dict[str, Any]) -> None:
    """Check what says of which mechanism it is; the proof does not use it, so nothing else would."""
    for value in (statement["mechanism"], statement["mode"]):
        printable(value)
    files, parameters, held, strokes = (_table(statement[name]) for name in ("files", "parameters", "held", "strokes"))
    for value in (*parameters.values(), *held.values()):
        number(value)
    for pair in strokes.values():
        if pair is not None and not (type(pair) is list and len(pair) == 2):
            raise ValueError(f"{str(pair)[:40]!r} is no stroke")
        numbers([end for end in pair or () if end not in ("-inf", "inf")])
    if len(files) != 2 or CLOSED_FORM not in files:
        raise ValueError(f"the files of a mechanism are its own and {CLOSED_FORM}, not {str(list(files))[:80]}")
    if not all(re.fullmatch("[0-9a-f]{64}", printable(digest)) for digest in files.values()):
        raise ValueError("a file with what is no SHA-256")


def number(text: str) -> float:
    """A finite float from its one hex spelling, such as 0x1.8000000000000p+1."""
    try:
        value = float.fromhex(text)
    except (TypeError, ValueError, OverflowError):
        value = math.inf
    if not math.isfinite(value) or value.hex() != text:
        raise ValueError(f"{str(text)[:40]!r} is no finite float in its hex spelling")
    return value


def numbers(value: list[str]) -> list[float]:
    """A list of such floats."""
    if type(value) is not list:
        raise ValueError(f"{str(value)[:40]!r} is no list of numbers")
    return [number(text) for text in value]


def printable(value: str) -> str:
    """A text that moves no cursor and clears no screen."""
    if type(value) is not str or not value.isprintable():
        raise ValueError(f"{str(value)[:40]!r} is no printable text")
    return value


def names(value: list[str]) -> list[str]:
    """A list of different printable texts."""
    if type(value) is not list or len({printable(name) for name in value}) != len(value):
        raise ValueError(f"{str(value)[:40]!r} is no list of different names")
    return value


def _table(value: dict[str, Any]) -> dict[str, Any]:
    """An object with printable names."""
    if type(value) is not dict:
        raise ValueError(f"{str(value)[:40]!r} is no object")
    names(list(value))
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) != len(pairs):
        raise ValueError("a key twice in one object")
    return members
