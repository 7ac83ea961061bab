"""Reasons: amounts against plain geometry."""

import re

import numpy as np
import pytest

import assur
from assur.model.joint_graph import joint_graph
from assur.numerics import rotations
from assur.view.explain import _sense, explain, gap
from assur.view.state import TOLERANCE


def _to(name, **wanted):
    record = assur.load(name)
    path = record.follow(record.home_values, tolerance=TOLERANCE, largest_step=1.0, **wanted)
    return path, np.array(next(iter(wanted.values())))


def test_a_way_that_is_gone_to_its_end_needs_no_reason():
    path, aim = _to("fivebar", poses=[0.0, 230.0])
    assert explain(path, aim) is None


@pytest.mark.parametrize("aim", [[0.0, 300.0], [120.0, 320.0], [-200.0, 250.0]])
def test_the_leg_that_is_too_short_is_named_with_what_it_misses(aim):
    path, aim = _to("fivebar", poses=aim)
    reach = 100.0 + 194.0
    missing = [np.hypot(aim[0] + 70.0, aim[1]) - reach, np.hypot(aim[0] - 70.0, aim[1]) - reach]
    worst = int(np.argmax(np.round(missing, 6)))
    assert gap(path, aim) == f"leg{worst + 1} is {max(missing):.3g} mm too short"


@pytest.mark.parametrize("turn", np.arange(12) * np.pi / 6 + 0.1)
@pytest.mark.parametrize("reach", [330.0, 420.0])
def test_what_is_said_of_the_leg_that_is_named_is_true(turn, reach):
    """All around and far out, where one leg misses or both do."""
    path, aim = _to("fivebar", poses=[reach * np.cos(turn), reach * np.sin(turn)])
    leg, amount, sense = re.fullmatch(r"leg([12]) is ([\d.e+-]+) mm (too \w+)", gap(path, aim)).groups()
    away = np.hypot(aim[0] + (70.0 if leg == "1" else -70.0), aim[1])
    missing = away - 294.0 if sense == "too short" else 94.0 - away
    assert float(amount) == pytest.approx(missing, rel=6e-3)


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


@pytest.mark.parametrize(
    ("degrees", "said"),
    [(0, "too short"), (44, "too short"), (47, "off"), (90, "off"), (133, "off"), (136, "too long")],
)
def test_a_leg_is_short_or_long_along_its_way_and_off_to_the_side(degrees, said):
    """The gap of leg 2 of the five-bar, turned from the line A2 P; 45.6 deg is where 0.7 of it lies along the line."""
    record = assur.load("fivebar")
    home = record.home_values
    way = record.point("P", home) - record.point("A2", home)
    turned = rotations.from_vector(np.radians([0.0, 0.0, degrees])) @ way
    joint = joint_graph(record).cut[0]
    from_the_leg = -1.0 if joint.child == record.platform.link else 1.0  # a gap is that of the child from the parent
    assert _sense(record, home, 0, from_the_leg * turned) == said


def test_a_joint_limit_is_named_with_its_end():
    record = assur.load("three_rps")
    _, high = record.inputs[1].stroke
    inputs = record.direct([250.0, 250.0, 250.0]).given.copy()
    inputs[1] = high + 30.0
    path = record.follow(record.home_values, inputs=inputs, tolerance=TOLERANCE, largest_step=1.0)
    assert str(explain(path, inputs)) == f"stroke of {record.inputs[1].name} ends at {high:g} mm"
