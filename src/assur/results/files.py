"""Writing files whole: to a temporary neighbour first, then in the place of what was there before."""

from __future__ import annotations

from pathlib import Path

from assur.errors import OutputError
from assur.storage import replace_file
from assur.work import written


def file_to_write(path: str | Path) -> Path:
    """The path of a file that can be written as far as its place says, asked before what takes long.

    Errors:
        OutputError: it is a folder, a pipe or a device, or its folder does not exist.
    """
    target = Path(path)
    if target.is_dir():
        raise OutputError(f"cannot write {target}: it is a folder", hint="give the name of a file")
    if target.exists() and not target.is_file():
        raise OutputError(f"cannot write {target}: it is a pipe or a device", hint="give the name of a file")
    if not target.parent.is_dir():
        raise OutputError(
            f"cannot write {target}: the folder {target.parent} does not exist",
            hint=f"mkdir -p {target.parent}",
        )
    return target


def write_whole(path: str | Path, content: str | bytes) -> Path:
    """Write a file so that it is there whole or, with an `OutputError`, what was there before still is."""
    target = file_to_write(path)
    try:
        replace_file(target, content.encode() if isinstance(content, str) else content)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror}", hint="choose another place") from error
    written(str(target))
    return target
