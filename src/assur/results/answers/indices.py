"""The answers of `assur indices`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from assur.results.answers.answer import Answer, AnswerOfMechanism, spread
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
class IndicesAnswer(NearestSingularity, AnswerOfMechanism):
    """Every index at one pose; one that does not exist is null."""

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
    """Mean and extremes of an index over a region.

    Attributes:
        mean: over the region, singular points left out; `mean_error` is half of its 95 % interval.
        least, most: at the points that were seen. What is worst lies a little beyond: `least_error`, `most_error` say
            how far, by the jackknife (7/8 of what the most extreme of the eight shifts is beyond the next).
        least_at, most_at: the poses there.
    """

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
class OverallAnswer(AnswerOfMechanism):
    """Means and extremes of every index over a workspace."""

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


@dataclass(frozen=True, eq=False)
class MapAnswer:
    """One index over a grid.

    Attributes:
        symbol, meaning, unit: of the index; the symbol in LaTeX, "" as the unit of a number.
        values: one axis per coordinate; NaN where it does not exist, in an answer nested lists with null. A distance is
            infinite where none was found within the reach of the search.
        mean: of the nodes at which it exists and is finite, all with the same weight; None where there is none.
        least, most: among them; None where there is none. `assur.performance.overall` adds errors, over a whole region.
    """

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
