"""`assur cache`: what is kept for the next start, where, and how large it is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import heading, table

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.cache import Kept
    from assur.results.answers.installation import CacheAnswer, KeptKind, KeptSize


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
    from assur.results.answers.installation import CacheAnswer

    gone = store.clear() if clear else store.trim()
    rest = store.kept()
    answer = CacheAnswer(
        folder=str(store.cache_folder()),
        limit=store.limit(),
        bytes=_size(rest).bytes,
        kinds=tuple(_kind(kind, what, rest) for kind, what in store.KINDS.items()),
        removed=_size(gone),
    )
    return Outcome(answer, lambda: _shown(answer))


def _size(some: Sequence[Kept]) -> KeptSize:
    from assur.results.answers.installation import KeptSize

    return KeptSize(len(some), sum(entry.size for entry in some))


def _kind(name: str, what: str, rest: Sequence[Kept]) -> KeptKind:
    from assur.results.answers.installation import KeptKind

    size = _size([entry for entry in rest if entry.kind == name])
    return KeptKind(size.entries, size.bytes, name, what)


def _shown(data: CacheAnswer) -> Iterable[RenderableType]:
    yield heading(f"kept: {_megabytes(data.bytes)} of at most {_megabytes(data.limit)}")
    yield f"in {data.folder}"
    if data.removed.entries:
        yield f"removed: {data.removed.entries} of them, {_megabytes(data.removed.bytes)}"
    rows = [(kind.name, str(kind.entries), _megabytes(kind.bytes), kind.what) for kind in data.kinds]
    yield ""
    yield table(("folder", "entries", "size", "what it is"), rows, left=("folder", "what it is"))


def _megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"
