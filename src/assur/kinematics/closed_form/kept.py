"""What is kept of an unfinished grid: a note of the question and of how much is done, and files written by parts."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError

KINDS: Mapping[str, Any] = {"exists": bool, "status": np.int8}
"""Numbers of an answer that are no floats."""


class State:
    """The JSON file beside an answer: the question, and how many poses are done."""

    def __init__(self, path: Path | None, question: Mapping[str, Any]) -> None:
        self.path, self.question = path, dict(question)
        self.done, self.total, self.known = 0, None, False
        if path is not None and path.exists():
            self._read(path)

    total: Any

    def save(self, done: int, total: Any) -> None:
        """Note what is done; the file is replaced as a whole, so that it is never half written."""
        self.done, self.total = done, total
        if self.path is None:
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        fresh = self.path.with_name(f"{self.path.name}.new")
        fresh.write_text(json.dumps({"question": self.question, "done": done, "total": total}, indent=1) + "\n")
        fresh.replace(self.path)

    def _read(self, path: Path) -> None:
        try:
            kept = json.loads(path.read_text())
            question, done, total = kept["question"], int(kept["done"]), kept["total"]
        except (ValueError, KeyError, TypeError) as error:
            raise UsageError(
                f"{path}: not a note of an unfinished grid ({error})", hint="choose another place"
            ) from error
        asked = json.loads(json.dumps(self.question))
        other = [name for name in {**asked, **question} if asked.get(name) != question.get(name)]
        if other:
            raise UsageError(
                f"{path}: belongs to another question; it differs in {', '.join(other)}",
                hint="choose another place, or remove what is there",
            )
        self.done, self.total, self.known = done, total, True


class RowsFile:
    """A `.npy` file of rows (r, N), written by parts without being mapped into memory."""

    def __init__(self, file: Any, count: int) -> None:
        version = np.lib.format.read_magic(file)
        read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        self.dtype = read(file)[2]
        self.file, self.first, self.count = file, file.tell(), count

    def write(self, start: int, rows: NDArray[Any]) -> None:
        """Rows (r, b) from pose `start` on."""
        for k, row in enumerate(rows):
            self.file.seek(self.first + self.dtype.itemsize * (k * self.count + start))
            self.file.write(np.ascontiguousarray(row, dtype=self.dtype).data)
        self.file.flush()


def make_files(files: Mapping[str, Path], shapes: Mapping[str, tuple[int, ...]]) -> None:
    """Files of the answer, of the right size and still empty; refused where they are there or do not fit.

    Where they cannot be made nothing is left.
    """
    folder = next(iter(files.values())).parent if files else Path()
    there = [str(path) for path in files.values() if path.exists()]
    if there:
        raise UsageError(
            f"{', '.join(there)}: already there, without a note of what it is", hint="choose another folder"
        )
    kinds = {name: np.dtype(KINDS.get(name, float)) for name in files}
    needed = sum(int(np.prod([float(n) for n in shapes[name]])) * kinds[name].itemsize for name in files)
    free = shutil.disk_usage(next(place for place in (folder, *folder.absolute().parents) if place.is_dir())).free
    if needed > free:
        raise UsageError(
            f"{folder}: the answer takes {needed / 1e9:.1f} GB and {free / 1e9:.1f} GB are free",
            hint="keep less of it, or take fewer places",
        )
    new = [place for place in (folder, *folder.absolute().parents) if not place.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, path in files.items():
            np.lib.format.open_memmap(path, mode="w+", dtype=kinds[name], shape=shapes[name])
    except OSError:
        for remove in (*(path.unlink for path in files.values()), *(place.rmdir for place in new)):
            with suppress(OSError):  # what was wrong is told, whatever cannot be removed
                remove()
        raise
