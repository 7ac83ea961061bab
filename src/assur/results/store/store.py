"""A store at work: begun or gone on with, filled block by block, finished; and repaired.

The order of what is written makes it whole at every instant. The note comes before any array; an array has the name
of a part, and no header, until every block of it is on the disk; a block is in the note after its numbers are on the
disk; what tells people of the arrays comes last.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.results.disk import DISK, PART, Disk
from assur.results.store.inspection import Fault, damaged, faults_of, part_of, path_of
from assur.results.store.layout import Plan
from assur.results.store.lock import locked
from assur.results.store.note import (
    Counts,
    DamagedNoteError,
    Done,
    added,
    asked,
    blocks_done,
    differences,
    digest,
    note_bytes,
    unsealed,
)
from assur.work import Progress

STATE = "state.json"
ABOUT = "sweep.json"
SAVED = 2.0
"""Seconds between two notes of what is done, at least; a note takes a small share of the time."""
SHARE = 20.0
"""How many times longer than the last note took it is until the next."""

Tell = Callable[[Plan, Counts], bytes]
"""What people are told of a store that is done, from what was counted."""


@dataclass(frozen=True)
class SolvedBlock:
    """The numbers of a block.

    Attributes:
        arrays: name -> its numbers (..., b).
        counts: what was counted in them.
    """

    arrays: Mapping[str, NDArray[Any]]
    counts: Counts


class Store:
    """A folder with the arrays of a plan; a context in which no other process works on it.

    Args:
        folder: where, made where it is missing.
        plan: what is to be in it.
        tell: what people are told once it is done; nothing where None.
        disk: the operations that change files.

    Example: an array of five numbers in blocks of two.

        >>> import tempfile
        >>> from assur.results.store.layout import Array
        >>> plan = Plan({"kind": "squares"}, (Array("square", "float64", (), (5,)),), 2)
        >>> with tempfile.TemporaryDirectory() as folder, Store(Path(folder), plan) as store:
        ...     faults = store.open()
        ...     for number in store.missing:
        ...         part = plan.part(number)
        ...         store.put(number, SolvedBlock({"square": np.arange(part.start, part.stop) ** 2.0}, {}))
        ...     store.save()
        ...     store.finish()["square"].tolist()
        [0.0, 1.0, 4.0, 9.0, 16.0]
    """

    def __init__(self, folder: Path, plan: Plan, tell: Tell | None = None, disk: Disk = DISK) -> None:
        self.folder, self.plan, self.tell, self.disk = folder, plan, tell, disk
        self.done: dict[int, Done] = {}
        self._lines: dict[int, str] = {}
        self._fresh: dict[int, Done] = {}
        self._stack = ExitStack()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._stack.close()

    @property
    def missing(self) -> list[int]:
        """Blocks that are not done."""
        return [number for number in self.plan.blocks if number not in self.done and number not in self._fresh]

    @property
    def places_done(self) -> int:
        """Places whose numbers are on the disk, and are noted."""
        return sum(self.plan.part(number).stop - self.plan.part(number).start for number in self.done)

    @property
    def counts(self) -> dict[str, dict[str, int]]:
        """What was counted in all blocks that are done."""
        return added(block.counts for block in self.done.values())

    def open(self, *, repair: bool = False, progress: Progress | None = None) -> tuple[Fault, ...]:
        """Begin the store, or go on with what is there, every byte of which is checked.

        Args:
            repair: let what is damaged be computed again.
            progress: called with the blocks that were checked, and those to check.

        Returns:
            The faults that are repaired.

        Errors:
            UsageError: the folder holds another question, or files that are no store; the disk is too small; another
                process works on it.
            DamagedStoreError: a file is not what was written.
        """
        if not (self.folder / STATE).exists():
            self._claim(repair=repair)
            self._make_folders()
        self._stack.enter_context(locked(self.folder))
        new = not (self.folder / STATE).exists()
        faults = self._read(progress) if not new else [self._lost] if self._taken else []
        if faults and not repair:
            raise damaged(faults)
        if new or faults:
            self._note()
        files = [path_of(self.folder, array) for array in self.plan.files]
        if self.missing or any(fault.path.name != ABOUT for fault in faults) or not all(map(Path.is_file, files)):
            self._reopen()
        elif faults:
            self.disk.remove(self.folder / ABOUT)
        return tuple(faults)

    def put(self, number: int, solved: SolvedBlock) -> None:
        """Write the numbers of a block."""
        digests = []
        for array in self.plan.files:
            rows = np.ascontiguousarray(solved.arrays[array.name], dtype=array.dtype).reshape(array.height, -1)
            spans = array.spans(self.plan.within(number))
            pieces = [(place, row.data) for (place, _), row in zip(spans, rows, strict=True)]
            self.disk.write(part_of(self.folder / f"{array.name}.npy"), pieces)
            digests.append(digest([rows.data]))
        self._fresh[number] = Done(tuple(digests), solved.counts)

    def save(self) -> None:
        """Bring what was put to the disk, then note it. What could not be brought there is not done."""
        fresh, self._fresh = self._fresh, {}
        if not fresh:
            return
        before = dict(self.done)
        try:
            for array in self.plan.files:
                self.disk.sync(part_of(self.folder / f"{array.name}.npy"))
            self.done |= fresh
            self._note()
        except BaseException as error:
            self.done = before
            if not isinstance(error, OSError):  # Ctrl-C: nothing failed, and it may be brought there yet
                self._fresh = fresh
            raise

    def fill(self, blocks: Iterable[tuple[int, SolvedBlock]], progress: Progress | None = None) -> None:
        """Put blocks, noting them now and then, and at the end however it comes."""
        done = self.places_done
        due = time.monotonic() + SAVED
        try:
            for number, solved in blocks:
                self.put(number, solved)
                done += self.plan.part(number).stop - self.plan.part(number).start
                if time.monotonic() > due:
                    begun = time.monotonic()
                    self.save()
                    due = time.monotonic() + max(SAVED, SHARE * (time.monotonic() - begun))
                if progress is not None:
                    progress(done, self.plan.length)
        finally:
            try:
                self.save()
            except KeyboardInterrupt:
                self.save()
                raise

    def finish(self) -> dict[str, NDArray[Any]]:
        """Give the arrays their names, once every block is done, and tell people of them.

        Returns:
            The arrays by name, as read-only memory maps.
        """
        for array in self.plan.files:
            path = self.folder / f"{array.name}.npy"
            part = part_of(path)
            if path.exists():
                self.disk.remove(part)
                continue
            self.disk.write(part, [(0, array.header)])
            self.disk.sync(part)
            self.disk.rename(part, path)
        self.disk.sync_folder(self.folder)
        if self.tell is not None and not (self.folder / ABOUT).exists():
            self.disk.write_whole(self.folder / ABOUT, self.tell(self.plan, self.counts))
        return {array.name: _mapped(self.folder / f"{array.name}.npy", array.size) for array in self.plan.files}

    def _claim(self, *, repair: bool) -> None:
        """Make sure that a folder without a note may be written into."""
        taken = self._taken
        if taken and not all(map(self._ours, taken)):
            raise UsageError(
                f"{', '.join(map(str, taken))}: already there, without a note of what it is",
                hint="choose another folder",
            )
        if taken and not repair:
            raise damaged([self._lost])
        needed, free = self.plan.bytes, shutil.disk_usage(_nearest(self.folder)).free
        if needed > free:
            raise UsageError(
                f"{self.folder}: the answer takes {needed / 1e9:.1f} GB and {free / 1e9:.1f} GB are free",
                hint="keep less of it, or take fewer places",
            )

    @property
    def _lost(self) -> Fault:
        names = ", ".join(path.name for path in self._taken)
        return Fault(self.folder / STATE, "is missing", f"it would say what {names} is of")

    @property
    def _taken(self) -> list[Path]:
        return [path for path in self._paths() if path.exists()]

    def _paths(self) -> Iterator[Path]:
        """Where files of the store may be, beside its note."""
        for array in self.plan.files:
            yield self.folder / f"{array.name}.npy"
            yield part_of(self.folder / f"{array.name}.npy")
        if self.tell is not None:
            yield self.folder / ABOUT

    def _ours(self, path: Path) -> bool:
        """Whether a file without a note is one that this store would have."""
        if not path.is_file():
            return False
        if path.name.endswith(PART):
            return True
        array = next((array for array in self.plan.files if path.name == f"{array.name}.npy"), None)
        if array is None:
            return any(path.exists() for path in self._paths() if path.name != ABOUT)
        with path.open("rb") as file:
            return path.stat().st_size == array.file_size and file.read(len(array.header)) == array.header

    def _make_folders(self) -> None:
        missing = [place for place in (self.folder, *self.folder.absolute().parents) if not place.exists()]
        for folder in reversed(missing):
            self.disk.make_folder(folder)
            self.disk.sync_folder(folder.parent)

    def _read(self, progress: Progress | None) -> list[Fault]:
        """Take over what the note says, less what is damaged; the faults."""
        path = self.folder / STATE
        try:
            kept = unsealed(path)
            other = differences(asked(self.plan), kept)
            if other:
                raise UsageError(
                    f"{path}: belongs to another question; it differs in {', '.join(other)}",
                    hint="choose another folder, or remove what is there",
                )
            self.done = blocks_done(self.plan, kept)
            self.plan = replace(self.plan, about=kept["about"])  # what was said of it at first is said at the end
        except (DamagedNoteError, KeyError) as error:
            return [Fault(path, str(error), "a note of the store is due", tuple(self.plan.blocks))]
        faults = faults_of(self.folder, self.plan, self.done, progress)
        for number in {number for fault in faults for number in fault.blocks}:
            del self.done[number]
        about = self.folder / ABOUT
        if self.tell is not None and not self.missing and about.exists():
            said = about.read_bytes() if about.is_file() else b""
            if said != self.tell(self.plan, self.counts):
                faults.append(Fault(about, "is not what was written", "it would say what the arrays hold"))
        return faults

    def _note(self) -> None:
        """Write the note."""
        self._lines = {number: self._lines.get(number) or block.line for number, block in self.done.items()}
        self.disk.write_whole(self.folder / STATE, note_bytes(self.plan, self._lines))

    def _reopen(self) -> None:
        """Parts that can be written into, and nothing that looks finished."""
        if self.tell is not None:
            self.disk.remove(self.folder / ABOUT)
        for array in self.plan.files:
            path = self.folder / f"{array.name}.npy"
            part = part_of(path)
            for place in (path, part):  # a pipe would be waited for, and through a link another file be written
                if place.is_symlink() or (place.exists() and not place.is_file() and not place.is_dir()):
                    self.disk.remove(place)
            if path.is_file():
                self.disk.rename(path, part)
            if not part.is_file():
                self.disk.make_file(part, array.file_size)
            elif part.stat().st_size != array.file_size:
                self.disk.resize(part, array.file_size)
        self.disk.sync_folder(self.folder)


def _nearest(folder: Path) -> Path:
    """The nearest folder that is there."""
    return next(place for place in (folder, *folder.absolute().parents) if place.is_dir())


def _mapped(path: Path, size: int) -> NDArray[Any]:
    """An array in a file, which is mapped unless there is nothing in it."""
    array: NDArray[Any] = np.load(path, mmap_mode="r" if size else None)
    return array
