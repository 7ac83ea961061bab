"""Directions in brackets: `[x]`, `[-y]`, `[0.5,0.866,0]`, `[x,y]`, `[x@A; 0,0.6,0.8]`, and back to text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace

from assur.topology.directions import DUST, NAMED, Vector, unit
from assur.topology.notation.errors import Source
from assur.topology.notation.syntax import WrittenDirection

_NAME = re.compile(r"([+-]?)\s*([xyzXYZ])")
_NUMBER = re.compile(r"([+-]?)\s*((?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)", re.ASCII)
_LABELS = re.compile(r"(.*?)((?:\s*@\s*[A-Z][a-z0-9]*'*)+)", re.ASCII)
_EXPECTED = "x, y, z, -x, -y, -z or three numbers"
_HINT = (
    "a direction is a name or three numbers with decimal points: [x], [0.5,0.866,0]; two of them: [x,y], [x; 0,0.6,0.8]"
)
_UNIT = 4e-15
_HUGE = 1e100


def read_directions(source: Source, text: str, start: int, end: int) -> tuple[WrittenDirection, ...]:
    """The directions written in text[start:end], what stands between a pair of brackets.

    Numbers are normalised; a vector whose length is one to its last digits stays as it is. Behind a direction, `x@A`,
    stand the labels of points that the axis runs through.

    Errors:
        NotationError: neither a name nor three numbers; the zero vector; a number that no float holds.
    """
    directions: list[WrittenDirection] = []
    numbers: list[tuple[float, int]] = []
    for written, at in _pieces(text, start, end):
        piece, labels = _labelled(written)
        name, number = _NAME.fullmatch(piece), _NUMBER.fullmatch(piece)
        if name and not numbers:
            directions.append(_named(name, at))
        elif number:
            numbers.append((_value(source, number, at), at))
        else:
            shown = f"'{piece}'" if piece else "nothing"
            raise source.error(at, shown, "a number" if numbers else _EXPECTED, _HINT)
        if len(numbers) == 3:
            directions.append(_vector(source, numbers, text[numbers[0][1] : at + len(piece)]))
            numbers = []
        if labels and numbers:
            raise source.error(at, f"a label behind {len(numbers)} of three numbers", "three numbers, then @A", _HINT)
        if labels:
            directions[-1] = replace(directions[-1], labels=labels)
    if numbers:
        count = len(numbers)
        raise source.error(numbers[0][1], "one number" if count == 1 else f"{count} numbers", "three", _HINT)
    return tuple(directions)


def direction(numbers: tuple[float, float, float]) -> Vector:
    """The unit vector along three numbers, not all zero; one of unit length stays, but for rounding dust.

    >>> direction((0.0, 3e200, 4e200))
    (0.0, 0.6, 0.8)
    """
    largest = max(map(abs, numbers))
    if abs(math.hypot(*numbers) - 1) < _UNIT:
        return _vector_of(0.0 if abs(part) < DUST else part for part in numbers)
    if not 1 / _HUGE < largest < _HUGE:
        return unit(part / largest for part in numbers)
    return unit(numbers)


def direction_text(vector: Vector) -> str:
    """The shortest text in brackets that reads back as this unit vector.

    >>> direction_text((0.0, -1.0, 0.0)), direction_text(unit((1, 2, 0))), direction_text((0.6, 0.0, 0.8))
    ('-y', '1,2,0', '0.6,0,0.8')
    """
    for name, axis in NAMED.items():
        for sign in ("", "-"):
            if vector == _signed(sign, axis):
                return sign + name
    sizes = [abs(part) for part in vector if part]
    for digits in range(17):
        for scale in (1.0, max(sizes), min(sizes)):
            rounded = _vector_of(round(part / scale, digits) for part in vector)
            if any(rounded) and direction(rounded) == vector:
                return _numbers_text(rounded)
    return _numbers_text(vector)


def _pieces(text: str, start: int, end: int) -> Iterator[tuple[str, int]]:
    """What stands between commas or semicolons, without the blanks around it, and where."""
    for match in re.compile(r"(?:^|[,;])\s*([^,;]*)").finditer(text[start:end]):
        yield match.group(1).rstrip(), start + match.start(1)


def _labelled(piece: str) -> tuple[str, tuple[str, ...]]:
    """What stands before labels, and the labels."""
    match = _LABELS.fullmatch(piece)
    return (match.group(1), tuple(match.group(2).replace(" ", "").split("@")[1:])) if match else (piece, ())


def _named(match: re.Match[str], at: int) -> WrittenDirection:
    return WrittenDirection(_signed(match.group(1), NAMED[match.group(2).lower()]), match.group(), at)


def _value(source: Source, match: re.Match[str], at: int) -> float:
    value = float(match.group(1) + match.group(2))
    if math.isinf(value):
        raise source.error(at, f"'{match.group()}'", "a number below 1.8e308")
    return value


def _vector(source: Source, numbers: list[tuple[float, int]], shown: str) -> WrittenDirection:
    x, y, z = (number for number, _ in numbers)
    at = numbers[0][1]
    if not (x or y or z):
        raise source.error(at, "the zero vector", "a direction", "one of the three numbers is not zero: [0,0,1]")
    return WrittenDirection(direction((x, y, z)), shown, at)


def _signed(sign: str, vector: Vector) -> Vector:
    return _vector_of(-part if sign == "-" and part else part for part in vector)


def _vector_of(parts: Iterator[float]) -> Vector:
    x, y, z = parts
    return (x, y, z)


def _numbers_text(vector: Vector) -> str:
    return ",".join(str(int(part)) if part == int(part) else repr(part) for part in vector)
