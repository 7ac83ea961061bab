"""How a certified answer to a direct or an inverse problem reads, and what exit code it gives."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from assur.cli import exit_codes
from assur.cli.options import MethodName, Outcome
from assur.cli.output import heading, table
from assur.cli.positions import exceeded, limits_cell
from assur.cli.quantities import QUATERNION, Style, pose_text, short, style_of
from assur.errors import UsageError

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.kinematics.certified.certify import Way
    from assur.kinematics.certified.result import CertifiedSolutions
    from assur.mechanism import Mechanism

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


def outcome(record: Mechanism, found: CertifiedSolutions) -> Outcome:
    """The outcome: exit code 4 where it is proved that there is no solution, 5 where something is undecided."""
    from assur.kinematics.certified.result import answer

    data = answer(found)
    code = exit_codes.of_answers(["open" if not found.proved else "yes" if len(found) else "no"])
    return Outcome(data, lambda: _shown(record, data, found.headline), code)


def _shown(record: Mechanism, data: dict[str, Any], headline: str) -> Iterable[RenderableType]:
    style = style_of(record)
    problem = "direct" if "inputs" in data else "inverse"
    yield heading(f"{data['mechanism']}, {problem}: {headline}")
    yield _given(record, data, style)
    yield ""
    if data["solutions"]:
        yield _solutions(record, data, style)
        yield from exceeded(data)
        yield from _undetermined(style, data)
    if data["undecided"]:
        yield _undecided(data, style)
    yield from _right(record, data)
    if data["solutions"]:
        stated = "Limits are judged in floating point." if data["limits_stated"] else "No limits are stated."
        yield stated


def _given(record: Mechanism, data: dict[str, Any], style: Style) -> str:
    if "pose" in data:
        return f"at {pose_text(style, data['coordinates'], data['pose'])}"
    kinds = [item.coordinate.kind for item in record.inputs]
    given = zip(data["input_names"], kinds, data["inputs"], strict=True)
    return (
        f"at {', '.join(f'{name} = {style.kind(kind, value)} {style.kind_unit(kind)}' for name, kind, value in given)}"
    )


def _solutions(record: Mechanism, data: dict[str, Any], style: Style) -> RenderableType:
    """Middles of the bounds, rounded, and the largest width of the bounds, rounded up."""
    from assur.kinematics.certified.result import at_most

    direct = "inputs" in data
    if direct:
        titles = [style.coordinate_title(name) for name in data["coordinates"]]
    else:
        kinds = [item.coordinate.kind for item in record.inputs]
        titles = [f"{name} [{style.kind_unit(kind)}]" for name, kind in zip(data["input_names"], kinds, strict=True)]
    other = "working_mode" if direct else "assembly_mode"
    told = data["limits_stated"]
    rows, hows = [], list(dict.fromkeys(item["how"] for item in data["solutions"]))
    for item in data["solutions"]:
        bounds = item["pose" if direct else "inputs"]
        pairs = list(zip(bounds["low"], bounds["high"], strict=True))
        middles = [0.5 * (low + high) for low, high in pairs]
        if direct:
            values = [
                _range(style, name, pair) if name in item["undetermined"] else style.coordinate(name, middle)
                for name, pair, middle in zip(data["coordinates"], pairs, middles, strict=True)
            ]
            told = [name not in item["undetermined"] for name in data["coordinates"]]
        else:
            values = [style.kind(*pair) for pair in zip(kinds, middles, strict=True)]
            told = [True] * len(pairs)
        width = max((high - low for (low, high), known in zip(pairs, told, strict=True) if known), default=0.0)
        row = (item["mode"], *values, at_most(width), item[other], str(hows.index(item["how"]) + 1))
        rows.append((*row, *([limits_cell(item)] if told else [])))
    columns = ("mode", *titles, "width", other.partition("_")[0], "proof", *(["limits"] if told else []))
    return table(columns, rows, left=("limits",))


def _range(style: Style, name: str, pair: tuple[float, float]) -> str:
    return " .. ".join(dict.fromkeys(style.coordinate(name, end) for end in pair))


def _undetermined(style: Style, data: dict[str, Any]) -> Iterable[str]:
    """Why some coordinates are no numbers though the pose is proved."""
    names = {name for item in data["solutions"] for name in item.get("undetermined", ())}
    angles = [name for name in data["coordinates"] if name in names and name not in QUATERNION]
    if angles:
        right = style.degrees(90.0 if data["angle"] == "deg" else math.pi / 2)
        yield (
            f"{' and '.join(angles)}: any, where theta may be {right} {data['angle']} or its negative: both turn about"
            " one axis there, and only the two together say how the platform stands"
        )
    if names & set(QUATERNION):
        yield "qx, qy, qz: of either sign where qw may be 0, since q and -q are one orientation"


def _undecided(data: dict[str, Any], style: Style) -> RenderableType:
    rows = []
    for item in data["undecided"]:
        if item["name"] == "pose":
            names = data["coordinates"]
            low, high = (
                "\n".join(f"{name} {style.coordinate(name, value)}" for name, value in zip(names, ends, strict=True))
                for ends in (item["low"], item["high"])
            )
        else:
            low, high = (short(item[end][0]) for end in ("low", "high"))
        rows.append((item["name"], low, high, item["unit"], item["meaning"], str(item["branches"])))
    return table(
        ("undecided", "from", "to", "unit", "which is", "branches"), rows, left=("undecided", "unit", "which is")
    )


def _right(record: Mechanism, data: dict[str, Any]) -> Iterable[str]:
    hows = list(dict.fromkeys(item["how"] for item in data["solutions"]))
    yield from (f"proof {k}: {how}" for k, how in enumerate(hows, 1))
    form = record.closed_form
    because = f" ({form.reduced_because})" if form is not None and form.reduced_because else ""
    model = f"the reduced model{because}" if data["complete_for"] == "reduced" else "the joint graph"
    if data["proved"]:
        yield f"Complete for {model}, by {data['right']}."
    elif data["complete"]:
        yield f"Complete for {model} but for what is undecided, by {data['right']}."
    else:
        yield f"Whether these are all is not proved: {data['right']}."
