from __future__ import annotations

import json

import numpy as np

import assur
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import answer
from assur.results.json_text import json_text


def test_bounds_are_in_the_unit_of_the_file():
    record = assur.load("fivebar")
    found = certified_direct(record, np.radians([127.0, 53.0]))
    data = answer(found)
    assert np.allclose(data["inputs"], [127.0, 53.0])
    back = certified_inverse(record, found.solutions[0].pose.middle)
    bounds = [item["inputs"] for item in answer(back)["solutions"]]
    assert any(np.allclose(item["low"], [127.0, 53.0]) and np.allclose(item["high"], [127.0, 53.0]) for item in bounds)


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
