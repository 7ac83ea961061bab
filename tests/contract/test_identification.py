"""A law of identification, for every mechanism: what poses tell is what assemblies that are solved again show."""

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.motions import around_home
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.calibration.identification import identification
from copies_off import moved
from own_machines import every_mechanism

mechanism = every_mechanism()
MEASURED = ("x", "y", "z", "rx", "ry", "rz")
STEP = 1e-5
"""Of a dimension, as a share of the characteristic length, and in rad."""
SHOWN = 1e-8
"""Share of the largest change: near home the least that is told has 1e-6, and differences leave 1e-10 of nothing."""
STILL = 1e-6
"""The same of a combination that is not told: parts of it that look like rounding are left out."""


def test_as_many_combinations_are_told_as_assemblies_show_and_the_others_leave_these_where_they_are(mechanism):
    values = around_home(mechanism)[1:4]
    told = identification(mechanism, pose_of(mechanism, values), MEASURED)
    units = pose_errors_at(mechanism, values[0]).units
    lengths = np.array([units[name] == mechanism.unit for name in told.parameters])
    shown = np.concatenate([_differences(mechanism, row, told.parameters, lengths) for row in values])
    sizes = np.linalg.svd(shown, compute_uv=False)
    assert told.rank == np.sum(sizes > SHOWN * sizes[0])
    degrees = np.array([np.radians(1.0) if units[name] == "deg" else 1.0 for name in told.parameters])
    one = np.where(lengths, 1.0 / characteristic_length(mechanism), degrees)
    for own in told.unidentifiable:
        combination = one * [own.combination.get(name, 0.0) for name in told.parameters]
        assert np.linalg.norm(shown @ combination) < STILL * sizes[0] * np.linalg.norm(combination)


def _differences(mechanism, values, names, lengths):
    """How the platform moves (6, p) as parameters do, lengths over the characteristic one: assemblies solved again."""
    length, inputs = characteristic_length(mechanism), {item.name for item in mechanism.drives}

    def after(step):
        rows = dict(zip(names, step * np.diag(np.where(lengths, length, 1.0)), strict=True))
        driven = {name: row for name, row in rows.items() if name in inputs}
        return moved(mechanism, values, {name: row for name, row in rows.items() if name not in inputs}, driven)[0]

    return ((after(STEP) - after(-STEP)) / (2.0 * STEP) / np.repeat([length, 1.0], 3)).T
