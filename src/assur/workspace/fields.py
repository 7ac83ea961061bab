"""Fields: what a closed form says at every pose of a domain, in one working mode.

A margin must not be negative where the mode reaches a pose. Kernels are read over `Extended` numbers, so
that a margin runs smoothly past where a radicand inside it is negative; there another margin forbids the
pose anyway. The fields of a mode are columns of one reading: several at the same poses read the kernel once.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closed_form.mode_reading import ModeReading, mode_reading
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Extended
from assur.workspace.bounds import Bound, Stroke, bounds
from assur.workspace.grid import UniformGrid
from assur.workspace.slices import Columns, Slice, slice_at

FloatArray = NDArray[np.float64]
Field = Callable[[Columns], FloatArray]
Key = TypeVar("Key", bound=Hashable)


@dataclass(frozen=True, eq=False)
class Column:
    """One column of the readings of a mode: a field.

    Attributes:
        read: the mode at poses of a slice; the same one for all fields of a mode.
        of: the column of a reading.
    """

    read: Callable[[Columns], ModeReading]
    of: Callable[[ModeReading], FloatArray]

    def __call__(self, columns: Columns) -> FloatArray:
        """The field at poses whose coordinates broadcast."""
        return self.of(self.read(columns))


def closed_form_fields(
    record: MechanismRecord,
    mode: str,
    strokes: Mapping[str, Stroke | None] | None = None,
    slice_: Slice | None = None,
    kinds: Sequence[str] = ("parallel",),
) -> tuple[dict[str, Field], dict[str, Field]]:
    """Every margin and every factor of some kinds of a working mode over the free coordinates of a slice.

    Those of det Jp are "parallel", those of det Jq "serial".

    The margins of strokes and limits are among them. Those at whose zero the formulas merely degenerate forbid no open
    set of poses and are left out. All are columns of the same readings.

    >>> from assur.model.registry import load_record
    >>> margins, factors = closed_form_fields(load_record("zeng2019"), "++-++", {"yA1": (-300, 300)})
    >>> list(margins)
    ['n_alpha', 'n_beta', 'M12', 'M3', 'yA1 >= -300', 'yA1 <= 300']
    >>> float(margins["M3"]((np.array(100.0), np.array(0.0), np.array(260.0))))
    52900.0
    """
    form, poses = closed_form_of(record), slice_ or slice_at(record)

    def read(columns: Columns) -> ModeReading:
        return mode_reading(record, mode, poses.components(columns), Extended())

    margins: dict[str, Field] = {
        item.name: Column(read, partial(_margin, item.name)) for item in form.inverse_margins if item.zero == "merge"
    }
    margins |= {name: Column(read, partial(_bound, bound)) for name, bound in bounds(record, strokes).items()}
    names = [item.name for item in form.factor_list if item.kind in kinds]
    return margins, {name: Column(read, partial(_factor, name)) for name in names}


def values_at(fields: Mapping[Key, Field], columns: Columns) -> dict[Key, FloatArray]:
    """Several fields at poses whose coordinates broadcast; what several are columns of is read once."""
    readings: dict[Callable[[Columns], ModeReading], ModeReading] = {}
    values = {}
    for name, field in fields.items():
        if isinstance(field, Column):
            if field.read not in readings:
                readings[field.read] = field.read(columns)
            values[name] = field.of(readings[field.read])
        else:
            values[name] = field(columns)
    return values


def samples(
    fields: Mapping[Key, Field], grid: UniformGrid, finer: Mapping[Key, NDArray[np.float32]] | None = None
) -> dict[Key, NDArray[np.float32]]:
    """Fields at every node of a grid, block by block; where one is not finite the pose is not allowed.

    `finer` is what they are at the nodes of a grid of twice as many cells: only the outermost are read then.
    """
    answer = {name: np.empty(grid.shape, dtype=np.float32) for name in fields}
    read = np.ones(grid.shape, dtype=bool)
    for name in finer or {}:
        inner, every_other = (tuple(slice(1, -1, step) for _ in grid.cells) for step in (1, 2))
        read[inner] = False
        answer[name][inner] = (finer or {})[name][every_other]
    with np.errstate(over="ignore"):  # a pose so far away is not allowed either
        for part, columns in grid.blocks() if finer is None else [(read, grid.columns(np.argwhere(read)))]:
            for name, values in values_at(fields, columns).items():
                answer[name][part] = values
    for at_nodes in answer.values():
        at_nodes[~np.isfinite(at_nodes)] = -1.0
    return answer


def sample(field: Field, grid: UniformGrid) -> NDArray[np.float32]:
    """One field at every node of a grid, as `samples`."""
    return samples({"": field}, grid)[""]


def at_points(field: Field, dimension: int, points: FloatArray) -> FloatArray:
    """A field (N,) at points (N, 3) or (N, m), of which the first `dimension` coordinates are the pose."""
    return np.broadcast_to(field(tuple(points[:, k] for k in range(dimension))), (len(points),))


def inside_at(margins: Mapping[str, Field], points: FloatArray) -> NDArray[np.bool_]:
    """Whether no margin is negative (N,) at points (N, free coordinates)."""
    inside = np.ones(len(points), dtype=bool)
    for values in values_at(margins, tuple(points.T)).values():
        inside &= values >= 0
    return inside


def none_negative(margins: Mapping[str, Field], read: ModeReading) -> NDArray[np.bool_]:
    """Whether no margin of a closed form is negative at the poses of a reading, over whichever number type.

    In floats an inner radicand that is negative counts as 0, but it is a margin itself, so that nothing changes here.
    """
    inside = np.asarray(True)
    for field in margins.values():
        if isinstance(field, Column):
            inside = inside & (field.of(read) >= 0)
    return np.asarray(inside)


def _margin(name: str, read: ModeReading) -> FloatArray:
    return np.asarray(read.margins[name], dtype=float)


def _factor(name: str, read: ModeReading) -> FloatArray:
    return np.asarray(read.factors[name], dtype=float)


def _bound(bound: Bound, read: ModeReading) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(bound(read.joints), dtype=float)
