"""What `assur figures` writes, and what it says of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import RenderableType

from assur.cli.interruption import handing_over
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.paths import made, planned_folder
from assur.cli.progress import progress, stages
from assur.errors import UnknownNameError
from assur.mechanism import Mechanism
from assur.results.answers.files import WrittenFigure, WrittenFigures
from assur.results.plain_text import count


def outcome(record: Mechanism, output: str, only: Sequence[str], formats: Sequence[str], shared: Shared) -> Outcome:
    """The figures, written; those that the mechanism does not have with the reason."""
    from assur.figures.catalogue import chosen_names, left_out, write
    from assur.figures.context import Context

    context = Context(record)
    wanted = chosen_names(record, only, context)
    _check_formats(formats)
    folder = planned_folder(output)

    def stopped(paths: list[Path]) -> Outcome:
        return _outcome(record, wanted, paths, folder, {})

    with handing_over(list, stopped), progress("figures", shared) as step:
        paths = write(record, made(folder), wanted, formats, stages(step), context)
    return _outcome(record, wanted, paths, folder, {} if only else left_out(record, context))


def _outcome(
    record: Mechanism, asked: Sequence[str], paths: Sequence[Path], folder: Path, missing: dict[str, str]
) -> Outcome:
    figures = [
        WrittenFigure(name, tuple(str(path) for path in paths if path.stem == name))
        for name in asked
        if any(path.stem == name for path in paths)
    ]
    answer = WrittenFigures(record.name, str(folder), tuple(figures), missing)
    return Outcome(answer, lambda: _shown(answer))


def _check_formats(formats: Sequence[str]) -> None:
    from assur.figures.encode import FORMATS

    for name in formats:
        if name not in FORMATS:
            raise UnknownNameError("figure format", name, FORMATS)


def _shown(answer: WrittenFigures) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, {count(len(answer.figures), 'figure')} in {answer.folder}")
    yield table(
        ("figure", "files"),
        [(figure.name, "\n".join(Path(file).name for file in figure.files)) for figure in answer.figures],
        left=("figure", "files"),
    )
    for name, why in answer.left_out.items():
        yield f"no {name}: {why}"
