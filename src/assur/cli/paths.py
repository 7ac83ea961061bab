"""Where output goes, looked at before the work begins, so that no long run ends in a path that cannot be written."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path

from assur.errors import OutputError, cut


def output_file(text: str, endings: Sequence[str]) -> Path:
    """The path of a file that can be written, with one of the endings; nothing is changed."""
    path = _named(text)
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
    return made(planned_folder(text))


def planned_folder(text: str) -> Path:
    """A folder that can be written into, or be made; nothing is changed, so that what is refused leaves nothing."""
    path = _named(text)
    nearest = next(place for place in (path, *path.absolute().parents) if os.path.lexists(place))
    if not nearest.is_dir():
        raise OutputError(f"cannot make the folder {path}: {nearest} is no folder", hint="choose another place")
    _try(nearest, path)
    return path


def made(folder: Path) -> Path:
    """The folder, which is there from now on."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {folder}: {error.strerror}", hint="choose another place") from error
    return folder


def _named(text: str) -> Path:
    if not text.strip():
        raise OutputError("cannot write to an empty name", hint="name what is to be written")
    try:
        os.lstat(text)
    except (FileNotFoundError, NotADirectoryError):
        pass
    except OSError as error:  # a name that is too long, a folder that may not be entered
        raise OutputError(f"cannot write {cut(text)}: {error.strerror}", hint="choose another place") from error
    return Path(text)


def _try(folder: Path, path: Path) -> None:
    try:
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        missing = not folder.is_dir()
        reason = f"the folder {folder} does not exist" if missing else error.strerror
        hint = f"mkdir -p {folder}" if missing else "choose another place"
        raise OutputError(f"cannot write {path}: {reason}", hint=hint) from error
