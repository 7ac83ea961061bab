"""What acts on a mechanism: gravity, and a force and a moment on the platform at its point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Load:
    """A force (N) and a moment (N m), (..., 3) along the base's axes, on the platform at its point; and gravity."""

    force: FloatArray
    moment: FloatArray
    gravity: bool = True

    def wrench_at(self, points: FloatArray) -> FloatArray:
        """Moment, then force (N, 6) at the platform's points (N, 3), as twists have angular velocity first."""
        parts = [np.broadcast_to(part, points.shape) for part in (self.moment, self.force)]
        return np.concatenate(parts, axis=-1)

    def part(self, rows: NDArray[np.intp] | slice, count: int) -> Load:
        """At some of `count` configurations."""
        force, moment = (
            np.broadcast_to(own, (count, 3))[rows] if own.ndim > 1 else own for own in (self.force, self.moment)
        )
        return Load(force, moment, self.gravity)


def load_of(wrench: ArrayLike | None, gravity: bool = True) -> Load:
    """A load of a force (..., 3), or of force and moment (..., 6).

    Errors:
        UsageError: not 3 or 6 finite numbers.

    >>> load_of([0, 0, -100]).force.tolist()
    [0.0, 0.0, -100.0]
    """
    given = np.zeros(3) if wrench is None else np.asarray(wrench, dtype=float)
    if given.ndim == 0 or given.shape[-1] not in (3, 6) or not np.all(np.isfinite(given)):
        raise UsageError("load: not three or six finite numbers", hint="give FX, FY, FZ, or these and MX, MY, MZ")
    moment = given[..., 3:] if given.shape[-1] == 6 else np.zeros(3)
    return Load(given[..., :3], moment, gravity)
