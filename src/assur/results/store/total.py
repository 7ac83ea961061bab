"""A total that is kept in one file, with how much of the work it is of."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from assur.errors import UsageError
from assur.results.disk import DISK, Disk
from assur.results.store.inspection import Fault, damaged
from assur.results.store.note import DamagedNoteError, differences, sealed, unsealed


class KeptTotal:
    """The total of a question in a file; in memory alone where there is no path.

    Args:
        path: the file.
        question: all that the total depends on, as plain data.
        start: the total of nothing.
        disk: the operations that change files.

    Attributes:
        done: how much of the work it is of.
        total: what it is.

    Errors:
        UsageError: the file has another question.
        DamagedStoreError: it is not what was written.
    """

    def __init__(self, path: Path | None, question: Mapping[str, Any], start: Any, disk: Disk = DISK) -> None:
        self.path, self.question, self.disk = path, dict(json.loads(json.dumps(question))), disk
        self.done, self.total = 0, start
        if path is not None and path.exists():
            self._read(path)

    def save(self, done: int, total: Any) -> None:
        """Keep it."""
        self.done, self.total = done, total
        if self.path is None:
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        entries = {"question": self.question, "done": done, "total": total}
        self.disk.write_whole(self.path, sealed({name: json.dumps(value) for name, value in entries.items()}))

    def _read(self, path: Path) -> None:
        try:
            kept = unsealed(path)
            other = differences({"question": self.question}, kept)
            if other:
                raise UsageError(
                    f"{path}: belongs to another question; it differs in {', '.join(other)}",
                    hint="choose another place, or remove what is there",
                )
            self.done, self.total = int(kept["done"]), kept["total"]
        except (DamagedNoteError, KeyError, TypeError, ValueError) as error:
            fault = Fault(path, str(error), "the note of a total is due")
            raise damaged([fault], "choose another place, or remove it: the total begins anew") from error
