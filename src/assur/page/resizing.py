"""Dimensions that a page can change: the joint graph's numbers as JavaScript of the file's own formulas."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from graphlib import TopologicalSorter
from itertools import chain
from typing import Any

from assur.errors import UsageError
from assur.joint_graph.geometry import Geometry, characteristic_length, geometry, written_geometry
from assur.joint_graph.graph_program import dimensions
from assur.model.dimensions import with_parameters
from assur.model.file.parameters import parameter_formulas
from assur.model.kernel_dimensions import angle_components
from assur.model.mechanism import MechanismRecord, Parameter
from assur.model.written import NumberReading
from assur.page.expression import FUNCTIONS, Expression, text_of
from assur.scene.letters import PlacedLetter

SHARE = 0.5
"""Of its value, to either side: what the slider of a length covers; of the characteristic length where it is zero."""

SWING = math.radians(30.0)
"""What that of an angle covers, to either side."""

GOLDEN = 0.6180339887498949
"""Whose multiples, without their whole parts, are never equal."""

APART = 0.01
"""Share by which dimensions are moved apart, so that two that are equal by chance are told from two that always are."""


@lru_cache(maxsize=16)
def general(record: MechanismRecord) -> MechanismRecord:
    """A mechanism of the same structure whose dimensions are equal, 0 or 1 only where its formulas make them so.

    The mechanism itself where its dimensions cannot be changed, as where they were not read from a file.

    >>> from assur.model.registry import load_record
    >>> general(load_record("fivebar")).values.l1 == load_record("fivebar").values.l1
    False
    """
    moved = {
        name: own.value * (1.0 + _apart(k)) if own.value else _apart(k) * _size(record, own)
        for k, (name, own) in enumerate(_free(record).items())
    }
    try:
        return with_parameters(record, **moved) if moved else record
    except UsageError:
        return record


def general_dimensions(record: MechanismRecord) -> list[float]:
    """The numbers of a mechanism that the program of its `general` one is given."""
    places = dict(zip(_numbers(geometry(general(record))), _numbers(geometry(record)), strict=True))
    return [float(places[number]) for number in dimensions(general(record))]


def resizing(record: MechanismRecord, letters: Sequence[PlacedLetter]) -> dict[str, Any]:
    """The dimensions with a slider, and the program that works out what depends on them.

    `sizes`: name, unit ("" of a pure number), value and range in lengths and rad; none where the file's dimensions
    cannot be changed. `resize`: `function (g)` of their values, which returns `dimensions` as the configuration's
    program takes them, `at` and `childAt` of all joints, `letters`, and `kernel`, dimensions as a closed form takes
    them. `sizesFixed`: dimensions that pitches, strokes or limits of the file depend on, which stay as they are.

    >>> from assur.model.registry import load_record
    >>> found = resizing(load_record("fivebar"), ())
    >>> [item["name"] for item in found["sizes"]], found["resize"].partition("{")[0]
    (['g', 'l1', 'l2'], 'function (g) ')
    """
    free = {} if general(record) is record else _free(record)
    changing = {name: own for name, own in free.items() if _moves(record, own)}
    fixed = [name for name, own in changing.items() if _bounds(_moved(record, own)) != _bounds(record)]
    sizes = [_slider(record, own) for name, own in changing.items() if name not in fixed]
    program = _program(record, [size["name"] for size in sizes], letters) if sizes else None
    return {"sizes": sizes, "resize": program, "sizesFixed": fixed}


def _free(record: MechanismRecord) -> dict[str, Parameter]:
    """The dimensions that are no formula of others, and more than drawn."""
    formulas = parameter_formulas(record)
    return {
        name: own
        for name, own in record.parameters.items()
        if name in formulas and not formulas[name].names and not own.drawn_only
    }


def _apart(k: int) -> float:
    return APART * (1.0 + (k * GOLDEN) % 1.0)


def _size(record: MechanismRecord, own: Parameter) -> float:
    return characteristic_length(record) if own.unit == record.unit else 1.0


def _moved(record: MechanismRecord, own: Parameter) -> MechanismRecord:
    return with_parameters(record, **{own.name: own.value + APART * (abs(own.value) or _size(record, own))})


def _moves(record: MechanismRecord, own: Parameter) -> bool:
    """Whether a dimension is one of the joint graph."""
    try:
        other = _moved(record, own)
    except UsageError:
        return False
    return list(_numbers(geometry(other))) != list(_numbers(geometry(record)))


def _bounds(record: MechanismRecord) -> list[Any]:
    """What a page does not work out anew: strokes and what inputs are counted from, pitches, limits of joints."""
    inputs = [(item.stroke, item.sign, item.offset) for item in record.inputs]
    cones = [(own.cone, own.cone_axis is not None and own.cone_axis.tolist()) for own in record.joints.values()]
    return [*inputs, *cones, *((own.pitch, own.limits) for own in record.joints.values())]


def _slider(record: MechanismRecord, own: Parameter) -> dict[str, Any]:
    half = SWING if own.angular else SHARE * (abs(own.inside) or _size(record, own))
    low = 0.0 if own.sign != "any" and own.inside < half else own.inside - half
    unit = own.unit if own.angular or own.unit == record.unit else ""
    return {"name": own.name, "unit": unit, "value": own.inside, "range": [low, own.inside + half]}


def _program(record: MechanismRecord, free: Sequence[str], letters: Sequence[PlacedLetter]) -> str:
    names: dict[str, Any] = {}
    reading = NumberReading(names, FUNCTIONS, float)
    formulas = parameter_formulas(record)
    lines = []
    for k, name in enumerate(TopologicalSorter({name: formulas[name].names for name in formulas}).static_order()):
        text = f"g[{free.index(name)}]" if name in free else text_of(reading.value(formulas[name]))
        lines.append(f"const p{k}={text};")
        names[name] = Expression(f"p{k}")
    written = written_geometry(record, reading)
    numbers = dict(zip(_numbers(geometry(general(record))), _numbers(written), strict=True))
    parts = {
        "dimensions": _row(numbers[number] for number in dimensions(general(record))),
        "at": _rows(own.at for own in written.joints.values()),
        "childAt": _rows(own.child_at for own in written.joints.values()),
        "letters": _rows(_letter(record, written, item, reading) for item in letters),
        "kernel": f"{{{','.join(_kernel(record, names))}}}",
    }
    answer = ",".join(f"{name}:{text}" for name, text in parts.items())
    return f"function (g) {{\n{''.join(lines)}\nreturn {{{answer}}};\n}}"


def _kernel(record: MechanismRecord, names: dict[str, Expression]) -> Iterator[str]:
    for name, own in names.items():
        if record.parameters[name].angular:
            for part, function in zip(angle_components(name), ("cos", "sin"), strict=True):
                yield f'"{part}":Math.{function}({own.text})'
        else:
            yield f'"{name}":{own.text}'


def _letter(record: MechanismRecord, written: Geometry, letter: PlacedLetter, reading: NumberReading) -> Sequence[Any]:
    if letter.name not in record.points:
        return written.joints[letter.name].at
    own = record.points[letter.name].written
    return own.vector(reading) if own else letter.at.tolist()


def _numbers(dimensions: Geometry) -> Iterator[Any]:
    """All numbers; the characteristic length comes first, as it has no formula and may be equal to another one."""
    yield dimensions.length
    for own in dimensions.joints.values():
        yield from chain(*own.turn, *own.axes, own.at, own.child_at, (own.advance,))
    yield from dimensions.platform


def _row(numbers: Iterable[Any]) -> str:
    return f"[{','.join(map(text_of, numbers))}]"


def _rows(vectors: Iterable[Iterable[Any]]) -> str:
    return f"[{','.join(map(_row, vectors))}]"
