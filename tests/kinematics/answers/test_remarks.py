"""Two rows that are one double solution, and angles of which only a sum or a difference counts."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.answers.answer import answer
from assur.kinematics.answers.remarks import angles_remark
from assur.numerics import rotations


@pytest.mark.parametrize(("excess", "double"), [(1e-9, True), (1.0, False)])
def test_solutions_that_nearly_merge_are_called_double(excess, double):
    """Cranks stretched outwards put the elbows 340 mm apart: rods of 170 mm and a little meet just above and below."""
    record = assur.load("fivebar", l2=170.0 + excess)
    data = answer(record.direct(np.radians([180.0, 0.0])))
    assert len(data.solutions) == 2
    height = np.sqrt((170.0 + excess) ** 2 - 170.0**2)
    assert data.solutions[0].pose[1] == pytest.approx(height, rel=1e-2)
    assert [item.modes for item in data.doubles] == ([("+", "-")] if double else [])
    for item in data.doubles:
        assert item.apart < 1e-4


@pytest.mark.parametrize(("theta", "sign"), [(90.0, -1), (-90.0, 1)])
def test_where_theta_is_a_right_angle_only_a_sum_or_difference_counts(theta, sign):
    """Orientations with one value of psi - phi (or psi + phi) are one, with another they are not."""
    right, first = np.radians(theta), 0.3
    base = rotations.from_angles(np.asarray(first), np.asarray(right), np.asarray(0.2))
    same = rotations.from_angles(np.asarray(first + 0.5), np.asarray(right), np.asarray(0.2 - sign * 0.5))
    other = rotations.from_angles(np.asarray(first + 0.5), np.asarray(right), np.asarray(0.2 + sign * 0.5))
    assert np.allclose(base, same)
    assert not np.allclose(base, other)


def test_the_remark_names_which():
    record = assur.load("planar_3rpr")
    record = dataclasses.replace(
        record, platform=dataclasses.replace(record.platform, pose=("phi", "theta", "psi"), orientation="any")
    )
    assert angles_remark(record, np.array([0.4, np.pi / 2, 0.1])).endswith("only psi - phi counts")
    assert angles_remark(record, np.array([0.4, -np.pi / 2, 0.1])).endswith("only psi + phi counts")
    assert angles_remark(record, np.array([0.4, 1.5, 0.1])) == ""
