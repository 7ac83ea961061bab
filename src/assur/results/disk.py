"""File operations that change something: every one that a store makes, so that each can fail in a test.

What is written reaches the disk when it is synced, and a new name when its folder is synced. A file that must be whole
is written beside its place first and renamed.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable
from pathlib import Path

PART = ".part"
"""What the name of a file ends in as long as it is not whole."""

Pieces = Iterable[tuple[int, bytes | memoryview]]
"""Where to write in a file, in bytes, and what."""


class Disk:
    """The operations of the system. Any of them may raise `OSError`.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     DISK.write_whole(Path(folder) / "note", b"all of it")
    ...     [(path.name, path.read_bytes()) for path in Path(folder).iterdir()]
    [('note', b'all of it')]
    """

    def make_folder(self, folder: Path) -> None:
        """A new folder; the one above it is there, and this one may be."""
        folder.mkdir(exist_ok=True)

    def make_file(self, path: Path, size: int) -> None:
        """A file of so many zero bytes, in place of what was there."""
        with path.open("wb") as file:
            file.truncate(size)

    def resize(self, path: Path, size: int) -> None:
        """A file that is there of so many bytes, zeros where it was shorter."""
        os.truncate(path, size)

    def write(self, path: Path, pieces: Pieces) -> None:
        """Pieces into a file that is there."""
        with path.open("r+b", buffering=0) as file:
            for place, piece in pieces:
                file.seek(place)
                left = memoryview(piece).cast("B") if len(piece) else memoryview(b"")  # nothing has no cast
                while left:
                    left = left[file.write(left) :]

    def sync(self, path: Path) -> None:
        """What was written into a file is on the disk from now on."""
        with path.open("r+b", buffering=0) as file:
            os.fsync(file.fileno())

    def sync_folder(self, folder: Path) -> None:
        """The names in a folder are on the disk from now on, where the system can say so of folders."""
        if os.name == "nt":
            return
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        except OSError as error:
            if error.errno != errno.EINVAL:  # file systems without this notion
                raise
        finally:
            os.close(handle)

    def rename(self, old: Path, new: Path) -> None:
        """Another name in the same folder, in place of what had it."""
        old.replace(new)

    def remove(self, path: Path) -> None:
        """Remove a file, if it is there."""
        path.unlink(missing_ok=True)

    def write_whole(self, path: Path, data: bytes) -> None:
        """A file that is there whole, on the disk, or is what it was before."""
        fresh = path.with_name(path.name + PART)
        self.make_file(fresh, 0)
        self.write(fresh, [(0, data)])
        self.sync(fresh)
        self.rename(fresh, path)
        self.sync_folder(path.parent)


DISK = Disk()
