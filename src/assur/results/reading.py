"""Reading files that somebody names: each is looked at before it is read, so that none blocks or has no end."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from assur.errors import MechanismFileError, Problem, UsageError, visible

MOST_TEXT = 4_000_000
"""Bytes of a text at most: far beyond any description of a mechanism."""
MOST_CERTIFICATE = 1_000_000_000
"""Bytes of a certificate at most: some ten million leaves."""

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def file_content(path: Path, most: int = MOST_TEXT, hint: str = "") -> bytes:
    """The bytes of a regular file.

    Args:
        path: the file.
        most: bytes at most.
        hint: what is said where there is no such file.

    Errors:
        UsageError: it cannot be read; it is a folder, a pipe, a socket or a device, which is then not waited for; or
            it is larger.

    >>> file_content(Path("/dev/zero"))
    Traceback (most recent call last):
    assur.errors.UsageError: cannot read '/dev/zero': it is a device, not a file
    """
    try:
        _refuse_special(path, path.stat())
        # another file may have taken the name since: neither is a pipe waited for, nor is its end
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
        with os.fdopen(handle, "rb") as stream:
            opened = os.fstat(stream.fileno())
            _refuse_special(path, opened)
            content = stream.read(most + 1) if opened.st_size <= most else b""
    except (OSError, ValueError) as error:
        reason = (error.strerror or str(error)) if isinstance(error, OSError) else str(error)
        raise UsageError(f"cannot read {_quoted(path)}: {reason}", hint=hint) from None
    if max(opened.st_size, len(content)) > most:
        raise UsageError(f"cannot read {_quoted(path)}: it is larger than {most} bytes", hint=hint)
    return content


def file_text(path: Path, most: int = MOST_TEXT, hint: str = "") -> str:
    """The text of a regular file in UTF-8.

    Errors:
        MechanismFileError: it is not UTF-8.
        UsageError: as `file_content`.
    """
    content = file_content(path, most, hint)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        at = f"byte 0x{content[error.start]:02x}"
        raise MechanismFileError([Problem(str(path), line, "", at, "allowed: UTF-8 text")]) from None


def _refuse_special(path: Path, status: os.stat_result) -> None:
    for is_kind, what in _KINDS:
        if is_kind(status.st_mode):
            raise UsageError(f"cannot read {_quoted(path)}: it is {what}, not a file")


def _quoted(path: Path) -> str:
    return f"'{visible(str(path))}'"
