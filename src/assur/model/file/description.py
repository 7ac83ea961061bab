"""The description of a mechanism: its file, in form, before any formula is evaluated."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from assur.model.file.key_path import KeyPath
from assur.model.file.schema import FileEntry
from assur.model.file.toml_source import TomlSource


@dataclass(frozen=True, eq=False)
class Description:
    """A file in the form of `schema`.

    Attributes:
        path: the file.
        source: its document, with lines.
        entry: the part that is in form.
        cut: paths of what is not and was left out; empty in a file without faults.
    """

    path: Path
    source: TomlSource
    entry: FileEntry
    cut: frozenset[KeyPath] = frozenset()
