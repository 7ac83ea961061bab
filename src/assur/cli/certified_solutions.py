"""How a certified answer to a direct or an inverse problem reads, and what exit code it gives."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.options import MethodName, Outcome
from assur.cli.output import heading, table
from assur.cli.positions import exceeded, limits_cell
from assur.errors import UsageError
from assur.kinematics.answers.style import Style, given_words, style_of, texts_of, titles_of
from assur.kinematics.certified.certify import Way
from assur.kinematics.certified.result import CertifiedSolutions, answer, at_most
from assur.mechanism import Mechanism
from assur.model.pose import QUATERNION
from assur.results.answers.certified import CertifiedDirect, CertifiedInverse, ProvedPose
from assur.results.plain_text import short

CertifiedPositions = CertifiedDirect | CertifiedInverse

WAYS: dict[str, Way] = {"auto": "auto", "closed form": "closed form", "loops": "joint graph", "search": "boxes"}


def way_of(method: MethodName, mode: str | None, *, crossed: bool) -> Way:
    """The way to certify that the options ask for.

    Errors:
        UsageError: one mode alone, or crossed parallelograms, which no certificate knows.

    >>> way_of("search", None, crossed=False)
    'boxes'
    """
    if mode is not None:
        raise UsageError("--certify is about all modes together", hint="leave --mode out")
    if crossed:
        raise UsageError("--certify leaves crossed parallelograms out", hint="leave --crossed out")
    return WAYS[method]


def outcome(record: Mechanism, solutions: CertifiedSolutions) -> Outcome:
    """The outcome: exit code 4 where it is proved that there is no solution, 5 where something is undecided."""
    data = answer(solutions)
    code = exit_codes.of_answers(["open" if not solutions.proved else "yes" if len(solutions) else "no"])
    return Outcome(data, lambda: _shown(record, data, solutions.headline), code)


def _shown(record: Mechanism, data: CertifiedPositions, headline: str) -> Iterable[RenderableType]:
    style = style_of(record)
    yield heading(f"{data.mechanism}, {data.problem}: {headline}")
    yield f"at {given_words(record, style, data.given, direct=data.problem == 'direct')}"
    yield ""
    if data.solutions:
        yield _solutions(record, data, style)
        yield from exceeded(data)
        yield from _undetermined(style, data)
    if data.undecided:
        yield _undecided(data, style)
    yield from _right(record, data)
    if data.solutions:
        stated = "Limits are judged in floating point." if data.limits_stated else "No limits are stated."
        yield stated


def _solutions(record: Mechanism, data: CertifiedPositions, style: Style) -> RenderableType:
    """Middles of the bounds, rounded, and the largest width of the bounds, rounded up."""
    direct, hows = isinstance(data, CertifiedDirect), _hows(data)
    rows = []
    for item in data.solutions:
        free = item.undetermined if isinstance(item, ProvedPose) else ()
        pairs = list(zip(item.bounds.low, item.bounds.high, strict=True))
        values = texts_of(record, style, [0.5 * (low + high) for low, high in pairs], direct=direct)
        names = data.coordinates if direct else data.input_names
        values = [
            " .. ".join(dict.fromkeys(style.coordinate(name, end) for end in pair)) if name in free else text
            for name, pair, text in zip(names, pairs, values, strict=True)
        ]
        widths = [high - low for name, (low, high) in zip(names, pairs, strict=True) if name not in free]
        row = (item.mode, *values, at_most(max(widths, default=0.0)), item.other_mode, str(hows.index(item.how) + 1))
        rows.append((*row, *([limits_cell(item)] if data.limits_stated else [])))
    last = ("working" if direct else "assembly", "proof", *(["limits"] if data.limits_stated else []))
    return table(("mode", *titles_of(record, style, direct=direct), "width", *last), rows, left=("limits",))


def _hows(data: CertifiedPositions) -> list[str]:
    """By what solutions are proved, each way once."""
    return list(dict.fromkeys(item.how for item in data.solutions))


def _undetermined(style: Style, data: CertifiedPositions) -> Iterable[str]:
    """Why some coordinates are no numbers though the pose is proved."""
    proved = data.solutions if isinstance(data, CertifiedDirect) else ()
    names = {name for item in proved for name in item.undetermined}
    angles = [name for name in data.coordinates if name in names and name not in QUATERNION]
    if angles:
        right = style.number(90.0 if data.angle == "deg" else math.pi / 2, angle=True)
        yield (
            f"{' and '.join(angles)}: any, where theta may be {right} {data.angle} or its negative: both turn about"
            " one axis there, and only the two together say how the platform stands"
        )
    if names & set(QUATERNION):
        yield "qx, qy, qz: of either sign where qw may be 0, since q and -q are one orientation"


def _undecided(data: CertifiedPositions, style: Style) -> RenderableType:
    rows = []
    for item in data.undecided:
        if item.name == "pose":
            names = data.coordinates
            low, high = (
                "\n".join(f"{name} {style.coordinate(name, value)}" for name, value in zip(names, ends, strict=True))
                for ends in (item.low, item.high)
            )
        else:
            low, high = (short(ends[0]) for ends in (item.low, item.high))
        rows.append((item.name, low, high, item.unit, item.meaning, str(item.branches)))
    return table(
        ("undecided", "from", "to", "unit", "which is", "branches"), rows, left=("undecided", "unit", "which is")
    )


def _right(record: Mechanism, data: CertifiedPositions) -> Iterable[str]:
    yield from (f"proof {k}: {how}" for k, how in enumerate(_hows(data), 1))
    form = record.closed_form
    because = f" ({form.reduced_because})" if form is not None and form.reduced_because else ""
    model = f"the reduced model{because}" if data.complete_for == "reduced" else "the joint graph"
    if data.proved:
        yield f"Complete for {model}, by {data.right}."
    elif data.complete:
        yield f"Complete for {model} but for what is undecided, by {data.right}."
    else:
        yield f"Whether these are all is not proved: {data.right}."
