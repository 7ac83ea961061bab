"""Whether a certificate is that of a mechanism as it is now: its formulas recorded anew and compared, entry by entry.

The small verifier proves what follows from the formulas in the certificate; this step says whose formulas they are.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import zip_longest
from pathlib import Path
from typing import Any

from assur.certificates.certificate import file_hashes
from assur.certificates.formulas import CONSTANT, GROUPS, formulas
from assur.errors import UsageError
from assur.kinematics.contract.admission import check_closed_form
from assur.kinematics.contract.extent import IN_FULL
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.registry import load_record, names


def at_hand(document: Mapping[str, Any], name_or_path: str | Path | None = None) -> MechanismRecord | None:
    """The mechanism of a certificate as its file has it: built in, or in a file that is named; None if neither.

    Errors:
        UnknownNameError: no mechanism has the name that is given.
        MechanismFileError: its closed form does not agree with its joint graph.
    """
    recorded_name = document["statement"]["mechanism"]
    if (
        name_or_path is None and recorded_name not in names()
    ):  # a path in a certificate must not make anyone run what is there
        return None
    record = load_record(recorded_name if name_or_path is None else name_or_path)
    check_closed_form(record, IN_FULL)
    return record


def with_dimensions(document: Mapping[str, Any], record: MechanismRecord) -> MechanismRecord:
    """The mechanism with the dimensions of a certificate; another mechanism, which `differences` tells, as it is.

    Errors:
        UsageError: it has none of such a name, or may not have such a value, so the certificate is not its own.
    """
    if document["statement"]["mechanism"] != record.name:
        return record
    changed = {name: float.fromhex(value) for name, value in document["statement"]["parameters"].items()}
    if changed:
        record = with_parameters(record, **changed)
        check_closed_form(record, IN_FULL)
    return record


def differences(document: Mapping[str, Any], record: MechanismRecord) -> tuple[str, ...]:
    """What of a certificate is not this mechanism's; nothing where it is all its own.

    Args:
        document: a certificate that the verifier read.
        record: the mechanism with the certificate's dimensions, from `at_hand` and `with_dimensions`.

    >>> from assur.certificates.certificate import certificate
    >>> record, other = load_record("zeng2019"), load_record("zeng2019", l2=300)
    >>> document = certificate(record, most=1).to_json()
    >>> differences(document, record), differences(document, other)
    ((), ('parameters: none there, l2 = 300.0 here', 'formulas: number l2 is 280.0 there, 300.0 here'))
    """
    statement = document["statement"]
    if statement["mechanism"] != record.name:
        return (f"mechanism: {statement['mechanism']} there, {record.name} here",)
    reasons = []
    recorded = {name: float.fromhex(value) for name, value in statement["parameters"].items()}
    if recorded != dict(record.overrides):
        reasons.append(f"parameters: {_listed(recorded)} there, {_listed(record.overrides)} here")
    present = file_hashes(record)
    if statement["files"] != present:
        changed = sorted(
            name for name in {*present, *statement["files"]} if present.get(name) != statement["files"].get(name)
        )
        reasons.append(f"files: {', '.join(changed)} not as they were")
    return (*reasons, *_formulas(document, record))


def _listed(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in values.items()) or "none"


def _formulas(document: Mapping[str, Any], record: MechanismRecord) -> tuple[str, ...]:
    """The first difference of the formulas, if there is one."""
    statement, recorded = document["statement"], document["program"]
    held = {name: float.fromhex(value) for name, value in statement["held"].items()}
    strokes = {name: None if pair is None else _pair(pair) for name, pair in statement["strokes"].items()}
    try:
        rules = formulas(record, statement["mode"], strokes, held)
    except UsageError as error:
        return (f"statement: {error.message}",)
    if list(rules.slice.free) != statement["coordinates"]:
        return (f"coordinates: {', '.join(statement['coordinates'])} there, {', '.join(rules.slice.free)} here",)
    present = rules.to_json()
    for k, (old, new) in enumerate(zip_longest(recorded["operations"], present["operations"])):
        if not _same(old, new):
            return (f"formulas: {_shown(k, old, new)}",)
    groups = [group for group in GROUPS if recorded[group] != present[group]]
    return tuple(f"formulas: other {group}" for group in groups)


def _pair(texts: list[str]) -> tuple[float, float]:
    return float.fromhex(texts[0]), float.fromhex(texts[1])


def _same(old: list[Any] | None, new: list[Any] | None) -> bool:
    """Equal; bounds of a constant need only enclose those recorded now, less their slack."""
    if old == new:
        return True
    if old is None or new is None or old[0] != "number" or new[0] != "number" or old[3] != new[3]:
        return False
    if not old[3].startswith(f"{CONSTANT} "):
        return False
    (low, high), (least, most) = _pair(old[1:3]), _pair(new[1:3])
    slack = (most - least) / 4
    return low <= least + slack and most - slack <= high


def _shown(place: int, old: list[Any] | None, new: list[Any] | None) -> str:
    if old is None or new is None:
        return f"operations end at {place} {'there' if old is None else 'here'}"
    if old[0] == new[0] == "number" and old[3] == new[3]:
        return f"number {old[3] or place} is {float.fromhex(old[1])} there, {float.fromhex(new[1])} here"
    return f"operation {place} is {' '.join(map(str, old))} there, {' '.join(map(str, new))} here"
