"""Stored sweeps: the solutions of all problems of a grid as files hold them, NaN where there is none, with a status.

Here a sweep is checked and made; `grid_sweep.py` has its files. In closed form both problems are swept, in one mode or
in all of them, and a status is that of the answer to the single problem (`closed_form_sweep.py`). Without one home's
mode is followed (`home_sweep.py`).
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.closed_form_sweep import ClosedFormSweep
from assur.kinematics.closed_form.grid_sweep import ALL, GridSweep
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.home_sweep import HOME, HomeSweep
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem, mode_signs
from assur.kinematics.naming import mode_names
from assur.kinematics.position import renamed
from assur.kinematics.status import branch_kernel
from assur.model.mechanism import MechanismRecord

ONE_MODE = ("inputs", "exists", "status", "det_jp", "det_jq", "factors", "condition_index", "smallest")
"""What can be kept of the inverse problem in one mode."""


def quantities(problem: Problem, mode: str) -> tuple[str, ...]:
    """What can be kept: of the inverse problem in one mode also what its Jacobians say.

    >>> quantities("direct", "+++")
    ('poses', 'exists', 'status')
    """
    if problem == "direct":
        return ("poses", "exists", "status")
    return ONE_MODE[:3] if mode == ALL else ONE_MODE


def stored_sweep(
    record: MechanismRecord, problem: Problem, grid: Grid, mode: str = "", keep: Sequence[str] = ()
) -> GridSweep:
    """A sweep into files, checked.

    Args:
        record: a mechanism; of the direct problem one with a closed form by signs, or without any.
        problem: "inverse", the grid is one of poses, or "direct", of inputs as printed.
        grid: the problems; every coordinate of a pose, or every input, in the file's order; angles in rad. Before them
            may come dimensions, in the units of the file.
        mode: a mode, or "all"; where empty the file's default working mode, for the direct problem all. Without a
            closed form there is home's alone.
        keep: of `quantities`; where empty the solutions with their status, for the direct problem with `exists`.

    Errors:
        UsageError: a direct problem with a closed form that is not by signs; without any, another mode than home's.
        UnknownNameError: an unknown mode, quantity or dimension.

    Example: the inverse problem along a line, kept for good.

        >>> import tempfile
        >>> from pathlib import Path
        >>> from assur.model.registry import load_record
        >>> grid = Grid(("x", "y", "z"), (-15.0, 9.0, 300.0), (-15.0, 9.0, 600.0), (1, 1, 4))
        >>> sweep = stored_sweep(load_record("zeng2019"), "inverse", grid)
        >>> with tempfile.TemporaryDirectory() as folder, sweep.store(Path(folder)) as store:
        ...     faults = store.open()
        ...     sweep.fill(store)
        ...     found = store.finish()
        ...     found["inputs"].shape, found["status"].tolist(), store.counts["status"]
        ((3, 4), [0, 0, 8, 8], {'regular': 2, 'unreachable': 2})
    """
    if problem == "direct" and record.closed_form is not None:
        try:
            branch_kernel(record)
        except UsageError as error:
            hint = "`assur direct` solves one problem at a time, Mechanism.direct takes arrays"
            raise UsageError(error.message, hint=hint) from error
    names = record.platform.pose if problem == "inverse" else border.input_names(record)
    first = max(len(grid.names) - len(names), 0)
    if grid.names[first:] != names:
        raise UsageError(f"a grid of {', '.join(grid.names)}", hint=f"{record.name} is swept over {', '.join(names)}")
    for name in grid.names[:first]:
        if name not in record.parameters:
            raise UnknownNameError(f"dimension of {record.name}", name, record.parameters)
    if record.closed_form is None:
        kind: type[GridSweep] = HomeSweep
        mode = _home(record, problem, mode)
        allowed = quantities(problem, ALL)
    else:
        kind = ClosedFormSweep
        mode = mode or (record.modes.default_working if problem == "inverse" else ALL)
        if mode != ALL:
            mode_signs(record, problem, mode)
        allowed = quantities(problem, mode)
    for name in keep:
        if name not in allowed:
            also = "only the inverse problem in one mode, in closed form, has this" if name in ONE_MODE[3:] else ""
            raise UnknownNameError(f"quantity of the {problem} problem", name, allowed, hint=also)
    usual = ("inputs", "status") if problem == "inverse" else ("poses", "exists")
    return kind(record, problem, grid, mode, tuple(dict.fromkeys(keep)) or usual)


def _home(record: MechanismRecord, problem: Problem, mode: str) -> str:
    """The one mode that is swept without a closed form, by any of its names."""
    if mode not in ("", HOME) and mode != mode_names(record, home_values(record))[problem == "direct"]:
        now = renamed(record, problem, mode)
        raise UsageError(
            f"{record.name} has no closed form: a sweep follows home's mode, not '{mode}'",
            hint=f"leave the mode out; `assur {problem}` gives every mode of one problem{'; ' if now else ''}{now}",
        )
    return HOME
