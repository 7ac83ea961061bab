"""The linear equations: joint values read off their solutions close the joint graph before anything is corrected."""

import dataclasses

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.loops.circles import System, joint_values, system
from assur.kinematics.loops.orientations import turnings
from assur.kinematics.loops.solving import solve
from assur.model.mechanism import MechanismRecord
from assur.model.registry import load_record


def _system(record: MechanismRecord) -> tuple[System, dict[int, float]]:
    locked = {index: float(home_values(record)[index]) for index in record.input_indices}
    (turning,) = turnings(record, locked, None, parallel=tuple(record.generalised))
    return system(record, turning, locked, {}), locked


@pytest.mark.parametrize(
    "name",
    [
        "zeng2019",
        "fivebar",
        "planar_3rrr",
        "planar_3rpr",
        "orthoglide",
        "tripteron",
        "delta_4s",
        "three_p2us",
        "three_rps",
    ],
)
def test_joint_values_close_the_loops_and_have_the_inputs(name: str) -> None:
    record = load_record(name)
    found, locked = _system(record)
    solved = solve(found)
    assert len(solved.unknowns) >= 1
    np.testing.assert_allclose(solved.unknowns @ found.matrix.T, 0.0, atol=1e-7)
    values = joint_values(found, solved.unknowns, locked)
    assert np.max(closure_error(record, values)) < 1e-7 * characteristic_length(record)
    for index, value in locked.items():
        assert np.all(values[:, index] == value)


def test_rods_that_a_limb_turns_are_points_on_spheres() -> None:
    found, _ = _system(load_record("orthoglide"))
    assert [(group.kind, group.alone, group.freedoms) for group in found.groups] == [("rod", True, 2)] * 3


def test_a_platform_on_three_ball_joints_is_a_triangle_of_known_sides() -> None:
    record = load_record("three_rps")
    found, _ = _system(record)
    assert [(group.kind, group.freedoms) for group in found.groups] == [("circle", 1)] * 3 + [("triangle", 3)]
    side = np.sqrt(3) * record.values.r / characteristic_length(record)
    np.testing.assert_allclose(found.groups[-1].sides, side**2)
    unknowns = solve(found).unknowns
    p, q = (unknowns[:, list(part)].real for part in np.split(np.array(found.groups[-1].columns), 2))
    for vector in (p, q, p - q):
        np.testing.assert_allclose(np.linalg.norm(vector, axis=1), side, atol=1e-7)


def test_freedoms_are_columns_less_quadratic_equations() -> None:
    found, _ = _system(load_record("zeng2019"))
    assert {group.kind for group in found.groups} == {"circle"}
    assert all(group.freedoms == 1 for group in found.groups)
    rod = dataclasses.replace(_system(load_record("orthoglide"))[0].groups[0], alone=False)
    assert rod.freedoms == 1  # its circle is known by then
