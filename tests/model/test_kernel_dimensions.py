"""What kernels take of the dimensions: lengths as they are, angles as cosine and sine."""

import numpy as np
import pytest

from assur.kinematics.certified.given import dimension_intervals
from assur.model.kernel_dimensions import dimension_numbers, kernel_dimensions
from assur.model.registry import load_record

FILE = """
format = 1
name = "arm"
title = "Two joints"
unit = "mm"
angle = "deg"
base = "base"
[platform]
link = "platform"
pose = ["x", "y"]
[parameters]
a = {{ value = 100 }}
alpha = {{ value = {alpha}, unit = "deg", sign = "any" }}
beta = {{ value = "alpha/2", unit = "deg", sign = "any" }}
[links]
base = {{ meaning = "base" }}
arm = {{ meaning = "arm" }}
platform = {{ meaning = "platform" }}
[joints]
A = {{ type = "revolute", parent = "base", child = "arm", at = [0, 0, 0], axis = "z" }}
B = {{ type = "revolute", parent = "arm", child = "platform", at = ["a*cos(alpha)", "a*sin(alpha)", 0], axis = "z" }}
[inputs]
A = {{ name = "q1" }}
B = {{ name = "q2" }}
[home]
A = 0
B = 0
"""


@pytest.fixture
def record(tmp_path):
    file = tmp_path / "arm.toml"
    file.write_text(FILE.format(alpha=30))
    return load_record(file)


def test_an_angle_is_cosine_and_sine_and_a_length_as_it_is(record):
    p = kernel_dimensions(record)
    assert p.a == 100.0
    assert p.alpha == pytest.approx((3**0.5 / 2, 0.5), abs=1e-15)
    assert p.beta == pytest.approx((np.cos(np.pi / 12), np.sin(np.pi / 12)), abs=1e-15)


def test_numbers_of_any_type_are_asked_for_by_their_names(record):
    p = kernel_dimensions(record, lambda name: name)
    assert (p.a, p.alpha) == ("a", ("cos alpha", "sin alpha"))
    assert list(dimension_numbers(record)) == ["a", "cos alpha", "sin alpha", "cos beta", "sin beta"]


def test_a_change_of_the_angle_changes_both(record):
    changed = load_record(record.file, alpha=90)
    assert kernel_dimensions(changed).alpha == pytest.approx((0.0, 1.0), abs=1e-15)


def test_bounds_hold_the_exact_cosine(record):
    bounds = dimension_intervals(record)
    assert float(bounds["a"].width) == 0.0
    cosine = bounds["cos alpha"]
    low, high = float(cosine.low), float(cosine.high)
    assert low**2 < 0.75 < high**2
    assert high - low < 1e-14
