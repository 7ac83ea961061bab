"""The description of a mechanism: its file, before any formula is evaluated."""

from __future__ import annotations

import difflib
import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from assur.errors import KeyPath, MechanismFileError, Problem
from assur.model.file.faults import Faults
from assur.results.reading import file_text

if TYPE_CHECKING:
    from assur.model.file.schema import FileEntry
    from assur.model.file.toml_source import TomlSource

ALIKE = 0.8
"""How alike names of files are of which one is a slip for the other: my.tml and my.toml are to 0.92."""
MOST_BESIDE = 1000
"""Files of a folder that are compared with a name at most."""


@dataclass(frozen=True, eq=False)
class Description:
    """A file as text, and its document in the form of `schema`, which is worked out where it is asked for.

    Attributes:
        path: the file.
        text: what stands in it.
    """

    path: Path
    text: str

    @cached_property
    def source(self) -> TomlSource:
        """The document, with lines.

        Errors:
            MechanismFileError: the text is not TOML.
        """
        from assur.model.file.toml_source import read_toml  # what was kept is not read again

        return read_toml(self.text, str(self.path))

    @cached_property
    def form(self) -> Form:
        """What of the document is in form, and the faults of the rest.

        Errors:
            MechanismFileError: too little is left to look any further.
        """
        from assur.model.file.form import check_form  # schemas take longer to make than all else that a command loads

        faults = Faults(str(self.path), self.source)
        entry, cut = check_form(self.source.data, faults)
        if entry is None:
            faults.raise_any()
            raise MechanismFileError(
                [Problem(str(self.path), None, "", "a broken document", "allowed: the form of a file")]
            )
        return Form(entry, cut, faults)


@dataclass(frozen=True, eq=False)
class Form:
    """A document, its form checked.

    Attributes:
        entry: the part that is in form.
        cut: paths of what is not and was left out; empty in a file without faults.
        faults: what was noted of these.
    """

    entry: FileEntry
    cut: frozenset[KeyPath]
    faults: Faults


def named_nearly(text: str) -> str:
    """The hint that names a mechanism's file of nearly this path: its own ending, or a slip; empty where there is none.

    >>> named_nearly("no such file")
    ''
    """
    if not text.strip():
        return ""
    if os.path.isfile(f"{text}.toml"):  # noqa: PTH113  # which a name that is none does not upset
        return f"did you mean {text}.toml?"
    folder, name = os.path.split(text)
    try:
        beside = [entry for entry in os.listdir(folder or ".") if entry.endswith(".toml")]  # noqa: PTH208  # as above
    except (OSError, ValueError):
        return ""
    near = difflib.get_close_matches(name, beside[:MOST_BESIDE], n=1, cutoff=ALIKE)
    return f"did you mean {os.path.join(folder, near[0])}?" if near else ""  # noqa: PTH118  # as it was typed


def description_text(path: Path) -> str:
    """The text of a mechanism's or a topology's file.

    Errors: as `assur.results.reading.file_text`.
    """
    return file_text(path, hint=named_nearly(str(path)))
