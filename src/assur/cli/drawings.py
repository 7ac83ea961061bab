"""What `assur figures` writes, and what it says of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from assur.figures.context import Context


def outcome(
    record: Mechanism, output: str, only: Sequence[str], formats: Sequence[str], width: str, shared: Shared
) -> Outcome:
    """The figures, written; those that the mechanism does not have with the reason."""
    from assur.figures.catalogue import chosen_names, left_out, write
    from assur.figures.context import Context
    from assur.figures.page import page_width

    context = Context(record, page=page_width(width))
    wanted = chosen_names(record, only, context)
    _check_formats(formats)
    folder = planned_folder(output)

    def stopped(paths: list[Path]) -> Outcome:
        return _outcome(context, wanted, paths, folder, {})

    with handing_over(list, stopped), progress("figures", shared) as step:
        paths = write(record, made(folder), wanted, formats, stages(step), context)
    return _outcome(context, wanted, paths, folder, {} if only else left_out(record, context))


def _outcome(
    context: Context, asked: Sequence[str], paths: Sequence[Path], folder: Path, missing: dict[str, str]
) -> Outcome:
    from assur.figures.catalogue import size

    figures = [
        WrittenFigure(name, tuple(str(path) for path in paths if path.stem == name), *size(context, name))
        for name in asked
        if any(path.stem == name for path in paths)
    ]
    answer = WrittenFigures(context.record.name, str(folder), tuple(figures), missing, context.page)
    return Outcome(answer, lambda: _shown(answer))


def _endings(figure: WrittenFigure) -> tuple[str, ...]:
    """Names of the files: the first whole, of the others what they end in."""
    first, *others = (Path(file) for file in figure.files)
    return (first.name, *(path.suffix for path in others))


def _check_formats(formats: Sequence[str]) -> None:
    from assur.figures.encode import FORMATS

    for name in formats:
        if name not in FORMATS:
            raise UnknownNameError("figure format", name, FORMATS)


def _shown(answer: WrittenFigures) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, {count(len(answer.figures), 'figure')} in {answer.folder}")
    yield table(
        ("figure", "width x height (mm)", "files"),
        [
            (figure.name, f"{figure.width:.1f} x {figure.height:.1f}", " ".join(_endings(figure)))
            for figure in answer.figures
        ],
        left=("figure", "files"),
    )
    for figure in answer.figures:
        if figure.width > answer.width + 0.05:
            yield f"{figure.name} is wider than {answer.width:g} mm: what stands in a row of it has no room there"
    for name, why in answer.left_out.items():
        yield f"no {name}: {why}"
