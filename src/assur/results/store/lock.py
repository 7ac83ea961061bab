"""One process at a time works on a folder."""

from __future__ import annotations

import errno
import importlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from assur.errors import UsageError


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Nobody else has the folder while the block runs; the system frees it however the process ends.

    Nothing is written. Where the system or the file system has no such locks, anybody may have it.

    Errors:
        UsageError: another process has it.
    """
    if os.name == "nt":
        yield
        return
    fcntl = importlib.import_module("fcntl")  # which Windows lacks
    handle = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
                raise UsageError(f"{folder}: another process works on it", hint="wait for it to end") from error
        yield
    finally:
        os.close(handle)
