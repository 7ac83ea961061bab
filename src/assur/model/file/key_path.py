"""Where something stands in a TOML document: the keys and places in lists that lead there."""

from __future__ import annotations

from assur.errors import cut

KeyPath = tuple[str | int, ...]


def path_text(path: KeyPath) -> str:
    """A key path as TOML writes it, elements of arrays in brackets.

    >>> path_text(("joints", "B1", "at", 2)), path_text(("home", "leg1.B"))
    ('joints.B1.at[2]', 'home."leg1.B"')
    """
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            plain = part.replace("_", "a").replace("-", "a").isalnum() and part.isascii()
            text += ("." if text else "") + (cut(part) if plain else f'"{cut(part)}"')
    return text
