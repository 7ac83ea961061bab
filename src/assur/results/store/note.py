"""The note of a store: what it is of, and which blocks are done, each with a digest of its numbers.

The last line of a note is a digest of all lines before it, so that a note is either as it was written or damaged.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from assur.results.store.layout import Plan

Counts = Mapping[str, Mapping[str, int]]
"""What was counted: heading -> name -> how many."""
SEAL = '"check": '


class DamagedNoteError(Exception):
    """A note that is not what was written; the text says in what way."""


@dataclass(frozen=True)
class Done:
    """A block that is done.

    Attributes:
        digests: of its numbers, array by array.
        counts: what was counted in it.
    """

    digests: tuple[str, ...]
    counts: Counts

    @property
    def line(self) -> str:
        """As a note has it."""
        return json.dumps([list(self.digests), self.counts], separators=(",", ":"))


def digest(pieces: Iterable[bytes | memoryview]) -> str:
    """Of bytes, one after the other.

    >>> digest([b"one", b"two"]) == digest([b"onetwo"])
    True
    """
    checksum = hashlib.blake2b(digest_size=16)
    for piece in pieces:
        checksum.update(piece)
    return checksum.hexdigest()


def added(counts: Iterable[Counts]) -> dict[str, dict[str, int]]:
    """All counts together.

    >>> added([{"modes": {"0": 1}}, {"modes": {"0": 2, "1": 3}}])
    {'modes': {'0': 3, '1': 3}}
    """
    total: dict[str, Counter[str]] = {}
    for part in counts:
        for heading, names in part.items():
            total.setdefault(heading, Counter()).update(names)
    return {heading: dict(sorted(names.items())) for heading, names in sorted(total.items())}


def sealed(entries: Mapping[str, str]) -> bytes:
    """A JSON object of entries, given as JSON texts, that ends with a digest of itself."""
    body = "{\n" + "".join(f"{json.dumps(name)}: {text},\n" for name, text in entries.items())
    return f"{body}{SEAL}{json.dumps(digest([body.encode()]))}\n}}\n".encode()


def unsealed(path: Path) -> dict[str, Any]:
    """What `sealed` wrote into a file.

    Errors:
        DamagedNoteError: no file, or any byte of it is another.
    """
    if not path.is_file():
        raise DamagedNoteError("is no file" if path.exists() else "is missing")
    raw = path.read_bytes()
    body, mark, seal = raw.rpartition(SEAL.encode())
    if not mark or seal != f"{json.dumps(digest([body]))}\n}}\n".encode():
        raise DamagedNoteError("is not what was written")
    try:
        read = json.loads(raw)
    except (ValueError, RecursionError) as error:
        raise DamagedNoteError(f"is not JSON ({error})") from error
    if not isinstance(read, dict) or not isinstance(read.get("question"), dict):
        raise DamagedNoteError("is no note of a question")
    return read


def note_bytes(plan: Plan, done: Mapping[int, str]) -> bytes:
    """The note of a store of which some blocks are done, each with its line.

    >>> from assur.results.store.layout import Array
    >>> plan = Plan({"kind": "squares"}, (Array("square", "float64", (), (5,)),), 2)
    >>> print(note_bytes(plan, {0: Done(("d5",), {}).line}).decode())  # doctest: +ELLIPSIS
    {
    "question": {"kind": "squares"},
    "about": null,
    "arrays": {"square": {"dtype": "float64", "rows": [], "places": [5]}},
    "block": 2,
    "shard": null,
    "done": 2,
    "blocks": {
    "0": [["d5"],{}]
    },
    "check": "..."
    }
    <BLANKLINE>
    """
    places = sum(plan.part(number).stop - plan.part(number).start for number in done)
    lines = ",\n".join(f'"{number}": {done[number]}' for number in sorted(done))
    entries = {name: json.dumps(value) for name, value in asked(plan).items()}
    return sealed({**entries, "done": str(places), "blocks": f"{{\n{lines}\n}}"})


def asked(plan: Plan) -> dict[str, Any]:
    """What a store is of, as its note has it."""
    arrays = {array.name: {"dtype": array.dtype, "rows": array.rows, "places": array.places} for array in plan.arrays}
    shard = None if plan.shard is None else [plan.shard.index, plan.shard.of]
    kept = {"question": plan.question, "about": plan.about, "arrays": arrays, "block": plan.block, "shard": shard}
    return dict(json.loads(json.dumps(kept)))


def differences(first: Mapping[str, Any], second: Mapping[str, Any]) -> list[str]:
    """In what two notes are of different things.

    >>> differences({"question": {"mode": "+"}, "block": 5}, {"question": {"mode": "-"}, "block": 5})
    ['mode']
    """
    outer = ("arrays", "block", "shard")
    asked_first, asked_second = (
        {**note["question"], **{name: note.get(name) for name in outer}} for note in (first, second)
    )
    return [name for name in {**asked_first, **asked_second} if asked_first.get(name) != asked_second.get(name)]


def blocks_done(plan: Plan, kept: Mapping[str, Any]) -> dict[int, Done]:
    """The blocks that a note says are done.

    Errors:
        DamagedNoteError: what it says of them is no such thing.
    """
    try:
        blocks = {
            int(number): Done(
                tuple(map(str, digests)),
                {heading: {name: int(n) for name, n in names.items()} for heading, names in counts.items()},
            )
            for number, (digests, counts) in kept["blocks"].items()
        }
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise DamagedNoteError(f"has blocks that are none ({error})") from error
    for number, block in blocks.items():
        if number not in plan.blocks or len(block.digests) != len(plan.arrays):
            raise DamagedNoteError(f"has a block {number} that is not of this grid")
    return blocks
