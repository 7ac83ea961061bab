"""Writing files whole: to a temporary neighbour first, then in the place of what was there before."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from assur.errors import OutputError


def write_whole(path: str | Path, content: str | bytes) -> Path:
    """Write a file so that it is there whole or, with an `OutputError`, what was there before still is."""
    target = Path(path)
    if target.is_dir():
        raise OutputError(f"cannot write {target}: it is a folder", hint="give the name of a file")
    if not target.parent.is_dir():
        raise OutputError(
            f"cannot write {target}: the folder {target.parent} does not exist",
            hint=f"mkdir -p {target.parent}",
        )
    data = content.encode() if isinstance(content, str) else content
    try:
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror}", hint="choose another place") from error
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        temporary.chmod(0o644)
        temporary.replace(target)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror}", hint="choose another place") from error
    finally:
        temporary.unlink(missing_ok=True)
    return target
