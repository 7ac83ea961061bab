"""Whether the files of a store are what its note says of them: file by file, block by block."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from assur.errors import DamagedStoreError, Problem
from assur.results.disk import PART
from assur.results.store.layout import Array, Plan
from assur.results.store.note import Done, digest
from assur.work import Progress

REPAIR = "the same command with --repair computes again what is damaged, and nothing else"


@dataclass(frozen=True)
class Fault:
    """A file that is not what it was.

    Attributes:
        path: the file.
        what: what is wrong with it.
        allowed: what it would be otherwise.
        blocks: of which blocks nothing can be read.
    """

    path: Path
    what: str
    allowed: str
    blocks: tuple[int, ...] = ()

    @property
    def problem(self) -> Problem:
        """As people are told of it."""
        where = f"block{'s' * (len(self.blocks) > 1)} {runs(self.blocks)}" if self.blocks else ""
        return Problem(str(self.path), None, where, self.what, self.allowed)


def damaged(faults: Iterable[Fault], hint: str = REPAIR) -> DamagedStoreError:
    """The error of a store with faults."""
    return DamagedStoreError([fault.problem for fault in faults], hint=hint)


def runs(numbers: Iterable[int]) -> str:
    """Numbers in few words.

    >>> runs([0, 3, 4, 5, 9])
    '0, 3-5, 9'
    """
    ordered = sorted(numbers)
    starts = [ordered[0], *(b for a, b in pairwise(ordered) if b != a + 1)]
    ends = [*(a for a, b in pairwise(ordered) if b != a + 1), ordered[-1]]
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in zip(starts, ends, strict=True))


def path_of(folder: Path, array: Array) -> Path:
    """Where an array is: under its name, or, as long as it is not whole, under that of a part."""
    path = folder / f"{array.name}.npy"
    return path if path.exists() else part_of(path)


def part_of(path: Path) -> Path:
    """The name of a file that is not whole."""
    return path.with_name(path.name + PART)


def faults_of(folder: Path, plan: Plan, done: Mapping[int, Done], progress: Progress | None = None) -> list[Fault]:
    """Every fault of the arrays of a store of which some blocks are done."""
    faults: list[Fault] = []
    bad: dict[Path, list[int]] = {}
    for array in plan.files if done else ():
        path = path_of(folder, array)
        faults += _of_file(path, array, tuple(done))
    missing = {fault.path for fault in faults if fault.blocks}
    present = [(k, path) for k, array in enumerate(plan.files) if (path := path_of(folder, array)) not in missing]
    for count, (number, block) in enumerate(done.items(), start=1):
        for k, path in present:
            if _digest_of(path, plan.files[k], plan.within(number)) != block.digests[k]:
                bad.setdefault(path, []).append(number)
        if progress is not None:
            progress(count, len(done))
    said = "its numbers are not those that were written", "they would have the checksum of the note"
    return faults + [Fault(path, *said, tuple(blocks)) for path, blocks in bad.items()]


def read_rows(path: Path, array: Array, part: slice) -> Iterator[bytes]:
    """The bytes of each row of some places; fewer where the file ends before."""
    with path.open("rb") as file:
        for place, size in array.spans(part):
            file.seek(place)
            yield file.read(size)


def _digest_of(path: Path, array: Array, part: slice) -> str:
    """Of some places of a file; empty where it cannot be read."""
    try:
        return digest(read_rows(path, array, part))
    except OSError:
        return ""


def _of_file(path: Path, array: Array, done: tuple[int, ...]) -> Iterator[Fault]:
    """What can be said of a file without reading its numbers."""
    if path.is_symlink() or not path.is_file():
        what = "is a link" if path.is_symlink() else "is no file" if path.exists() else "is missing"
        yield Fault(path.with_name(f"{array.name}.npy"), what, f"a file of {array.file_size} bytes is due", done)
        return
    size = path.stat().st_size
    if size != array.file_size:
        yield Fault(path, f"has {size} bytes", f"{array.file_size} are due")
    if path.name.endswith(PART):
        return  # the header comes last
    with path.open("rb") as file:
        if file.read(len(array.header)) != array.header:
            yield Fault(path, "its header is not what was written", f"an array {array.shape} of {array.dtype} is due")
