"""Whether an HTML page needs anything outside itself; a link that a reader may follow is nothing it needs."""

from __future__ import annotations

import re
from html.parser import HTMLParser

LOADED = ("src", "srcset", "data", "poster", "action", "background")
"""Attributes whose value a browser loads."""
STYLE = re.compile(r"@import|url\(\s*['\"]?(?!data:|#|['\"])", re.IGNORECASE)


def outside_needs(page: str) -> list[str]:
    """What a browser would have to load from elsewhere to show a page.

    >>> outside_needs('<img src="data:image/png;base64,AA"><a href="https://doi.org">x</a><script src="x.js">')
    ['x.js']
    """
    reader = _Reader()
    reader.feed(page)
    reader.close()
    return reader.references


class _Reader(HTMLParser):
    """Collects what is loaded from outside."""

    def __init__(self) -> None:
        super().__init__()
        self.references: list[str] = []
        self.tag = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Look at a tag's attributes."""
        self.tag = tag
        for name, value in attrs:
            loaded = name in LOADED or (name in ("href", "xlink:href") and tag not in ("a", "area"))
            if value and loaded and not value.strip().startswith(("data:", "#")):
                self.references.append(value)
            if name == "style" and value and STYLE.search(value):
                self.references.append(value)

    def handle_data(self, data: str) -> None:
        """Look at a style sheet."""
        if self.tag == "style" and STYLE.search(data):
            self.references.append(" ".join(data.split())[:60])
