"""Docstrings of the package as reStructuredText: they are plain text with `names` in it, and are shown as that."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from sphinx.application import Sphinx

_NAME = re.compile(r"(`[^`\n]+`)")
_OURS = re.compile(r"`assur(\.\w+)+`")
_SIGN = re.compile(r"[*|\\]|_(?=\W|$)")
VALUES = ("attribute", "data", "property")
"""Of these napoleon takes what stands before a colon for the type; an empty comment before it keeps it from that."""

_ERRORS = re.compile(r"( *)Errors:\s*")


def plain(text: str) -> str:
    """One line of prose: our `names` lead to what they name, others are literals, no other sign means anything."""
    return "".join(
        _marked(piece) if _NAME.fullmatch(piece) else _SIGN.sub(r"\\\g<0>", piece) for piece in _NAME.split(text)
    )


def _marked(name: str) -> str:
    return f":py:obj:{name}" if _OURS.fullmatch(name) else f"`{name}`"


def escaped(lines: Iterable[str]) -> Iterator[str]:
    """Lines with their prose escaped; examples, up to the blank line after them, stay."""
    example = False
    for line in lines:
        example = (example and bool(line.strip())) or line.lstrip().startswith(">>>")
        yield line if example else plain(line)


def with_list_of_errors(lines: Iterable[str]) -> list[str]:
    """Lines with what stands under `Errors:` as a list, an item for each, however many lines it takes."""
    found: list[str] = []
    within: str | None = None
    for line in lines:
        if head := _ERRORS.fullmatch(line):
            within = head[1] + "    "
            found.append(line)
        elif within is None or not line.startswith(within):
            within = None
            found.append(line)
        elif line.startswith(within + " "):
            found[-1] += f" {line.strip()}"
        else:
            found.append(f"{within}* {line.strip()}")
    return found


def process(_app: Sphinx, what: str, _name: str, _found: Any, _options: Any, lines: list[str]) -> None:
    """Rewrite a docstring in place."""
    lines[:] = with_list_of_errors(escaped(lines))
    if what in VALUES:
        lines[:0] = ["..", ""]


def signature(_app: Sphinx, what: str, *_rest: Any) -> tuple[str, str] | None:
    """None of a class: its attributes say the same at more length."""
    return ("", "") if what == "class" else None


def setup(app: Sphinx) -> dict[str, bool]:
    """Before napoleon, whose priority is 500."""
    app.connect("autodoc-process-docstring", process, priority=400)
    app.connect("autodoc-process-signature", signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
