"""Mechanism files by the verifier's own reader."""

from fractions import Fraction

import pytest

import assur
from assur.model.registry import load_record
from assur.verifier.formula import AngleSum, FloatNumbers
from assur.verifier.mechanism import mechanism


@pytest.mark.parametrize("name", assur.names())
def test_dimensions_joints_and_inputs_are_those_of_the_record(name):
    record = load_record(name)
    own = mechanism(record.file.read_text(encoding="utf-8"))
    dimensions = own.dimensions(FloatNumbers())
    for parameter in record.parameters.values():
        number = dimensions[parameter.name]
        plain = FloatNumbers().radians(number) if isinstance(number, AngleSum) else number
        assert float(plain) == pytest.approx(float(parameter.inside), rel=1e-15)
    assert {n: (j.type, j.parent, j.child) for n, j in own.joints.items()} == {
        n: (j.type.name, j.parent, j.child) for n, j in record.joints.items()
    }
    assert [(item.coordinate.joint, item.coordinate.component) for item in record.inputs] == list(own.inputs)


def test_other_dimensions_are_their_decimals():
    text = load_record("zeng2019").file.read_text(encoding="utf-8")
    assert mechanism(text, {"l2": 280.1}).dimensions(FloatNumbers())["l2"] == Fraction(2801, 10)


FAULTS = {
    "no TOML": ("format", "format ="),
    "no base": ("base =", "root ="),
    "an axis that is none": ('axis = "y"', 'axis = "w"'),
    "two axes": ('axis = "y"', 'axes = ["x", "y"]'),
    "a type that is none": ('"prismatic"', '"sliding"'),
    "a link that is none": ('child = "slider1"', 'child = "nobody"'),
    "an input that is none": ('order = ["P1"', 'order = ["P9"'),
    "parameters in a circle": ("value = 280", 'value = "2*l2"'),
    "a formula that is none": ("value = 280", 'value = "280 +"'),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_file_that_says_nothing_is_refused(fault):
    text = load_record("zeng2019").file.read_text(encoding="utf-8")
    before, after = FAULTS[fault]
    assert before in text
    with pytest.raises((ValueError, KeyError)):
        mechanism(text.replace(before, after, 1)).dimensions(FloatNumbers())
