"""Stages of a long work: which are open, how far they are and what they have, so that whoever ends it can be told.

A stage is noted where the work is done, by its name in words for a reader; whoever is inside says how far it is. So the
one that is broken off by Ctrl-C is known whatever it was, also where its work has nothing to hand over.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from itertools import count

Progress = Callable[[int, int], None]
"""Told how many steps are done, of how many."""


@dataclass
class WorkStage:
    """A part of a work.

    Attributes:
        name: what is done, in words.
        steps: how many steps are done.
        total: of how many; 0 where that is not known.
        result: what it has by now, in words.
        ended: stages inside that are done, with their results.
        files: of the whole, those that were written.
    """

    name: str
    steps: int = 0
    total: int = 0
    result: str = ""
    ended: dict[str, str] = field(default_factory=dict)
    files: list[str] = field(default_factory=list)

    def at(self, steps: int, total: int = 0, result: str | None = None) -> None:
        """Note how many steps are done, of how many, and what there is by now, where that has changed."""
        self.steps, self.total = steps, total
        if result is not None:
            self.result = result

    def __str__(self) -> str:
        of = f" of {self.total}" if self.total else ""
        notes = [*([f"{self.steps}{of}"] if self.total or self.steps else []), *([self.result] if self.result else [])]
        return f"{self.name} ({', '.join(notes)})" if notes else self.name


LISTED = 8
"""Names in a list of what is done, the last ones; a screen has no place for hundreds of files."""

_OPEN: ContextVar[tuple[WorkStage, ...]] = ContextVar("stages that are open", default=())


@contextmanager
def stage(name: str, total: int = 0) -> Iterator[WorkStage]:
    """A part of a work, open while the block runs.

    Args:
        name: what is done, in words.
        total: how many steps it has, where that is known.

    >>> with stage("search", 9) as search:
    ...     search.at(3, 9, "2 solutions")
    ...     where()
    'search (3 of 9, 2 solutions)'
    >>> where()
    ''
    """
    outer, made = _OPEN.get(), WorkStage(name, total=total)
    _OPEN.set((*outer, made))
    try:
        yield made
    finally:
        _OPEN.set(outer)
    if outer:
        outer[-1].ended[name] = made.result


def written(path: str) -> None:
    """Note that a file was written whole."""
    stages = _OPEN.get()
    if stages:
        stages[0].files.append(path)


def where() -> str:
    """What is done at this moment: the stages that are open, from the whole to its part; "" where none is."""
    return ": ".join(map(str, _OPEN.get()))


def before() -> str:
    """The stages that are done, each with its result, and the files that were written; a line for each of both.

    Parts of the whole alone are told, not those inside a part; of many only the last `LISTED`, with how many more.

    >>> with stage("report"):
    ...     with stage("audit") as audit:
    ...         audit.at(4, 4, "4 rows")
    ...     with stage("workspace"):
    ...         where(), before()
    ('report: workspace', 'done before: audit (4 rows)')
    """
    stages = _OPEN.get()
    if not stages:
        return ""
    ended = [f"{name} ({result})" if result else name for name, result in stages[0].ended.items()]
    lines = (("done before", ended), ("written before", stages[0].files))
    return "\n".join(f"{head}: {_last(texts)}" for head, texts in lines if texts)


def _last(texts: list[str]) -> str:
    more = [f"{len(texts) - LISTED} more"] if len(texts) > LISTED else []
    return ", ".join([*more, *texts[-LISTED:]])


def ticker(total: int, progress: Progress | None) -> Callable[[], None]:
    """A function that reports one more step done."""
    steps = count(1)
    return (lambda: progress(next(steps), total)) if progress else (lambda: None)
