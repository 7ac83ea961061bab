"""The letters of a closed form: of given numbers, results and quantities of `core`, with what they stand for."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from assur.report.formulas.latex import name_mathml, symbol_mathml
from assur.report.formulas.trace import POINTS, Letter, Traced

Number = Any
"""Of a kernel: a recorded number, a plain one, the pair (cosine, sine) of an angle, or tuples of these."""

Named = tuple[Letter, Traced]


def letters_of(name: str, latex: str, angle: bool) -> tuple[Letter, ...]:
    """The letter of a length, or cosine and sine of that of an angle."""
    mathml = symbol_mathml(latex, name)
    return (Letter(name, mathml, "cos"), Letter(name, mathml, "sin")) if angle else (Letter(name, mathml),)


def core_letters(name: str, places: tuple[int, ...], value: Number) -> list[Named]:
    """Letters of a quantity of `core`: what is in a namespace by its own name, what is in a tuple by its places."""
    if isinstance(value, SimpleNamespace):
        return [named for key, part in vars(value).items() for named in core_letters(key, places, part)]
    if isinstance(value, Traced):
        return [(_placed(name, places), value)]
    if not isinstance(value, tuple | list) or is_rotation(value):
        return []
    if _is_angle(value):
        letter = _placed(name, places)
        cosine, sine = value
        return [
            (Letter(letter.name, letter.mathml, "cos"), cosine),
            (Letter(letter.name, letter.mathml, "sin"), sine),
        ]
    return [named for k, part in enumerate(value, 1) for named in core_letters(name, (*places, k), part)]


def _placed(name: str, places: tuple[int, ...]) -> Letter:
    """A letter with the places that it has in tuples as a further index."""
    if not places:
        return Letter(name, name_mathml(name))
    index = "<mo>,</mo>".join(f"<mn>{place}</mn>" for place in places)
    below = f"<mrow>{index}</mrow>" if len(places) > 1 else index
    return Letter("_".join([name, *map(str, places)]), f"<msub>{name_mathml(name)}{below}</msub>")


def _is_angle(value: Sequence[Number]) -> bool:
    """Whether two numbers are the cosine and the sine of an angle."""
    if len(value) != 2 or not all(isinstance(part, Traced) for part in value):
        return False
    cosine, sine = value[0].values, value[1].values
    return bool(np.allclose(cosine * cosine + sine * sine, 1.0, rtol=0, atol=1e-9))


def margin_letter(name: str) -> Letter:
    """The letter of a margin."""
    return Letter(name, name_mathml(name))


def parts_of(value: Number) -> tuple[Traced, ...]:
    """The recorded numbers in a value."""
    if isinstance(value, tuple | list):
        return tuple(part for element in value for part in parts_of(element))
    return (value,) if isinstance(value, Traced) else ()


def is_rotation(value: Number) -> bool:
    """Whether a value is the matrix of a rotation, whose entries are no letters and no results."""
    if not isinstance(value, tuple | list) or len(value) != 3:
        return False
    if not all(isinstance(row, tuple | list) and len(row) == 3 for row in value):
        return False
    rows = np.array([[np.broadcast_to(_value(entry), (POINTS,)) for entry in row] for row in value])
    return bool(np.allclose(np.einsum("ikp,jkp->ijp", rows, rows), np.eye(3)[..., None], rtol=0, atol=1e-9))


def _value(entry: Number) -> Any:
    return entry.values if isinstance(entry, Traced) else entry


def varies(part: Number) -> bool:
    """Whether a number is recorded and depends on what is given; 1/2 needs no letter."""
    return isinstance(part, Traced) and bool(np.ptp(part.values.real) + np.ptp(part.values.imag) > 0)
