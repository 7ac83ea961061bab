"""Writing files whole: to a temporary neighbour first, then in the place of what was there before."""

from __future__ import annotations

from pathlib import Path

from assur.errors import OutputError
from assur.storage import replace_file
from assur.work import written


def write_whole(path: str | Path, content: str | bytes) -> Path:
    """Write a file so that it is there whole or, with an `OutputError`, what was there before still is."""
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
    try:
        replace_file(target, content.encode() if isinstance(content, str) else content)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror}", hint="choose another place") from error
    written(str(target))
    return target
