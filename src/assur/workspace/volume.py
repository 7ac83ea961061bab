"""Volume with an error estimate: the same region at two resolutions.

With every vertex on the true surface the error is of order step^2, so halving the step divides it by
four and the difference of the two volumes is three times the error of the finer one. We report the
whole difference: a factor of three in hand for sharp corners and thin parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from assur.errors import UsageError
from assur.workspace.domain import Box
from assur.workspace.fields import Field
from assur.workspace.grid import grid_over
from assur.workspace.reach import Reach, reach


def at_two_resolutions(
    margins: Mapping[str, Field],
    factors: Mapping[str, Field],
    box: Box,
    resolution: int,
    tick: Callable[[], None] = lambda: None,
) -> tuple[Reach, Reach]:
    """The region at `resolution` cells along each coordinate, and at half of it; the difference tells the error.

    Example: the disc x^2 + y^2 <= 1 has the area 3.1416.

    >>> disc = {"disc": lambda pose: 1 - pose[0] ** 2 - pose[1] ** 2}
    >>> region, coarser = at_two_resolutions(disc, {}, Box(("x", "y"), (-2.0, -2.0), (2.0, 2.0)), 64)
    >>> round(region.volume, 3), round(abs(region.volume - coarser.volume), 3)
    (3.14, 0.007)
    """
    grid = grid_over(box, resolution)
    if resolution < 4:
        raise UsageError(f"resolution: {resolution} cells are too few; at least 4 along each coordinate")
    fine = reach(margins, factors, grid, tick)
    return fine, reach(margins, factors, grid_over(box, resolution // 2), tick, None if resolution % 2 else fine)
