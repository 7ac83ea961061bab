"""The catalogue: every figure that a mechanism has, in the order of a paper; drawing and writing them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from assur.errors import Interrupted, UnknownNameError
from assur.figures.accuracy import ACCURACY, ERRORS
from assur.figures.aspects import ASPECTS
from assur.figures.context import Context
from assur.figures.dexterity import DEXTERITY, LARGEST, SMALLEST
from assur.figures.ellipsoid import ELLIPSOID
from assur.figures.encode import FORMATS, USUAL, encoded
from assur.figures.flow import FLOW
from assur.figures.force_maps import FORCE_MAPS
from assur.figures.force_polytope import FORCE_POLYTOPE
from assur.figures.graph import GRAPH
from assur.figures.index_maps import INDEX_MAPS
from assur.figures.indices import MANIPULABILITY, TRANSMISSION
from assur.figures.joint_forces import JOINT_FORCES
from assur.figures.latex import snippet
from assur.figures.model import MODEL
from assur.figures.parasitic import PARASITIC
from assur.figures.planes import PLANES_FIGURE
from assur.figures.projections import PROJECTIONS
from assur.figures.region import WORKSPACE
from assur.figures.sections import SECTIONS
from assur.figures.singular import PARALLEL, SERIAL, SINGULAR
from assur.figures.solid import SOLID
from assur.figures.solutions import SOLUTIONS
from assur.figures.spec import Drawing, FigureKind, FigureSpec
from assur.figures.structure import STRUCTURE
from assur.figures.style import MILLIMETRE, styled
from assur.figures.vibrations import VIBRATIONS
from assur.figures.weakest import WEAKEST
from assur.model.mechanism import MechanismRecord
from assur.results.files import write_whole
from assur.results.json_text import json_text
from assur.work import Progress, stage

ENTRIES: tuple[FigureKind, ...] = (
    STRUCTURE,
    MODEL,
    PLANES_FIGURE,
    SOLUTIONS,
    FLOW,
    SOLID,
    SERIAL,
    PARALLEL,
    SINGULAR,
    WORKSPACE,
    PROJECTIONS,
    SECTIONS,
    ASPECTS,
    PARASITIC,
    DEXTERITY,
    LARGEST,
    SMALLEST,
    TRANSMISSION,
    MANIPULABILITY,
    INDEX_MAPS,
    JOINT_FORCES,
    FORCE_POLYTOPE,
    FORCE_MAPS,
    ELLIPSOID,
    WEAKEST,
    VIBRATIONS,
    ACCURACY,
    ERRORS,
    GRAPH,
)
COMPARE = "Compare Figure {} of the source."


def catalogue(record: MechanismRecord, context: Context | None = None) -> list[FigureSpec]:
    """The figures of a mechanism, in order. Captions are computed: this takes as long as the analyses do.

    >>> from assur.model.registry import load_record
    >>> [spec.name for spec in catalogue(load_record("fivebar"))]  # doctest: +NORMALIZE_WHITESPACE
    ['structure', 'model', 'solutions', 'flow', 'solid', 'serial', 'parallel', 'singular', 'workspace',
     'aspects', 'dexterity', 'fastest', 'slowest', 'transmission', 'manipulability', 'indices',
     'reactions', 'polytope', 'forces', 'stiffness', 'weakest', 'vibrations', 'graph']
    """
    shared = context or Context(record)
    return [_spec(shared, entry) for entry in _present(shared)]


def spec(record: MechanismRecord, name: str, context: Context | None = None) -> FigureSpec:
    """Title and caption of one figure, and the number that it has in the source.

    Errors:
        UnknownNameError: the mechanism has no such figure; the hint says why, where there is a reason.

    >>> from assur.model.registry import load_record
    >>> spec(load_record("zeng2019"), "flow").number, spec(load_record("fivebar"), "flow").number
    ('3', '')
    """
    shared = context or Context(record)
    return _spec(shared, _entry(record, name, shared))


def names(record: MechanismRecord, context: Context | None = None) -> list[str]:
    """Names of the figures of a mechanism, without their captions, which is quick."""
    return [entry.name for entry in _present(context or Context(record))]


def left_out(record: MechanismRecord, context: Context | None = None) -> dict[str, str]:
    """Figures that a mechanism does not have -> why.

    >>> from assur.model.registry import load_record
    >>> left_out(load_record("fivebar"))["projections"]
    'the workspace is plane; its figure shows all of it'
    """
    shared = context or Context(record)
    return {entry.name: why for entry in ENTRIES if (why := entry.missing(shared))}


def drawing(record: MechanismRecord, name: str, context: Context | None = None) -> Drawing:
    """One figure with its numbers.

    Args:
        record: the mechanism.
        name: of the catalogue.
        context: what several figures share; give the same one to each of them.

    Errors:
        UnknownNameError: the mechanism has no such figure; the hint says why, where there is a reason.
    """
    shared = context or Context(record)
    entry = _entry(record, name, shared)

    def drawn() -> Drawing:
        with stage(f"figure {name}"), styled():
            return entry.draw(shared)

    return shared.kept(f"figure {name}", drawn)


def draw(record: MechanismRecord, name: str, context: Context | None = None) -> Figure:
    """One figure, as matplotlib's; nothing holds on to it. See `drawing`."""
    return drawing(record, name, context).figure


def size(context: Context, name: str) -> tuple[float, float]:
    """Width and height of a figure in mm, to 0.1 mm."""
    width, height = drawing(context.record, name, context).figure.get_size_inches() / MILLIMETRE
    return round(float(width), 1), round(float(height), 1)


def write(
    record: MechanismRecord,
    folder: str | Path,
    names: Iterable[str] | None = None,
    formats: Sequence[str] = USUAL,
    progress: Progress | None = None,
    context: Context | None = None,
) -> list[Path]:
    """Write figures (all, where none are named) as `<name>.<format>` and return the paths.

    Errors:
        UnknownNameError: a figure or a format that there is not; nothing is written then.
        OutputError: a file that cannot be written; what was there before stays whole.
        Interrupted: Ctrl-C; its answer is the paths of the figures that are done.
    """
    shared = context or Context(record)
    chosen = _chosen(record, shared, names)
    for form in formats:
        if form not in FORMATS:
            raise UnknownNameError("figure format", form, FORMATS)
    paths: list[Path] = []
    try:
        for done, entry in enumerate(chosen):
            drawing(record, entry.name, shared)
            if progress:
                progress(done, len(chosen))  # may end it before what is half known is written
            for form in formats:
                path = Path(folder) / f"{entry.name}.{form}"
                paths.append(write_whole(path, content(record, entry.name, form, shared)))
            if progress:
                progress(done + 1, len(chosen))
    except KeyboardInterrupt:
        raise Interrupted(paths) from None
    return paths


def chosen_names(record: MechanismRecord, asked: Sequence[str], context: Context | None = None) -> list[str]:
    """The figures that are asked for in the order of the catalogue, all where none are; no other one is looked at.

    Errors:
        UnknownNameError: the mechanism has no such figure; the hint says why, where there is a reason.

    >>> from assur.model.registry import load_record
    >>> chosen_names(load_record("fivebar"), ["solid", "structure"])
    ['structure', 'solid']
    """
    entries = _chosen(record, context or Context(record), asked or None)
    return [entry.name for entry in ENTRIES if entry in entries]


def _entry(record: MechanismRecord, name: str, context: Context) -> FigureKind:
    entry = next((item for item in ENTRIES if item.name == name), None)
    why = entry.missing(context) if entry else ""
    if entry is None or why:
        raise UnknownNameError(f"figure of {record.name}", name, names(record, context), hint=why)
    return entry


def _spec(context: Context, entry: FigureKind) -> FigureSpec:
    number = context.companion.numbers.get(entry.name, "")
    caption = entry.caption(context)
    return FigureSpec(entry.name, number, entry.title, f"{caption} {COMPARE.format(number)}" if number else caption)


def _present(context: Context) -> list[FigureKind]:
    return [entry for entry in ENTRIES if not entry.missing(context)]


def _chosen(record: MechanismRecord, context: Context, asked: Iterable[str] | None) -> list[FigureKind]:
    return _present(context) if asked is None else [_entry(record, name, context) for name in asked]


def content(record: MechanismRecord, name: str, form: str, context: Context) -> str | bytes:
    """A file of a figure: its numbers, LaTeX that includes it, or a picture."""
    entry, made = _entry(record, name, context), drawing(record, name, context)
    if form == "json":
        return _json(context, entry, made)
    if form == "tex":
        return snippet(context.record.name, _spec(context, entry), made.figure)
    return encoded(made.figure, form)


def _json(context: Context, entry: FigureKind, made: Drawing) -> str:
    spec = _spec(context, entry)
    head = {
        "mechanism": context.record.name,
        "figure": spec.number or None,
        "name": spec.name,
        "title": spec.title,
        "caption": spec.caption,
    }
    return json_text({**head, **made.data}) + "\n"
