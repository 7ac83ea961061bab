"""What the pages hold that is made at build time: a comment `<!-- made: NAME WORDS -->` is replaced by Markdown.

`gallery`: the figures of a mechanism. `tasks`: what each is for. `figure`: one of them. `notebook`: a notebook with its
outputs. `packages`: every module and its idea. `layers`: the order of imports. `indices`: the table of indices.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import gallery
import index_table
import notebook
import packages
import tasks
from sphinx.application import Sphinx

MAKERS: dict[str, Callable[..., str]] = {
    "gallery": gallery.markdown,
    "figure": gallery.picture,
    "notebook": notebook.markdown,
    "tasks": tasks.markdown,
    "packages": packages.markdown,
    "layers": packages.layers,
    "indices": index_table.markdown,
}
"""Each takes the root of the checkout and the words after its name."""

_MARK = re.compile(r"<!-- made: (\w+) ?(.*?) -->")


_LAST = re.compile(r"^(```python\n.*?)\n+```$", re.DOTALL | re.MULTILINE)
"""A block of Python: doctest wants a blank line before its end, a reader does not."""


def fill(text: str, root: Path) -> str:
    """A page with every mark replaced."""
    return _MARK.sub(lambda found: MAKERS[found[1]](root, *found[2].split()), _LAST.sub(r"\1\n```", text))


def _source_read(app: Sphinx, _page: str, source: list[str]) -> None:
    source[0] = fill(source[0], Path(app.srcdir).parent)


def setup(app: Sphinx) -> dict[str, bool]:
    """Before a page is read."""
    app.connect("source-read", _source_read)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
