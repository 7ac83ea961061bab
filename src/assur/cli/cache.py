"""`assur cache`: what is kept for the next start, where, and how large it is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import heading, table

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.cache import Kept


def cache(
    *,
    clear: Annotated[bool, Parameter(help="Remove all of it; it is made anew where it is needed.")] = False,
    shared: Plain = PLAIN,  # noqa: ARG001  # read by main
) -> Outcome:
    """What is kept for the next start: where it is and how large.

    It lies in the folder that ASSUR_CACHE names, else in the user's cache
    folder. Of more than ASSUR_CACHE_LIMIT megabytes (512 if that is not set) the
    oldest goes first. Nothing else in that folder is touched.

    For example:
        assur cache
        assur cache --clear
    """
    from assur import cache as store

    gone = store.clear() if clear else store.trim()
    rest = store.kept()
    data = {
        "folder": str(store.cache_folder()),
        "limit": store.limit(),
        "bytes": _size(rest),
        "kinds": [
            {"name": kind, "what": what, "entries": len(some), "bytes": _size(some)}
            for kind, what in store.KINDS.items()
            for some in [[one for one in rest if one.kind == kind]]
        ],
        "removed": {"entries": len(gone), "bytes": _size(gone)},
    }
    return Outcome(data, lambda: _shown(data))


def _size(some: Sequence[Kept]) -> int:
    return sum(one.size for one in some)


def _shown(data: dict[str, Any]) -> Iterable[RenderableType]:
    yield heading(f"kept: {_megabytes(data['bytes'])} of at most {_megabytes(data['limit'])}")
    yield f"in {data['folder']}"
    if data["removed"]["entries"]:
        yield f"removed: {data['removed']['entries']} of them, {_megabytes(data['removed']['bytes'])}"
    rows = [(kind["name"], str(kind["entries"]), _megabytes(kind["bytes"]), kind["what"]) for kind in data["kinds"]]
    yield ""
    yield table(("folder", "entries", "size", "what it is"), rows, left=("folder", "what it is"))


def _megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"
