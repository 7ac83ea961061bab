"""The kinds of result: scalar, table, matrix, field, curve, surface. Analyses give them, outer layers render them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Scalar:
    """One number with its unit, and how it is known ("closed form", "error estimate 0.2 %", "exact")."""

    name: str
    value: float | None
    unit: str = ""
    known_by: str = ""


@dataclass(frozen=True)
class Table:
    """Rows under column titles; a cell is text, a number or None (does not exist)."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str | float | None, ...], ...]
    caption: str = ""
    marks: tuple[str, ...] = ()
    """Per row: "", "ok", "wrong" or "missing", for colour; never the only carrier of meaning."""


@dataclass(frozen=True, eq=False)
class Matrix:
    """A small matrix (r, k) with the names of its rows and columns."""

    name: str
    values: FloatArray
    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    unit: str = ""


@dataclass(frozen=True, eq=False)
class Field:
    """Values on a regular grid: axes by name, values with one index per axis; NaN where it does not exist."""

    name: str
    axes: tuple[tuple[str, FloatArray], ...]
    values: FloatArray
    unit: str = ""


@dataclass(frozen=True, eq=False)
class Curve:
    """A polyline (n, m) in named coordinates."""

    name: str
    coordinates: tuple[str, ...]
    points: FloatArray
    closed: bool = False
    unit: str = ""


@dataclass(frozen=True, eq=False)
class Surface:
    """A triangle mesh: vertices (n, 3) and faces (f, 3)."""

    name: str
    vertices: FloatArray
    faces: NDArray[np.int64]
    unit: str = ""


Result = Scalar | Table | Matrix | Field | Curve | Surface


@dataclass(frozen=True)
class Section:
    """A titled group of results and plain text, as an analysis hands it to a report."""

    title: str
    text: str = ""
    results: Sequence[Result] = field(default_factory=tuple)
    extra: dict[str, Any] = field(default_factory=dict)
