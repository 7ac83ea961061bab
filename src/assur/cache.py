"""What is kept for the next start: in one folder of the user, of limited size, the oldest of it goes first.

Everything there can be made anew, so it may be removed at any time.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from assur.errors import UsageError
from assur.storage import replace_file

KINDS = {
    "loops": "formulas as machine code",
    "closed_forms": "closed forms that have passed",
    "readings": "mechanisms' files as they were read",
    "programs": "programs of joint graphs",
    "modes": "names of modes",
    "derivations": "closed forms that were derived",
    "searches": "families that a synthesis found",
    "consent": "Python of mechanisms that may run",
}
"""Folder of what is kept -> what that is. Nothing else in the cache's folder is ever touched."""

LIMIT = 512
"""Megabytes that are kept at most, unless ASSUR_CACHE_LIMIT says another number."""
MEGABYTE = 1_000_000
UNTRIMMED = 1 / 50
"""Share of the limit that one process may keep before it looks again at all that is kept, which takes a while."""
_since_trimmed: dict[Path, int] = {}
"""Folder -> bytes that this process has kept there since it looked."""
WRITABLE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


@dataclass(frozen=True)
class Kept:
    """Something that is kept: one file, or a few of one name.

    Attributes:
        kind: its folder, one of `KINDS`.
        name: what its files' names begin with.
        files: all of them.
        size: their bytes.
        used: when it was last written or used, in seconds since 1970.
    """

    kind: str
    name: str
    files: tuple[Path, ...]
    size: int
    used: float


def cache_folder() -> Path:
    """Where it is kept: ASSUR_CACHE, or the user's cache folder."""
    chosen = os.environ.get("ASSUR_CACHE")
    if chosen:
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "assur"


def limit() -> int:
    """Bytes that are kept at most.

    Errors:
        UsageError: ASSUR_CACHE_LIMIT is no number of megabytes.
    """
    text = os.environ.get("ASSUR_CACHE_LIMIT", str(LIMIT))
    if not (text.isascii() and text.isdigit()):
        raise UsageError(f"ASSUR_CACHE_LIMIT: '{text}' is no whole number of megabytes", hint=f"for example {LIMIT}")
    return int(text) * MEGABYTE


def keep(kind: str, name: str, data: bytes) -> Path:
    """Keep a file, and let the oldest go where all together are larger than the limit.

    Args:
        kind: one of `KINDS`.
        name: of the file.
        data: what stands in it.

    Errors:
        OSError: it cannot be written.
    """
    path = cache_folder() / kind / name
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, data, lasting=False)  # who reads it knows by what it says whether it is whole
    folder, most = cache_folder(), limit()
    _since_trimmed[folder] = _since_trimmed.get(folder, most) + len(data)
    if _since_trimmed[folder] >= UNTRIMMED * most:
        trim(_stem(path))
        _since_trimmed[folder] = 0
    return path


def own_content(kind: str, name: str, largest: int) -> bytes | None:
    """What a kept file says; None where there is none, it is larger, or others than its user could have written it."""
    path = cache_folder() / kind / name
    try:
        if not _is_own(path) or path.lstat().st_size > largest:
            return None
        content = path.read_bytes()
    except OSError:
        return None
    mark_used(path)
    return content


def own_place(kind: str, name: str) -> Path | None:
    """Where a file is kept that is written bit by bit; None where it cannot be, or others could have written it.

    Where there is none, it is made, empty.
    """
    path = cache_folder() / kind / name
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch(0o644)
        return path if _is_own(path) else None
    except OSError:
        return None


def _is_own(path: Path) -> bool:
    """Whether it is a plain file that none but its user could have written."""
    status = path.lstat()
    own = not hasattr(os, "getuid") or status.st_uid == os.getuid()
    return own and stat.S_ISREG(status.st_mode) and not status.st_mode & WRITABLE_BY_OTHERS


@cache
def code_digest(*places: Path) -> str:
    """A digest of files, and of the Python and TOML in folders; what depends on them is made anew where it changes."""
    files = (sorted(place.rglob("*.*")) if place.is_dir() else [place] for place in places)
    texts = (path.read_bytes() for some in files for path in some if path.suffix in {".py", ".toml"})
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


def mark_used(path: Path) -> None:
    """Note that a kept file is in use, so that it is not among the oldest."""
    with contextlib.suppress(OSError):
        os.utime(path)


def kept() -> tuple[Kept, ...]:
    """All that is kept, the oldest first."""
    found: dict[tuple[str, str], list[tuple[Path, os.stat_result]]] = {}
    for kind in KINDS:
        for path in _files(cache_folder() / kind):
            with contextlib.suppress(OSError):  # gone meanwhile
                found.setdefault((kind, _stem(path)), []).append((path, path.stat()))
    every = [
        Kept(
            kind,
            name,
            tuple(path for path, _ in files),
            sum(status.st_size for _, status in files),
            max(status.st_mtime for _, status in files),
        )
        for (kind, name), files in found.items()
    ]
    return tuple(sorted(every, key=lambda one: (one.used, one.kind, one.name)))


def trim(spared: str = "") -> tuple[Kept, ...]:
    """Remove the oldest until the rest is within the limit; what is `spared` by name stays. Returns what went."""
    every, most = kept(), limit()
    size = sum(one.size for one in every)
    gone = []
    for one in every:
        if size <= most:
            break
        if one.name != spared:
            _remove(one)
            gone.append(one)
            size -= one.size
    return tuple(gone)


def clear() -> tuple[Kept, ...]:
    """Remove all that is kept; returns what went."""
    every = kept()
    for one in every:
        _remove(one)
    return every


def _files(folder: Path) -> Iterator[Path]:
    """Files of a folder and of those inside; nothing is followed out of it."""
    for place, _, names in os.walk(folder):
        for name in names:
            path = Path(place) / name
            if path.is_file() and not path.is_symlink():
                yield path


def _stem(path: Path) -> str:
    """What the names of a file, and of those that were made of it, begin with."""
    return path.name.lstrip(".").partition(".")[0]


def _remove(one: Kept) -> None:
    for path in one.files:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
