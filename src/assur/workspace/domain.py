"""The domain: a box of poses, one interval per coordinate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Box:
    """One interval low < high per pose coordinate, in the order of the pose.

    >>> Box(("x", "y"), (0.0, 1.0), (2.0, 4.0)).intervals
    [[0.0, 2.0], [1.0, 4.0]]
    """

    names: tuple[str, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]

    def __post_init__(self) -> None:
        for name, low, high in zip(self.names, self.low, self.high, strict=True):
            if not (np.isfinite(low) and np.isfinite(high)):
                raise UsageError(f"box: {name} = [{low}, {high}] is not finite")
            if not low < high:
                raise UsageError(f"box: {name} = [{low:g}, {high:g}] is turned round or empty", hint="give low < high")

    @property
    def intervals(self) -> list[list[float]]:
        """[[low, high], ...] as JSON takes it."""
        return [[low, high] for low, high in zip(self.low, self.high, strict=True)]

    def axis(self, name: str) -> int:
        """Place of a coordinate in the pose."""
        if name not in self.names:
            raise UnknownNameError("pose coordinate", name, self.names)
        return self.names.index(name)

    def spread(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Points (count, m) spread evenly: an additive lattice of the generalised golden ratio, shifted by chance.

        The shift makes a mean over the points unbiased, and different shifts independent of one another.
        """
        size = len(self.names)
        ratio = 2.0
        for _ in range(60):  # the positive root of g^(size + 1) = g + 1
            ratio = (1.0 + ratio) ** (1.0 / (size + 1))
        stride = ratio ** -np.arange(1.0, size + 1)
        unit = (rng.random(size) + np.arange(count)[:, None] * stride) % 1.0
        return self.low + unit * np.subtract(self.high, self.low)


def box_of(
    record: MechanismRecord,
    box: Mapping[str, Sequence[float]] | ArrayLike | None,
    names: tuple[str, ...] | None = None,
) -> Box:
    """The box that a user means: pairs in the order of `names` (by default the pose), or some of them by name.

    What is left out comes from the mechanism's file; `UsageError` where that has none either.

    >>> from assur.model.registry import load_record
    >>> box_of(load_record("zeng2019"), {"z": (200, 300)}).intervals
    [[-110.0, 90.0], [-250.0, 250.0], [200.0, 300.0]]
    """
    names = names or record.platform.pose
    if box is not None and not isinstance(box, Mapping):
        box = dict(zip(names, _pairs(names, box), strict=True))
    own = {name: pair for name, pair in record.box.items() if name in names}
    pairs: dict[str, Any] = {**own, **(box or {})}
    for name in pairs:
        if name not in names and name in record.platform.pose:
            raise UsageError(f"box: {name} is held", hint="let it vary, or give it no interval")
        if name not in names:
            raise UnknownNameError(f"pose coordinate of {record.name}", name, names)
    missing = [name for name in names if name not in pairs]
    if missing:
        raise UsageError(
            f"box: no interval for {', '.join(missing)}",
            hint=f"add {missing[0]} to [workspace] box in {record.file.name}",
        )
    limits = _pairs(names, [pairs[name] for name in names])
    return Box(names, tuple(limits[:, 0].tolist()), tuple(limits[:, 1].tolist()))


def _pairs(names: tuple[str, ...], box: ArrayLike) -> FloatArray:
    try:
        limits = np.asarray(box, dtype=float)
    except (TypeError, ValueError) as error:
        raise UsageError("box: not an array of numbers", hint=f"give (low, high) for {', '.join(names)}") from error
    if limits.shape != (len(names), 2):
        raise UsageError(f"box: shape {limits.shape}, ({len(names)}, 2) wanted: (low, high) for {', '.join(names)}")
    return limits
