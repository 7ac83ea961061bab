"""Where output goes, looked at before the work begins, so that no long run ends in a path that cannot be written."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

from assur.errors import OutputError


def output_file(text: str, endings: Sequence[str]) -> Path:
    """The path of a file that can be written, with one of the endings; nothing is changed."""
    path = Path(text)
    if path.is_dir():
        raise OutputError(
            f"cannot write {path}: it is a folder", hint=f"give a file that ends in {' or '.join(endings)}"
        )
    if path.suffix.lower() not in endings:
        raise OutputError(f"cannot write {path}: its ending is none of {', '.join(endings)}", hint="rename it")
    _try(path.parent, path)
    return path


def output_folder(text: str) -> Path:
    """A folder that can be written into, made where it is missing."""
    path = Path(text)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {path}: {error.strerror}", hint="choose another place") from error
    _try(path, path)
    return path


def _try(folder: Path, path: Path) -> None:
    try:
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        missing = not folder.is_dir()
        reason = f"the folder {folder} does not exist" if missing else error.strerror
        hint = f"mkdir -p {folder}" if missing else "choose another place with -o"
        raise OutputError(f"cannot write {path}: {reason}", hint=hint) from error
