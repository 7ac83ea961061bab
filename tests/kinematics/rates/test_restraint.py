"""What holds the platform: by lines of force written down for each leg, and near a constraint singularity."""

from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.rates.restraint import WELL, restraint
from assur.kinematics.validation.check import doubts, faults
from assur.model.registry import load_record, names
from assur.synthesis.drafting.attempts import DraftQuestion
from assur.synthesis.drafting.inputs import inputs_for
from assur.synthesis.drafting.layout import DraftLayout
from assur.topology.notation import parse_chains


def points_of(record, values, name):
    joint = record.joints[name]
    turn, origin = frames(record, values[None])[joint.parent]
    return origin[0] + turn[0] @ joint.at, turn[0]


def sizes_by(record, legs):
    """Singular values (6,) of legs' forces (point, directions), each leg's made orthonormal as moments and forces."""
    length, centre = characteristic_length(record), np.mean([ball for ball, _ in legs], axis=0)
    held = []
    for point, directions in legs:
        rows = [np.concatenate([np.cross(point - centre, force) / length, force]) for force in directions]
        held.append(np.linalg.qr(np.array(rows).T)[0].T)
    return np.linalg.svd(np.concatenate(held), compute_uv=False)


def test_a_hexapod_is_held_by_forces_along_its_legs():
    record = load_record("gough_stewart")
    values = home_values(record)
    legs = []
    for number in range(1, 7):
        (foot, _), (ball, _) = (points_of(record, values, f"{joint}{number}") for joint in "AB")
        legs.append((ball, [(ball - foot) / np.linalg.norm(ball - foot)]))
    assert restraint(record, values).sizes == pytest.approx(sizes_by(record, legs), abs=1e-9)


def test_a_3_rps_is_held_by_forces_along_its_legs_and_along_their_hinges():
    record = load_record("three_rps")
    values = home_values(record)
    legs = []
    for number in range(1, 4):
        (foot, turn), (ball, _) = (points_of(record, values, f"leg{number}.{joint}") for joint in "AS")
        legs.append((ball, [ball - foot, turn @ record.joints[f"leg{number}.A"].axes[0]]))
    assert restraint(record, values).sizes == pytest.approx(sizes_by(record, legs), abs=1e-9)


def test_legs_whose_couples_are_nearly_parallel_are_said_to_hold_badly():
    """All legs of this 3-PUU keep the platform from turning, about nearly one line: its own Jacobian sees nothing."""
    chains = parse_chains(["P[z] U[x,y] U[x,y]"] * 3)
    inputs, topology = inputs_for(chains, None, "home")
    question = DraftQuestion(chains, Path("my.toml"), inputs, topology, "home")
    made = question.attempt(DraftLayout(side=-70.0, twist=50.0), moved=False)
    assert made.record is not None
    assert faults(made.record) == ()
    assert made.clearance > 0.3
    assert made.held > 10 * WELL
    (note,) = doubts(made.record)
    assert "of what holds it" in note.given


def test_mechanisms_of_the_catalogue_are_held_well():
    """Within the range that the documentation names."""
    conditions = [restraint(record, home_values(record)).condition for record in map(load_record, names())]
    assert min(conditions) >= 1.0
    assert max(conditions) < 32
