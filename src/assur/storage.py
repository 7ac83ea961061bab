"""Files that are whole or as they were before: written beside, on the disk, then renamed; what killed writes left goes.

Whoever writes holds a lock on the file beside. The system lets go of it when the process ends, however it does, so what
is ours and not locked is what a killed write left.
"""

from __future__ import annotations

import contextlib
import os
import re
import secrets
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import IO

try:
    import fcntl
except ImportError:  # no locks: nothing is swept
    locks: ModuleType | None = None
else:
    locks = fcntl

ENDING = ".assur"
_LONGEST = 100
"""Characters of a name that are repeated beside it: names have 255 bytes at most."""


def replace_file(path: Path, data: bytes, *, lasting: bool = True) -> None:
    """Put data in the place of a file, or raise an `OSError` and leave what was there before.

    What is not `lasting` is not waited for until it is on the disk: after a failure of power it may be there in part.
    """
    with beside(path, lasting=lasting) as stream:
        stream.write(data)


@contextlib.contextmanager
def beside(path: Path, *, lasting: bool = True) -> Iterator[IO[bytes]]:
    """A file beside another one, which it replaces at the end of the block, once it is on the disk if it is to last.

    Where the block raises, what was there before is unchanged.
    """
    sweep(path)
    stream, temporary = _created(path)
    try:
        with stream:
            yield stream
            stream.flush()
            if lasting:
                os.fsync(stream.fileno())
            temporary.chmod(0o644)
            temporary.replace(path)
        if lasting:
            sync_folder(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def sweep(path: Path) -> None:
    """Remove what killed writes of a file left beside it."""
    if locks is None:
        return
    ours = re.compile(re.escape(_beginning(path)) + f"[0-9a-f]{{16}}{re.escape(ENDING)}")
    with contextlib.suppress(OSError), os.scandir(path.parent) as entries:
        for name in [entry.name for entry in entries if ours.fullmatch(entry.name)]:
            _remove_unlocked(path.parent / name)


def sync_folder(folder: Path) -> None:
    """Put the names of a folder on the disk, where the system can do that."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _created(path: Path) -> tuple[IO[bytes], Path]:
    """A new file beside another one, locked."""
    while True:
        temporary = path.with_name(f"{_beginning(path)}{secrets.token_hex(8)}{ENDING}")
        stream = temporary.open("xb")
        if locks is not None:
            with contextlib.suppress(OSError):  # a file system without locks
                locks.flock(stream, locks.LOCK_EX)
        if temporary.exists():
            return stream, temporary
        stream.close()  # another process swept it before it was locked


def _beginning(path: Path) -> str:
    return f".{path.name[:_LONGEST]}."


def _remove_unlocked(path: Path) -> None:
    if locks is None or path.is_symlink() or not path.is_file():
        return
    with contextlib.suppress(OSError), path.open("rb") as stream:
        locks.flock(stream, locks.LOCK_EX | locks.LOCK_NB)  # an error where somebody writes
        path.unlink(missing_ok=True)
