"""The closed motion closes, keeps its mode and its loops, and agrees with a path that was followed."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.kinematics.limits import limits
from assur.kinematics.named_signs import named_signs
from assur.scene import motion
from assur.scene.motion import closed_motion

SOME = ("zeng2019", "fivebar", "delta_4s", "three_rps")


@pytest.mark.parametrize("name", SOME)
def test_it_closes_and_every_frame_is_assembled_within_limits(name):
    record = assur.load(name)
    values = closed_motion(record, 16)
    assert values.shape[0] == 17
    np.testing.assert_array_equal(values[0], record.home_values)
    assert np.max(closure_error(record, values)) < 1e-9 * characteristic_length(record)
    inputs = inputs_of(record, values)
    np.testing.assert_allclose(inputs[-1], inputs[0], atol=1e-9)
    assert np.all(np.ptp(inputs, axis=0) > 0)
    assert all(np.min(item.margin(values)) > -1e-6 for item in limits(record, values[0]))


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_the_way_there_is_the_one_that_is_followed(name):
    record = assur.load(name)
    values = closed_motion(record, 16)
    path = record.follow(values[0], inputs=inputs_of(record, values[1:9]))
    assert path.stopped is None
    np.testing.assert_allclose(path.joints[-1], values[8], atol=1e-6 * characteristic_length(record))


def test_no_frame_stands_in_another_mode():
    """The full swing of zeng2019 runs through a serial singularity: the inputs go on, the working mode does not."""
    record = assur.load("zeng2019")
    values = closed_motion(record, 16)
    signs = named_signs(record, "inverse", values)
    assert np.all(signs == signs[0])
    full = motion.SLIDE * characteristic_length(record)
    assert np.all(np.ptp(inputs_of(record, values), axis=0) < 0.9 * full)  # so that a swing had to be made smaller
    way = inputs_of(record, values[0]) + (inputs_of(record, values[1:]) - inputs_of(record, values[0])) / motion.SMALLER
    assert record.follow(values[0], inputs=way, turns="given", use_limits=False).stopped is not None


def test_too_few_frames_are_refused():
    with pytest.raises(UsageError, match="at least 8"):
        closed_motion(assur.load("fivebar"), 3)
