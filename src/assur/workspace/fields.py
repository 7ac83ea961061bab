"""Fields: what a closed form says at every pose of a domain, in one working mode.

A margin must not be negative where the mode reaches a pose. Kernels are read over `Extended` numbers, so
that a margin runs smoothly past where a radicand inside it is negative; there another margin forbids the
pose anyway.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.modes import mode_signs, sign_names
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Branch
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Extended
from assur.workspace.bounds import Bound, Stroke, Values, bounds
from assur.workspace.grid import UniformGrid
from assur.workspace.slices import Columns, Slice, slice_at

FloatArray = NDArray[np.float64]
Field = Callable[[Columns], FloatArray]


def margin_fields(
    record: MechanismRecord,
    mode: str,
    strokes: Mapping[str, Stroke | None] | None = None,
    slice_: Slice | None = None,
) -> dict[str, Field]:
    """Every margin of a working mode over the free coordinates of a slice, those of strokes and limits included.

    Margins at whose zero the formulas merely degenerate forbid no open set of poses and are left out.

    >>> from assur.model.registry import load_record
    >>> fields = margin_fields(load_record("zeng2019"), "++-++", {"yA1": (-300, 300)})
    >>> list(fields)
    ['n_alpha', 'n_beta', 'M12', 'M3', 'yA1 >= -300', 'yA1 <= 300']
    >>> float(fields["M3"]((np.array(100.0), np.array(0.0), np.array(260.0))))
    52900.0
    """
    form = closed_form_of(record)
    branch = _branch(record, mode, slice_)
    fields: dict[str, Field] = {
        margin.name: partial(_margin, branch, margin.name) for margin in form.inverse_margins if margin.zero == "merge"
    }
    for name, bound in bounds(record, strokes).items():
        fields[name] = partial(_bound, record, branch, bound)
    return fields


def factor_fields(record: MechanismRecord, mode: str, slice_: Slice | None = None) -> dict[str, Field]:
    """Every factor of det Jp ("parallel") of a working mode as a function of the free coordinates of a slice."""
    branch = _branch(record, mode, slice_)
    names = [item.name for item in closed_form_of(record).factor_list if item.kind == "parallel"]
    return {name: partial(_factor, record, branch, name) for name in names}


def sample(field: Field, grid: UniformGrid) -> NDArray[np.float32]:
    """A field at every node of a grid, block by block; where it is not finite the pose is not allowed."""
    values = np.empty(grid.shape, dtype=np.float32)
    with np.errstate(over="ignore"):  # a pose so far away is not allowed either
        for part, columns in grid.blocks():
            values[part] = field(columns)
    allowed = np.isfinite(values)
    return values if bool(np.all(allowed)) else np.where(allowed, values, np.float32(-1.0))


def at_points(field: Field, dimension: int, points: FloatArray) -> FloatArray:
    """A field (N,) at points (N, 3) or (N, m), of which the first `dimension` coordinates are the pose."""
    found = field(tuple(points[:, k] for k in range(dimension)))
    return np.broadcast_to(found, (len(points),))


def _branch(record: MechanismRecord, mode: str, slice_: Slice | None) -> Callable[[Columns], Branch]:
    form, poses = closed_form_of(record), slice_ or slice_at(record)
    signs = map(float, mode_signs(record, "inverse", mode))
    sign = SimpleNamespace(**dict(zip(sign_names(record, "inverse"), signs, strict=True)))

    def evaluate(columns: Columns) -> Branch:
        with np.errstate(divide="ignore", invalid="ignore"):
            return form.inverse(Extended(), record.values, poses.components(columns), sign)

    return evaluate


def _margin(branch: Callable[[Columns], Branch], name: str, columns: Columns) -> FloatArray:
    return np.asarray(branch(columns).margins[name], dtype=float)


def _factor(record: MechanismRecord, branch: Callable[[Columns], Branch], name: str, columns: Columns) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        factors = closed_form_of(record).factors(Extended(), record.values, branch(columns).core)
    return np.asarray(factors[name], dtype=float)


def _bound(record: MechanismRecord, branch: Callable[[Columns], Branch], bound: Bound, columns: Columns) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        found = branch(columns)
        joints: Values = closed_form_of(record).joints(Extended(), record.values, found.core)
        return np.asarray(bound(joints), dtype=float)
