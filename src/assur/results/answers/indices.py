"""The answers of `assur indices`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from assur.results.answers.answer import Answer, spread
from assur.results.answers.position import NegativeQuantity

Lacking = Sequence[float | None]
"""Numbers, null where one does not exist."""


@dataclass(frozen=True)
class NearestSingularity:
    """The distance from the nearest parallel singularity, of a factor, at a pose; null where none was found in reach.

    `distance_reach` is null where it was not looked for.
    """

    distance: float | None
    nearest_factor: str | None
    nearest: Lacking | None
    distance_reach: float | None


@dataclass(frozen=True)
class IndicesAnswer(NearestSingularity, Answer):
    """Every index at one pose; one that does not exist is null."""

    mechanism: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]
    pose: Lacking
    mode: str
    input_names: tuple[str, ...]
    status: str
    characteristic_length: float | None
    velocity_factor_unit: str
    velocity_factors: Lacking
    input_transmission_indices: Lacking
    output_transmission_indices: Lacking
    condition_number: float | None
    failures: tuple[NegativeQuantity, ...]
    home_by: str
    known_modes: tuple[str, ...]
    indices: Mapping[str, float | None] = spread()


@dataclass(frozen=True)
class OverallIndex:
    """Mean and extremes of an index over a workspace, with errors, and the poses of the extremes."""

    mean: float
    mean_error: float
    least: float
    least_error: float
    least_at: Lacking
    most: float
    most_error: float
    most_at: Lacking


@dataclass(frozen=True)
class Share:
    """A part of a region: its share with half of the 95 % interval, and its volume with the error of both."""

    share: float
    share_error: float
    volume: float
    volume_error: float
    unit: str


@dataclass(frozen=True)
class OverallAnswer(Answer):
    """Means and extremes of every index over a workspace."""

    mechanism: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]
    mode: str
    points: int
    singular: int
    characteristic_length: float | None
    velocity_factor_unit: str
    good_from: float
    good_transmission: Share | None
    indices: Mapping[str, OverallIndex]
    held: Mapping[str, float]
    volume: float
    volume_error: float
    volume_unit: str


@dataclass(frozen=True)
class MapExtreme:
    """A value, and the coordinates of where it is."""

    value: float
    at: tuple[float, ...]


@dataclass(frozen=True)
class MapAnswer:
    """One index at the nodes of a grid, nested lists with one index per axis; null where it does not exist."""

    symbol: str
    meaning: str
    unit: str
    values: Any
    mean: float | None
    least: MapExtreme | None
    most: MapExtreme | None


@dataclass(frozen=True)
class MapsAnswer(Answer):
    """Every index over some coordinates, the others held; `status` and `nearest_factor` at the nodes as `values`."""

    mechanism: str
    mode: str
    how: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]
    axes: Mapping[str, tuple[float, ...]]
    held: Mapping[str, float]
    characteristic_length: float | None
    reach: float | None
    status: Any
    nearest_factor: Any
    maps: Mapping[str, MapAnswer]
