"""Reasons: amounts against plain geometry."""

import numpy as np
import pytest

import assur
from assur.view.explain import explain, gap
from assur.view.snapshot import TOLERANCE


def _to(name, **wanted):
    record = assur.load(name)
    path = record.follow(record.home_values, tolerance=TOLERANCE, largest_step=1.0, **wanted)
    return path, np.array(next(iter(wanted.values())))


def test_a_way_that_is_gone_to_its_end_needs_no_reason():
    path, aim = _to("fivebar", poses=[0.0, 230.0])
    assert explain(path, aim) is None


@pytest.mark.parametrize("aim", [[0.0, 300.0], [120.0, 320.0], [-200.0, 250.0]])
def test_the_legs_that_are_too_short_are_named_with_what_they_miss_the_worst_first(aim):
    path, aim = _to("fivebar", poses=aim)
    missing = {1: np.hypot(aim[0] + 70.0, aim[1]) - 294.0, 2: np.hypot(aim[0] - 70.0, aim[1]) - 294.0}
    order = sorted(missing, key=lambda leg: -round(missing[leg], 6))
    said = [f"leg{leg} is {missing[leg]:.3g} mm too short" for leg in order if missing[leg] > 0]
    assert gap(path, aim) == ", ".join(said)


def test_a_leg_that_is_too_long_is_said_to_be():
    """The inner circle of a leg is 194 - 100 wide: P on the base joint of leg 2 is that much too near."""
    record = assur.load("fivebar")
    values = record.inverse([60.0, 180.0]).joints[0]
    path = record.follow(values, poses=[70.0, 60.0], tolerance=TOLERANCE, largest_step=1.0)
    assert gap(path, np.array([70.0, 60.0])) == "leg2 is 34 mm too long"


def test_inputs_with_which_the_loop_stays_open_say_by_how_much():
    """Cranks that point outwards: their knees are 140 + 200 apart, the rods together 388 long, so they close; at
    longer base they do not."""
    record = assur.load("fivebar", g=120.0)
    path = record.follow(record.home_values, inputs=[np.pi, 0.0], turns="given", tolerance=TOLERANCE, largest_step=1.0)
    said = gap(path, np.array([np.pi, 0.0]))
    missing = 2 * 120.0 + 2 * 100.0 - 2 * 194.0
    assert said == f"the loop closed by P stays open by {missing:.3g} mm"
    assert str(explain(path, np.array([np.pi, 0.0]))).startswith("parallel singularity: ")


def test_a_joint_limit_is_named_with_its_end():
    record = assur.load("three_rps")
    _, high = record.inputs[1].stroke
    inputs = record.direct([250.0, 250.0, 250.0]).given.copy()
    inputs[1] = high + 30.0
    path = record.follow(record.home_values, inputs=inputs, tolerance=TOLERANCE, largest_step=1.0)
    assert str(explain(path, inputs)) == f"stroke of {record.inputs[1].name} ends at {high:g} mm"


def test_limits_that_are_met_together_are_all_named():
    record = assur.load("three_rps")
    high = [item.stroke[1] for item in record.inputs]
    home = record.direct([250.0, 250.0, 250.0]).given
    path = record.follow(record.home_values, inputs=home, tolerance=TOLERANCE, largest_step=1.0)
    aim = np.array(high) + 30.0
    path = record.follow(path.joints[-1], inputs=aim, tolerance=TOLERANCE, largest_step=1.0)
    said = [f"stroke of {item.name} ends at {end:g} mm" for item, end in zip(record.inputs, high, strict=True)]
    assert str(explain(path, aim)) == ", ".join(said)
