"""The picture of the house: its folders in the order of the theory, and who imports whom, drawn from the source.

`python docs/extensions/architecture.py` writes docs/images/architecture.svg anew; a test compares it with the code.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from pathlib import Path

import networkx as nx
from imports import imports, module_files
from packages import idea

ROOT = Path(__file__).parents[2]
PICTURE = Path("docs") / "images" / "architecture.svg"

STOREYS = {
    "what is drawn, written, printed": "cli view page report audit figures crosscheck export",
    "a mechanism with its analyses": "mechanism improved_topology derived_topology",
    "analyses": "synthesis derivation certificates machine scene workspace singularity performance kinematics",
    "a mechanism as data": "joint_graph model topology joints",
    "tools": "results numerics cache storage errors verifier version work",
}
"""Folders by what they are for; a test compares them with the order of imports."""

FILLS = ("#fdebd3", "#f6f0c9", "#dcefdc", "#d9e8f7", "#ececec")
ROW, BOX, WIDTH, LEFT, GAP = 24, 134, 1000, 204, 26


def picture(root: Path) -> str:
    """An SVG: a box for each folder with its idea, storey by storey, and an arrow for each import that is not implied.

    An import is implied where a chain of others leads to the same folder.
    """
    heights = dict(_heights())
    source = root / "src" / "assur"
    rows = [line for name, y in heights.items() for line in _row(name, y, source)]
    arrows = [_arrow(heights[upper], heights[lower]) for upper, lower in sorted(direct_imports(root))]
    height = max(heights.values()) + ROW + GAP
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
        'font-family="system-ui, Helvetica, Arial, sans-serif" font-size="12">'
    )
    marker = (
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6" orient="auto">'
        '<path d="M0 0L8 4L0 8z" fill="#777"/></marker></defs>'
    )
    ground = f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>'
    return "\n".join([head, marker, ground, *_storeys(heights), *arrows, *rows, "</svg>", ""])


def direct_imports(root: Path) -> set[tuple[str, str]]:
    """Pairs (folder, folder that it imports) that no chain of other imports implies; mechanisms are data."""
    by_module = imports(module_files(root / "src" / "assur"))
    folders = {name for names in STOREYS.values() for name in names.split()}
    pairs = {(_folder(name), _folder(other)) for name, others in by_module.items() for other in others}
    graph = nx.DiGraph((a, b) for a, b in pairs if a != b and {a, b} <= folders)
    return set(nx.transitive_reduction(graph).edges)


def _folder(module: str) -> str:
    return module.split(".")[1] if "." in module else ""


def _heights() -> Iterator[tuple[str, int]]:
    y = GAP
    for names in STOREYS.values():
        for name in names.split():
            yield name, y
            y += ROW
        y += GAP


def _storeys(heights: dict[str, int]) -> Iterator[str]:
    for (title, names), fill in zip(STOREYS.items(), FILLS, strict=True):
        first, last = heights[names.split()[0]], heights[names.split()[-1]]
        height = last - first + ROW
        yield f'<text x="{LEFT}" y="{first - 8}" font-style="italic">{escape(title)}</text>'
        yield f'<rect x="{LEFT - 8}" y="{first - 2}" width="{WIDTH - LEFT}" height="{height}" rx="6" fill="{fill}"/>'


def _row(name: str, y: int, source: Path) -> Iterator[str]:
    path = source / name / "__init__.py" if (source / name).is_dir() else source / f"{name}.py"
    yield f'<rect x="{LEFT}" y="{y}" width="{BOX}" height="{ROW - 4}" rx="4" fill="#ffffff" stroke="#555"/>'
    yield f'<text x="{LEFT + 8}" y="{y + 14}" font-weight="bold">{escape(name)}</text>'
    yield f'<text x="{LEFT + BOX + 12}" y="{y + 14}" font-size="11">{escape(idea(path))}</text>'


def _arrow(upper: int, lower: int) -> str:
    start, end = upper + ROW // 2 + 2, lower + ROW // 2 - 4
    reach = LEFT - 12 - 1.3 * ((lower - upper) * 1.2) ** 0.78
    return (
        f'<path d="M{LEFT} {start}C{reach:.0f} {start} {reach:.0f} {end} {LEFT} {end}" '
        'fill="none" stroke="#777" marker-end="url(#tip)"/>'
    )


if __name__ == "__main__":
    (ROOT / PICTURE).write_text(picture(ROOT), encoding="utf-8")
