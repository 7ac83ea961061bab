"""The table of indices, from the tables in the package."""

from __future__ import annotations

from pathlib import Path

UNITS = {0: "none", 1: "as mm/rad", None: "that of a factor, to the power r"}
"""What `Index.power` says of a unit."""

HEAD = ("name", "formula", "unit", "0", "1", "source")
NEAREST = "least ‖x − x*‖ over found poses x* at which a parallel factor is zero"


def markdown(_root: Path) -> str:
    """A row for each index, and one for the distance that stands beside them in maps."""
    from assur.performance.indices import INDICES
    from assur.workspace.index_maps import DISTANCE

    rows = [
        (f"`{name}`", index.formula, UNITS[index.power], index.zero, index.one, index.source)
        for name, index in INDICES.items()
    ]
    last = (f"`{DISTANCE}`", NEAREST, "length", "parallel singularity", "nothing special", "")
    return "\n".join(map(_line, (HEAD, ("---",) * len(HEAD), *rows, last)))


def _line(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
