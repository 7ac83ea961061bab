"""All inverses as the few distinct numbers that they are combinations of, as C writes them too."""

from __future__ import annotations

import numpy as np

from assur.kinematics.closed_form.all_modes_sweep import all_branches
from assur.kinematics.closed_form.filling import Filler, run
from assur.kinematics.closed_form.recorded import Recording, recording
from assur.model.mechanism import MechanismRecord


def distinct_inverses(record: MechanismRecord, poses: np.ndarray, engine: str, threads: int = 1) -> list[np.ndarray]:
    """The distinct inputs (R, N) and existences (T, N) at poses (m, N), by NumPy or by the compiled loop."""
    count = poses.shape[1]
    if engine == "compiled":
        filler = distinct_filler(recording(record, "inverse", every=True), count)
        run(filler, poses, tuple(poses), None, None, threads)
        return [filler.numbers, filler.truths]
    values, exists = all_branches(record, "inverse")(poses.T)
    wide = [np.broadcast_to(value, (*np.shape(value)[:-1], count)).reshape(-1, count) for value in (*values, exists)]
    return [np.concatenate(wide[:-1]), wide[-1]]


def distinct_filler(tape: Recording, count: int) -> Filler:
    """What fills arrays with one row for each different output, input after input."""
    of_modes, inputs = next(iter(tape.rows.values())), len(tape.record.inputs)
    ordered = [row for k in range(inputs) for row in of_modes[k::inputs]]
    rows = tuple({tape.tape.outputs[row.take[0]]: row for row in ordered}.values())
    truths = tuple({tape.tape.outputs[name]: name for name in tape.truths}.values())
    numbers = np.zeros((len(rows), count)), np.zeros((len(truths), count), dtype=bool)
    return Filler(tape, tape.uniform(), rows, truths, *numbers)
