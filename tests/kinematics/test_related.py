"""Linear relations that hold about home, and assemblies in which they hold."""

import numpy as np

from assur.kinematics.closure import closure_error
from assur.kinematics.related import closed_as_related, related
from assur.kinematics.starts import by_chance
from assur.kinematics.still import otherwise
from assur.model.registry import load_record


def test_rods_of_parallelograms_turn_alike_and_joints_of_a_link_that_does_not_turn_against_each_other():
    record = load_record("zeng2019")
    free, changes = related(record)
    assert changes.shape == (17, 7) == (len(record.coordinates), len(free))
    own = {item.joint: changes[item.index] for item in record.coordinates}
    assert np.allclose(own["B3a"], own["B3b"], atol=1e-7)
    assert np.allclose(own["B1"], -own["C1"], atol=1e-7)
    assert np.allclose(own["B1"], -own["B2"], atol=1e-7)  # links 4 and 6 are equally long, and so are their bodies


def test_no_relations_are_said_of_rotation_vectors():
    record = load_record("delta_4s")
    assert related(record) is None
    assert len(closed_as_related(record, by_chance(record, 2, np.random.default_rng(0))).values) == 0


def test_most_starts_lead_to_an_assembly_in_which_stands_still_what_does_about_home():
    record = load_record("zeng2019")
    closed = closed_as_related(record, by_chance(record, 24, np.random.default_rng(1)))
    assert len(closed.values) > 12
    assert np.all(closed.closed)
    assert np.max(closure_error(record, closed.values)) < 1e-9
    assert not any(otherwise(record, closed.values))
