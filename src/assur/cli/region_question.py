"""What `assur workspace` is asked: words of the command line, each checked, in lengths and rad."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from assur.cli.numbers import assignments, interval, number, parts, whole_number
from assur.cli.options import RegionOptions
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.answers.at_border import coordinate_unit, input_unit
from assur.mechanism import Mechanism
from assur.workspace.slices import coordinates, slice_at

Interval = tuple[float, float]


@dataclass(frozen=True)
class Question:
    """One workspace problem: lengths in the mechanism's unit, angles in rad."""

    mode: str
    box: dict[str, Interval]
    strokes: dict[str, Interval]
    resolution: int | None
    sections: tuple[float, ...] | None
    near: float | None
    held: dict[str, float] | None


def question(
    record: Mechanism,
    mode: str | None,
    where: RegionOptions,
    resolution: str | None = None,
    section: Sequence[str] = (),
    near: str | None = None,
) -> Question:
    """What was asked for, with every word checked."""
    held = _held(record, where.at)
    last = slice_at(record, held).free[-1]
    cuts = tuple(number(text, "--section") * coordinate_unit(record, last) for text in section)
    distance = None if near is None else number(near, "--near")
    if near is not None and distance is not None and distance <= 0:
        raise UsageError(f"--near: {near.strip()} is not a positive length")
    return Question(
        mode=mode or record.modes.default_working,
        box=_box(record, where.box),
        strokes=_strokes(record, where.stroke),
        resolution=None if resolution is None else whole_number(resolution, "--resolution"),
        sections=cuts or None,
        near=distance,
        held=held,
    )


def _box(record: Mechanism, texts: Sequence[str]) -> dict[str, Interval]:
    example = f"{record.platform.pose[0]}=-110:90"
    found = {}
    for name, text in assignments(texts, "--box", example).items():
        if name not in coordinates(record):
            raise UnknownNameError(f"pose coordinate of {record.name}", name, coordinates(record))
        found[name] = _scaled(interval(text, f"--box {name}", example), coordinate_unit(record, name))
    return found


def _held(record: Mechanism, texts: Sequence[str]) -> dict[str, float] | None:
    """What is held, None where nothing was said."""
    example = f"{record.platform.pose[-1]}=0"
    found = {
        name: number(text, f"--at {name}") * coordinate_unit(record, name)
        for name, text in assignments(texts, "--at", example).items()
    }
    return found or None


def _strokes(record: Mechanism, texts: Sequence[str]) -> dict[str, Interval]:
    """Strokes by input; one without a name is for every input that has none of its own."""
    units = {item.name: input_unit(record, item) for item in record.inputs}
    example = f"{record.inputs[0].name}=-300:300"
    given = parts(texts, "--stroke")
    common = [text for text in given if "=" not in text]
    if len(common) > 1:
        raise UsageError("--stroke: two intervals for all inputs", hint=f"name the input, as --stroke {example}")
    found = {}
    for text in common:
        pair = interval(text, "--stroke", example)
        found = {name: _scaled(pair, unit) for name, unit in units.items()}
    for name, text in assignments([text for text in given if "=" in text], "--stroke", example).items():
        if name not in units:
            raise UnknownNameError(f"input of {record.name}", name, units)
        found[name] = _scaled(interval(text, f"--stroke {name}", example), units[name])
    return found


def _scaled(pair: Interval, unit: float) -> Interval:
    return pair[0] * unit, pair[1] * unit
