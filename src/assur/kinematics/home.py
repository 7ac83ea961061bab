"""Home: the assembled configuration near the values of the file, followed when dimensions change."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import MechanismFileError, Problem
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import assemble, gap_left
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
HINT = "these dimensions may have no assembly near home: give a home near one, or other dimensions"


@lru_cache(maxsize=64)
def home_values(record: MechanismRecord) -> FloatArray:
    """Joint values (n,) of the assembled home: the file's values, moved as little as closes every loop.

    Where changed dimensions do not close from there, or close in another mode, home is followed from the
    file's dimensions to the changed ones in steps. Raises `UsageError` (for a file as it stands
    `MechanismFileError`) where that fails too, with the gap that remains or the mode in which the loops close.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> bool(np.max(np.abs(home_values(record) - record.home)) < 2.0)
    True
    """
    found = assemble(record, record.home)
    if not record.overrides:
        if not bool(found.closed):
            problem = Problem(str(record.file), None, "home", gap_left(record, found), "the loops must close", HINT)
            raise MechanismFileError([problem])
    else:
        from assur.kinematics.carried_home import carried_home  # reads the file again, for its own dimensions

        found = carried_home(record, found)
    found.values.flags.writeable = False
    return found.values


def check_loops(record: MechanismRecord) -> None:
    """Raise `MechanismFileError` for a file of nothing but serial chains."""
    if not joint_graph(record).cut:
        raise MechanismFileError([without_loops(record)])


def without_loops(record: MechanismRecord) -> Problem:
    """What is said of a file of nothing but serial chains."""
    from assur.model.file.place import problem, table_place  # what reads a file again, for a fault alone

    what = "no loop: nothing but serial chains"
    hint = "its joint values are its position; assur is for closed loops"
    return problem(record, table_place(record, "joints"), what, "at least one closed loop", hint)
