"""The figures of a mechanism with the lines that made them: drawn once, kept until a source changes."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assur.figures.context import Context

DOTS = 130
"""Pixels per inch: enough for a page of the site."""

WITHOUT = ("cli", "view", "page", "report", "audit")
"""Packages on which no figure depends, as they stand above `figures`."""


def markdown(root: Path, name: str, *figures: str) -> str:
    """A section for each figure of one mechanism; all that it has where none are named.

    Where ASSUR_GALLERY is `blank` nothing is computed: titles without captions, above empty pictures.
    """
    return "\n".join(_section(name, item, folder) for folder, item in _figures(root, name, figures))


def picture(root: Path, name: str, figure: str) -> str:
    """One figure of a mechanism with its caption, for a page that says the rest."""
    ((folder, drawing),) = _figures(root, name, (figure,))
    return _picture(name, drawing, folder)


def _figures(root: Path, name: str, figures: tuple[str, ...]) -> list[tuple[Path, dict[str, str]]]:
    make, kept = (blank, "blank") if os.environ.get("ASSUR_GALLERY") == "blank" else (drawn, "gallery")
    folder = root / "build" / kept / name
    return [(folder, drawing) for drawing in make(root, folder, name, figures)]


def drawn(root: Path, folder: Path, name: str, figures: tuple[str, ...]) -> list[dict[str, str]]:
    """Name, number, title and caption of each figure, whose picture then lies in the folder."""
    from assur.figures.catalogue import names
    from assur.figures.context import Context
    from assur.model.registry import load_record

    key = _key(root)
    context = Context(load_record(name))
    chosen = figures or tuple(names(context.record, context))
    return [_known(folder / item, key) or _draw(context, item, folder / item, key) for item in chosen]


def blank(_root: Path, folder: Path, name: str, figures: tuple[str, ...]) -> list[dict[str, str]]:
    """As `drawn`, for who looks at the site alone."""
    from matplotlib.figure import Figure

    from assur.figures.catalogue import ENTRIES, names
    from assur.figures.encode import encoded
    from assur.model.registry import load_record

    folder.mkdir(parents=True, exist_ok=True)
    titles = {entry.name: entry.title for entry in ENTRIES}
    chosen = figures or tuple(names(load_record(name)))
    for item in chosen:
        (folder / f"{item}.png").write_bytes(encoded(Figure(figsize=(1, 1)), "png"))
    return [{"name": item, "title": titles[item], "caption": ""} for item in chosen]


def _known(stem: Path, key: str) -> dict[str, str] | None:
    """What was drawn from the same sources."""
    about, picture = stem.with_suffix(".json"), stem.with_suffix(".png")
    if not (about.is_file() and picture.is_file()):
        return None
    found: dict[str, str] = json.loads(about.read_text(encoding="utf-8"))
    return found if found["key"] == key else None


def _draw(context: Context, name: str, stem: Path, key: str) -> dict[str, str]:
    from assur.figures.catalogue import draw, spec
    from assur.figures.encode import encoded

    figure = draw(context.record, name, context)
    about = spec(context.record, name, context)
    found = {"key": key, "name": name, "number": about.number, "title": about.title, "caption": about.caption}
    stem.parent.mkdir(parents=True, exist_ok=True)
    stem.with_suffix(".png").write_bytes(encoded(figure, "png", dots=DOTS))
    stem.with_suffix(".json").write_text(json.dumps(found), encoding="utf-8")
    return found


def _key(root: Path) -> str:
    """A digest of every source that a figure may depend on."""
    source = root / "src" / "assur"
    digest = hashlib.sha256()
    for path in sorted(source.rglob("*")):
        if path.suffix in (".py", ".toml") and path.relative_to(source).parts[0] not in WITHOUT:
            digest.update(path.relative_to(source).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()


def _section(mechanism: str, figure: dict[str, str], folder: Path) -> str:
    name, title = figure["name"], figure["title"]
    return f"""
## {title[:1].upper()}{title[1:]}

{_picture(mechanism, figure, folder)}

```sh
assur figures {mechanism} --only {name}
```

```python
write(assur.load("{mechanism}"), "figures", ["{name}"])
```
"""


def _picture(mechanism: str, figure: dict[str, str], folder: Path) -> str:
    return f"![{figure['title']} of {mechanism}]({_place(folder, figure['name'])})\n\n{figure['caption']}"


def places(root: Path, name: str, figures: tuple[str, ...]) -> dict[str, str]:
    """Figure -> where its picture lies, as a page names it."""
    return {item["name"]: _place(folder, item["name"]) for folder, item in _figures(root, name, figures)}


def _place(folder: Path, figure: str) -> str:
    return f"../{folder.relative_to(folder.parents[2]).as_posix()}/{figure}.png"
