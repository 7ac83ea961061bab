"""Shards joined: the blocks of a whole grid, taken from the stores of its parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from assur.errors import UsageError
from assur.results.store.inspection import Fault, damaged, faults_of, path_of, read_rows, runs
from assur.results.store.layout import Plan, Shard, known_array
from assur.results.store.note import DamagedNoteError, Done, asked, blocks_done, differences, digest, unsealed
from assur.results.store.store import STATE, SolvedBlock
from assur.work import Progress

REPAIR = "the command of that shard with --repair computes again what is damaged"


@dataclass(frozen=True)
class StoredShard:
    """The store of a shard.

    Attributes:
        folder: where it is.
        plan: what it is of.
        done: its blocks.
    """

    folder: Path
    plan: Plan
    done: Mapping[int, Done]

    @property
    def shard(self) -> Shard:
        """Which one it is."""
        return self.plan.shard or Shard(1, 1)

    def solved(self, number: int) -> SolvedBlock:
        """A block, as it was written.

        Errors:
            DamagedStoreError: it is not what was written.
        """
        done, within, arrays = self.done[number], self.plan.within(number), {}
        for array, checksum in zip(self.plan.files, done.digests, strict=True):
            path = path_of(self.folder, array)
            rows = b"".join(read_rows(path, array, within))
            if digest([rows]) != checksum:
                said = "its numbers are not those that were written", "they would have the checksum of the note"
                raise damaged([Fault(path, *said, (number,))], REPAIR)
            arrays[array.name] = np.frombuffer(rows, dtype=array.dtype).reshape(array.height, -1)
        return SolvedBlock(arrays, done.counts)


def parts_in(folders: Sequence[Path], progress: Progress | None = None) -> tuple[StoredShard, ...]:
    """The shards in folders, in their order; of one grid, all of them, complete, and undamaged.

    Errors:
        UsageError: a folder without a shard, shards of several grids, one that is missing, twice there, or not done.
        DamagedStoreError: a file is not what was written.
    """
    parts = sorted((_part(folder) for folder in folders), key=lambda part: part.shard.index)
    if not parts:
        raise UsageError("no shards to merge", hint="give their folders")
    first = parts[0]
    for part in parts[1:]:
        _same_grid(first, part)
    numbers = [part.shard.index for part in parts]
    missing = sorted({*range(1, first.shard.of + 1)} - {*numbers})
    if missing:
        raise UsageError(f"shard {runs(missing)} of {first.shard.of} is not among the folders", hint="give them all")
    for part, following in pairwise(parts):
        if part.shard == following.shard:
            raise UsageError(f"{part.folder} and {following.folder} are the same shard", hint="give each once")
    for part in parts:
        if len(part.done) < len(part.plan.blocks):
            raise UsageError(
                f"{part.folder}: {len(part.done)} of {len(part.plan.blocks)} blocks are done",
                hint="its command goes on where it stopped",
            )
    total, checked = sum(len(part.done) for part in parts), 0
    faults: list[Fault] = []
    for part in parts:
        faults += faults_of(part.folder, part.plan, part.done)
        checked += len(part.done)
        if progress is not None:
            progress(checked, total)
    if faults:
        raise damaged(faults, REPAIR)
    return tuple(parts)


def _same_grid(first: StoredShard, part: StoredShard) -> None:
    other = differences(asked(first.plan.whole), asked(part.plan.whole))
    if part.shard.of != first.shard.of:
        other.append("the number of shards")
    if other:
        raise UsageError(
            f"{part.folder}: a shard of another question than {first.folder}; it differs in {', '.join(other)}",
            hint="merge shards of commands that differ in --shard and in the folder alone",
        )


def _part(folder: Path) -> StoredShard:
    path = folder / STATE
    if not path.exists():
        raise UsageError(f"{folder}: no shard is there", hint="give the folders that were written with --shard")
    try:
        kept = unsealed(path)
        plan = _plan(kept)
        done = blocks_done(plan, kept)
    except DamagedNoteError as error:
        raise damaged([Fault(path, str(error), "a note of the store is due")], REPAIR) from error
    if plan.shard is None:
        raise UsageError(f"{folder}: a whole grid, no shard of one", hint="there is nothing to merge with it")
    return StoredShard(folder, plan, done)


def _plan(kept: Mapping[str, object]) -> Plan:
    """The plan that a note is of."""
    try:
        arrays = tuple(known_array(name, one) for name, one in kept["arrays"].items())  # type: ignore[attr-defined]
        shard = kept["shard"] and Shard.read("/".join(map(str, kept["shard"])))  # type: ignore[call-overload]
        return Plan(dict(kept["question"]), arrays, int(kept["block"]), shard or None, kept["about"])  # type: ignore[call-overload,arg-type]
    except (AttributeError, KeyError, TypeError, ValueError, UsageError) as error:
        raise DamagedNoteError(f"is no note of a store ({error})") from error
