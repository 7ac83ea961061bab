import json

import mpmath
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import assur
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import answer, at_most
from assur.results.json_text import json_text


def test_bounds_are_in_the_unit_of_the_file():
    record = assur.load("fivebar")
    found = certified_direct(record, np.radians([127.0, 53.0]))
    data = answer(found)
    assert np.allclose(data.inputs, [127.0, 53.0])
    back = certified_inverse(record, found.solutions[0].pose.middle)
    bounds = [item.inputs for item in answer(back).solutions]
    assert any(np.allclose(item.low, [127.0, 53.0]) and np.allclose(item.high, [127.0, 53.0]) for item in bounds)


def test_the_headline_says_what_is_proved():
    record = assur.load("zeng2019")
    assert certified_direct(record, [900.0, -143.0, -24.0]).headline == "proved, no solution"
    assert certified_direct(record, [70.0, -70.0, 0.0]).headline == "0 solutions proved, undecided in 1 place"
    assert repr(certified_direct(record, [162.0, -143.0, -24.0])).startswith(
        "<direct certificate of zeng2019: proved, 4"
    )


def test_doubts_are_written_with_their_bounds_and_units():
    data = json.loads(json_text(answer(certified_direct(assur.load("zeng2019"), [70.0, -70.0, 0.0]))))
    (doubt,) = data["undecided"]
    assert (doubt["name"], doubt["unit"], doubt["branches"]) == ("B", "mm", 8)
    assert doubt["low"][0] <= 0 <= doubt["high"][0]
    assert (data["proved"], data["solutions"]) == (False, [])


def test_bounds_in_degrees_hold_those_in_rad():
    """Rounded outwards: 180 / pi times each bound, with 40 digits, is between those that are written."""
    record = assur.load("fivebar")
    found = certified_inverse(record, certified_direct(record, np.radians([127.0, 53.0])).solutions[0].pose.middle)
    with mpmath.workdps(40):
        for item, data in zip(found, answer(found).solutions, strict=True):
            for k in range(2):
                assert data.inputs.low[k] < mpmath.degrees(mpmath.mpf(float(item.inputs.low[k])))
                assert mpmath.degrees(mpmath.mpf(float(item.inputs.high[k]))) < data.inputs.high[k]


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_upper_bounds_are_rounded_up(size):
    assert size <= float(at_most(size)) <= 1.11 * size
