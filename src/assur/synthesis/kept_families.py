"""Families that were found, kept in the user's cache one by one, so that a search that was ended goes on.

A question has a database of its own, named by a digest of the question and of the code that answers it. What is in it
is plain data, limbs by their texts; what another version found, others could have written or a failure of power
damaged is not read. A search goes on without it where it cannot be kept.
"""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from assur.cache import code_digest, own_place, trim
from assur.model.topology_description import Mode
from assur.results.answers.solution_order import AssurChain, Loop
from assur.synthesis.assembly import MechanismFamily
from assur.synthesis.designs import Design, DeterminingSet
from assur.synthesis.isomorphism import Key
from assur.synthesis.plans import ClassSet
from assur.synthesis.question import SynthesisQuestion
from assur.synthesis.tally import Tally
from assur.topology.counting.coupling import Decomposition
from assur.topology.counting.decoupling import Decoupling
from assur.topology.facts import Known
from assur.topology.notation import parse_chains
from assur.version import VERSION

KIND = "searches"
HOME = Path(__file__).parents[1]
CODE = tuple(HOME / name for name in ("synthesis", "topology", "joints", "numerics", "mechanisms"))
"""Folders of what decides what is found."""

PATIENCE = 5.0
"""Seconds to wait for another process that writes to the same database."""


@dataclass(frozen=True)
class KeptDesign:
    """A mechanism as plain data: texts and driven joints of its limbs, in their classes, and texts as they stand."""

    limbs: tuple[tuple[str, tuple[int, ...]], ...]
    places: tuple[int, ...]
    chains: tuple[str, ...]
    known: Known
    loops: tuple[Loop, ...]
    assur_chains: tuple[AssurChain, ...]
    decoupling: Decoupling | None
    determining: tuple[DeterminingSet, ...]
    dof: int
    mode: Mode
    row: str


@dataclass(frozen=True)
class KeptFamily:
    """A family as plain data."""

    designs: tuple[KeptDesign, ...]
    tally: Tally


_FAMILY = TypeAdapter(KeptFamily)


@contextmanager
def kept_families(asked: SynthesisQuestion, also: Sequence[Key] = ()) -> Iterator[KeptFamilies]:
    """What earlier runs found for a question, and a place for what this one finds.

    Args:
        asked: the question.
        also: further mechanisms that are listed.
    """
    parts = (VERSION, code_digest(*CODE), repr(asked), repr(also))
    path = own_place(KIND, hashlib.sha256("\0".join(parts).encode()).hexdigest() + ".sqlite")
    database = _opened(path) if path is not None else None
    try:
        yield KeptFamilies(database)
    finally:
        if path is not None and database is not None:
            database.close()
            trim(path.stem)


def _opened(path: Path) -> sqlite3.Connection | None:
    """The database, made anew where it is damaged; none where that cannot be."""
    for _ in range(2):
        try:
            database = sqlite3.connect(path, timeout=PATIENCE, isolation_level=None)
            database.execute("PRAGMA synchronous = OFF")  # the system has what a killed process wrote
            database.execute("CREATE TABLE IF NOT EXISTS family (place TEXT PRIMARY KEY, content BLOB)")
        except sqlite3.DatabaseError:
            with suppress(OSError):
                path.unlink()
        else:
            return database
    return None


class KeptFamilies:
    """The families of one question by the place of their set in the search; `reread` counts those that were kept."""

    def __init__(self, database: sqlite3.Connection | None) -> None:
        self.database = database
        self.reread = 0

    def family(self, place: str, some: ClassSet) -> MechanismFamily:
        """The family of a set of classes, as it was kept, or made and kept."""
        content = self._content(place)
        if content is not None:
            with suppress(ValidationError, KeyError):
                family = _of(_FAMILY.validate_json(content), some)
                self.reread += 1
                return family
        family = some.family()
        if self.database is not None:
            with suppress(sqlite3.Error):
                row = (place, _FAMILY.dump_json(_kept(family)))
                self.database.execute("INSERT OR REPLACE INTO family VALUES (?, ?)", row)
        return family

    def _content(self, place: str) -> bytes | None:
        if self.database is None:
            return None
        try:
            row = self.database.execute("SELECT content FROM family WHERE place = ?", (place,)).fetchone()
        except sqlite3.Error:
            return None
        return row[0] if row else None


def _kept(family: MechanismFamily) -> KeptFamily:
    return KeptFamily(tuple(map(_kept_design, family.designs)), family.tally)


def _kept_design(design: Design) -> KeptDesign:
    return KeptDesign(
        tuple((limb.text, limb.type.driven) for limb in design.limbs),
        design.places,
        tuple(chain.text for chain in design.chains),
        design.known,
        design.loops.loops,
        design.loops.assur_chains,
        design.decoupling,
        design.determining,
        design.dof,
        design.mode,
        design.row,
    )


def _of(kept: KeptFamily, some: ClassSet) -> MechanismFamily:
    """The family again; a `KeyError` where its limbs are not in the classes."""
    by_text = {(limb.text, limb.type.driven): limb for members in some.chosen for limb in members}
    designs = (
        Design(
            tuple(by_text[limb] for limb in one.limbs),
            one.places,
            parse_chains(one.chains),
            one.known,
            Decomposition(one.loops, one.assur_chains),
            one.decoupling,
            one.dof,
            one.mode,
            row=one.row,
            determining=one.determining,
        )
        for one in kept.designs
    )
    return MechanismFamily(tuple(designs), kept.tally)
