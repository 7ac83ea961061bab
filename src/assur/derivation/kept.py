"""What was derived, kept in the user's cache: closed forms as text, or why there is none, and what is printed.

The name of an entry is a digest of the mechanism's file, of the dimensions, of assur's version, of the code of this
folder, of that which names modes, of that which checks and of that which prints. What is kept has passed: a derived
form agrees with its joint graph before anyone sees it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from assur.cache import code_digest, keep, own_content
from assur.derivation.derivation import derive
from assur.derivation.not_derived import NotDerivedError
from assur.errors import FileError
from assur.kinematics.closing_blocks.kept import CODE
from assur.kinematics.contract import check
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.modes import Problem
from assur.model.kernels.reading import names_of
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM
from assur.version import VERSION

KIND = "derivations"
LARGEST = 1_000_000
"""Bytes of an entry; a larger one is none of ours."""


def derived_closed_form(record: MechanismRecord) -> str:
    """The file `closed_form.py` of a mechanism, derived once for each file; it agrees with the joint graph.

    Errors:
        NotDerivedError: what resists, or what the joint graph says against it.

    >>> from assur.model.registry import load_record
    >>> derived_closed_form(load_record("fivebar")).splitlines()[0]
    '\"\"\"Closed form of fivebar, derived from its joint graph: rod1 and rod2.\"\"\"'
    """
    text, why = _kept(record, "closed form", lambda: _that_agrees(record))
    if why:
        raise NotDerivedError(why)
    return text


def derived_document(record: MechanismRecord, why: Mapping[Problem, str], write: Callable[[], str]) -> str:
    """The LaTeX document of some problems of a mechanism, with why each is not derived, "" where it is; written once.

    >>> from assur.model.registry import load_record
    >>> derived_document(load_record("fivebar"), {}, lambda: "none")
    'none'
    """
    return derived_text(record, f"document {dict(why)}", write)


def derived_text(record: MechanismRecord, what: str, write: Callable[[], str], printers: Sequence[Path] = ()) -> str:
    """A text of what was derived, written once for each file.

    Args:
        record: the mechanism.
        what: its kind, one word or several.
        write: makes it.
        printers: files of code outside this folder on which it depends.

    >>> from assur.model.registry import load_record
    >>> derived_text(load_record("fivebar"), "poem", lambda: "none")
    'none'
    """
    return _kept(record, f"{what} {code_digest(*printers)}", write)[0]


def _kept(record: MechanismRecord, what: str, make: Callable[[], str]) -> tuple[str, str]:
    """A text that is kept, or is made and kept; or why there is none."""
    name = _name(record, what)
    digest, _, body = (own_content(KIND, name, LARGEST) or b"").partition(b"\n")
    if body and digest.decode("ascii", "replace") == hashlib.sha256(body).hexdigest():
        with suppress(ValueError, TypeError, KeyError, RecursionError):
            entry = json.loads(body)
            return str(entry["text"]), str(entry["why"])
    text = why = ""
    try:
        text = make()
    except NotDerivedError as error:
        why = str(error)
    body = json.dumps({"text": text, "why": why}).encode()
    with suppress(OSError):
        keep(KIND, name, hashlib.sha256(body).hexdigest().encode() + b"\n" + body)
    return text, why


def _that_agrees(record: MechanismRecord) -> str:
    derivation = derive(record)
    for solution in (derivation.direct, derivation.inverse):
        solution.held_against_loops()
    plain = record.without_closed_form
    try:
        text = derivation.closed_form()
        form = names_of(text, Path(CLOSED_FORM))["CLOSED_FORM"]
    except FileError as error:
        own = error.problems[0]
        raise NotDerivedError(
            f"its formulas would have {own.given}, {own.allowed}: axes by fewer digits, or by parameters, make "
            "them shorter"
        ) from error
    against, _ = problems(plain.with_closed_form(form, text), IN_FULL)
    if against:
        raise NotDerivedError(f"the joint graph does not agree with what was derived: {against[0].given}")
    return text


def _name(record: MechanismRecord, what: str) -> str:
    text = record.description.text if record.description else ""
    own = {name: float(value).hex() for name, value in sorted(record.overrides.items())}
    code = code_digest(Path(__file__).parent, Path(check.__file__).parent, *CODE)
    parts = (VERSION, code, json.dumps(own), record.name, text, what)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest() + ".json"
