"""What may stand as a value in a mechanism file: numbers, formulas, vectors, axes, names."""

from __future__ import annotations

import itertools
import keyword
import math
import re
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from assur.model.file.texts import long_name
from assur.model.formula import RESERVED, Formula, FormulaError, parse

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*'*")
AXES = {
    "x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1),
    "-x": (-1, 0, 0), "-y": (0, -1, 0), "-z": (0, 0, -1),
}  # fmt: skip
PLAIN_PATTERN = rf"^(?!(?:{'|'.join(RESERVED)})$)[A-Za-z_][A-Za-z0-9_]*$"
NAME_PATTERN = PLAIN_PATTERN.removesuffix("$") + "'*$"
LINK_PATTERN = NAME_PATTERN.removesuffix("$") + r"(\.[A-Za-z_][A-Za-z0-9_]*'*)?$"
LARGEST_NUMBER = 1e30
"""Moduli in Pa are the largest numbers that anybody writes, and far below it."""
DEFINITION = "definition"
"""Key by which a JSON Schema names one of its definitions until it is written."""

FREEDOMS = 6
"""Of a free body: rows of a compliance."""
COMMA = "write decimals with a point: 0.5, not 0,5"


def refuse(given: str, allowed: str, hint: str = "") -> PydanticCustomError:
    """An error of the form, in the words of a `Problem`."""
    return PydanticCustomError("form", "{found}", {"found": given, "allowed": allowed, "hint": hint})


def shown(value: object) -> str:
    """A value of the file as a message shows it: short, and as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _value(value: object) -> Formula:
    """A number or a formula in a string."""
    if isinstance(value, str):
        try:
            return parse(value)
        except FormulaError as error:
            place = f"{error.given} at character {error.position + 1}"
            raise refuse(f"{shown(value)} has {place}", f"expected {error.expected}", error.hint) from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise refuse(shown(value), 'allowed: a number, or a formula in quotes: 30, "l2/2", "62 deg"')
    if not _is_finite(value):
        raise refuse(shown(value), "allowed: a finite number")
    return parse(repr(value))


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond the floats
        return False


def _listed(count: int, what: str) -> BeforeValidator:
    def check(value: object) -> object:
        if not isinstance(value, list):
            raise refuse(shown(value), f"allowed: {what}")
        if len(value) != count:
            raise refuse(_written(value), f"allowed: {what}", COMMA if _split(value, count) else "")
        return value

    return BeforeValidator(check)


def _written(value: list[object]) -> str:
    """A list with what stands in it, where that is short."""
    text = f"[{', '.join(map(shown, value))}]"
    return f"{shown(value)}, {text}" if len(text) <= 60 else shown(value)


def _split(value: list[object], count: int) -> bool:
    """Whether commas of decimals may have made a list longer than it is meant: 0,5 is two whole numbers."""
    whole = [isinstance(part, int) and not isinstance(part, bool) for part in value]
    return count > 1 and len(value) > count and any(a and b for a, b in itertools.pairwise(whole))


def _axis(value: object) -> object:
    if isinstance(value, str):
        if value not in AXES:
            allowed = 'allowed: x, y, z, -x, -y, -z, or a vector such as ["0", "cos(30 deg)", "sin(30 deg)"]'
            raise refuse(shown(value), allowed)
        return list(AXES[value])
    return value


def _short(value: str) -> str:
    said = long_name(value)
    if said:
        raise refuse(*said)
    return value


def _name(value: str) -> str:
    _short(value)
    if not NAME.fullmatch(value) or value in RESERVED:
        what = "a reserved word" if value in RESERVED else "no name"
        allowed = "a name is a letter, then letters, digits, _ and primes"
        raise refuse(f"{shown(value)} is {what}", allowed, "the reader adds the dots in names such as leg1.B")
    return value


def _plain_name(value: str) -> str:
    if not _name(value).isidentifier() or keyword.iskeyword(value):
        raise refuse(f"{shown(value)} is no name", "allowed: a Python name: letters, digits and _")
    return value


def _components(value: object) -> object:
    """Home of a joint: a number, or a list with one for each freedom."""
    return value if isinstance(value, list) else [value]


def _mechanism_name(value: str) -> str:
    _short(value)
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]*", value):
        raise refuse(f"{shown(value)} is no name", "allowed: letters, digits, _ and -")
    return value


def _number(value: object) -> float:
    """A plain number, in SI units: no formula, whose parameters have the file's unit."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise refuse(shown(value), "allowed: a number, in SI units")
    if not _is_finite(value) or abs(value) > LARGEST_NUMBER:
        raise refuse(shown(value), f"allowed: a finite number up to {LARGEST_NUMBER:g}")
    return float(value)


def _compliance(value: object) -> object:
    """Six numbers, the diagonal, or six rows of six."""
    allowed = "allowed: six numbers, which are its diagonal, or six rows of six"
    if not isinstance(value, list):
        raise refuse(shown(value), allowed)
    if len(value) != FREEDOMS:
        raise refuse(_written(value), allowed, COMMA if _split(value, FREEDOMS) else "")
    rows = [row if isinstance(row, list) else [] for row in value]
    if not any(rows):
        diagonal = [_number(number) for number in value]
        return tuple(
            tuple(number if row == column else 0.0 for column in range(FREEDOMS)) for row, number in enumerate(diagonal)
        )
    for place, (row, own) in enumerate(zip(value, rows, strict=True), 1):
        if len(own) != FREEDOMS:
            raise refuse(f"row {place}: {_written(row) if isinstance(row, list) else shown(row)}", allowed)
    return tuple(tuple(_number(number) for number in row) for row in rows)


def bound_alone(value: object) -> object:
    """A bound, or a table that says more."""
    return value if isinstance(value, dict) else {"bound": value}


def _link_name(value: str) -> str:
    """A link, or one of a template's links in one of its limbs."""
    limb, dot, own = value.rpartition(".")
    return f"{_name(limb)}.{_name(own)}" if dot else _name(value)


def _format(value: object) -> object:
    if value != 1 or not isinstance(value, int) or isinstance(value, bool):
        raise refuse(shown(value), "allowed: 1, the format that this version reads")
    return value


def _sense(value: object) -> object:
    if value not in (1, -1) or not isinstance(value, int) or isinstance(value, bool):
        raise refuse(shown(value), "allowed: 1 or -1")
    return value


def _described(name: str) -> WithJsonSchema:
    """What stands here, for editors: a definition of `assur.model.file.json_schema`."""
    return WithJsonSchema({DEFINITION: name})


Value = Annotated[Formula, PlainValidator(_value), _described("value")]
Vector = Annotated[tuple[Value, Value, Value], _listed(3, "a list of three components"), _described("vector")]
Range = Annotated[tuple[Value, Value], _listed(2, "a list [low, high]"), _described("range")]
Axis = Annotated[Vector, BeforeValidator(_axis), _described("axis")]
TwoAxes = Annotated[tuple[Axis, Axis], _listed(2, "a list of two axes"), _described("two_axes")]
Name = Annotated[str, AfterValidator(_name), WithJsonSchema({"type": "string", "pattern": NAME_PATTERN})]
PlainName = Annotated[
    str,
    AfterValidator(_plain_name),
    WithJsonSchema({"type": "string", "pattern": PLAIN_PATTERN}),
]
HomeValue = Annotated[tuple[Value, ...], BeforeValidator(_components), _described("home_value")]
Sense = Annotated[int, PlainValidator(_sense), _described("sense")]
LinkName = Annotated[str, AfterValidator(_link_name), WithJsonSchema({"type": "string", "pattern": LINK_PATTERN})]
Number = Annotated[float, PlainValidator(_number), _described("number")]
TwoNumbers = Annotated[tuple[Number, Number], _listed(2, "a list of two numbers"), _described("two_numbers")]
Inertia = Annotated[
    tuple[Number, Number, Number, Number, Number, Number],
    _listed(6, "a list [xx, yy, zz, xy, xz, yz]"),
    _described("inertia"),
]
ComplianceRows = Annotated[tuple[tuple[float, ...], ...], PlainValidator(_compliance), _described("compliance")]
BarEnds = Annotated[tuple[str, str], _listed(2, "a list of two joints"), _described("bar_ends")]
ZERO = (parse("0"), parse("0"), parse("0"))
DOWN = (parse("0"), parse("0"), parse("-1"))
MechanismName = Annotated[str, AfterValidator(_mechanism_name), _described("mechanism_name")]
Format = Annotated[Any, PlainValidator(_format), _described("format")]
