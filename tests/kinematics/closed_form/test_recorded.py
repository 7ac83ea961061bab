"""Recordings: what is shared, what is uniform, and what is left to NumPy."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closed_form.recorded import AnswerRow, recording
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.modes import all_modes, mode_signs
from assur.model.dimensions import with_parameters


def test_one_recording_serves_every_mode_and_all_dimensions(zeng):
    longer = with_parameters(zeng, l2=zeng.parameters["l2"].value * 1.1)
    poses = np.array([np.random.default_rng(1).uniform(*zeng.box[name], 300) for name in zeng.platform.pose])
    for record in (zeng, longer):
        for mode in all_modes(zeng, "inverse")[::5]:
            tape = recording(zeng, "inverse", ("inputs", "det_jp"))
            uniform = recording(record, "inverse", ("inputs", "det_jp")).uniform(mode_signs(zeng, "inverse", mode))
            found = tape.tape.evaluate(poses, uniform)
            wanted = inverse_sweep(record, poses, mode, engine="numpy")
            np.testing.assert_array_equal([found[row.take[0]] for row in tape.rows["inputs"]], wanted["inputs"])
            np.testing.assert_array_equal(found["det_jp"], wanted["det_jp"])


def test_all_32_inverses_are_12_numbers(zeng):
    tape = recording(zeng, "inverse", every=True)
    rows = tape.rows["inputs"]
    assert (len(rows), len(tape.truths)) == (96, 32)
    assert len({tape.tape.outputs[row.take[0]] for row in rows}) == 12
    assert len({tape.tape.outputs[name] for name in tape.truths}) == 4


def test_only_what_is_wanted_is_recorded(zeng):
    few, many = (recording(zeng, "inverse", want).tape for want in (("exists",), ("exists", "det_jp", "factors")))
    assert len(few.operations) < len(many.operations)
    assert list(few.outputs) == ["exists"]


def test_lengths_are_printed_by_the_tape_and_angles_by_numpy(zeng):
    assert recording(zeng, "inverse", ("inputs",)).rows["inputs"][0] == AnswerRow((".yA1",))
    fivebar = recording(assur.load("fivebar"), "inverse", ("inputs",))
    assert [row.finish for row in fivebar.rows["inputs"]] == ["angle", "angle"]
    assert recording(assur.load("gough_stewart"), "inverse", ("det_jp",)).rows["det_jp"][0].finish == "determinant"


def test_angles_are_given_as_cosine_and_sine():
    planar = recording(assur.load("planar_3rpr"), "inverse", ("exists",))
    assert planar.has_angles
    assert planar.tape.varying == ("x", "y", "cos phi", "sin phi")
    given = planar.prepared(np.array([[1.0], [2.0], [np.pi / 6]]))
    np.testing.assert_allclose(given[:, 0], [1, 2, np.sqrt(0.75), 0.5])


def test_refuses_a_direct_problem_without_signs():
    with pytest.raises(UsageError, match="by signs"):
        recording(assur.load("gough_stewart"), "direct", every=True)
