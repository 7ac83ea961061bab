"""Names in a file: those of links, joints and points, which some readers want to differ."""

from __future__ import annotations

from collections.abc import Iterable


def link_name(link: str) -> str:
    """Name of a link in a file: its own, but `world` is that of the ground everywhere.

    >>> link_name("crank"), link_name("world")
    ('crank', 'world.link')
    """
    return "world.link" if link == "world" else link


class Names:
    """Names that are taken in a file; `world` is reserved in every form.

    >>> names = Names()
    >>> names.new("world", "link"), names.new("A", "link"), names.new("A", "joint")
    ('world.link', 'A', 'A.joint')
    """

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self.taken = {"world", *taken}

    def new(self, name: str, kind: str) -> str:
        """The name, where it is taken already with its kind after it."""
        while name in self.taken:
            name = f"{name}.{kind}"
        self.taken.add(name)
        return name
