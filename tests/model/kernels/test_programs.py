"""Straight-line code of a kernel gives the bits that a walk through its text gives, over every plain number type."""

import tracemalloc
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from assur.errors import MechanismFileError
from assur.kinematics import border
from assur.kinematics.modes import sign_axes, sign_names
from assur.model.kernels.functions import REPAID
from assur.model.kernels.programs import Shapeless, made, shape_of
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record, names
from assur.numerics.intervals.interval import as_interval
from assur.numerics.number_types import Extended, Floats, Intervals

FILE = Path("closed_form.py")


def numbers_of(value):
    numbers = []
    return shape_of(value, numbers), numbers


@pytest.mark.parametrize("name", [name for name in names() if load_record(name).closed_form])
@pytest.mark.parametrize("ns", [Floats(), Extended()], ids=["floats", "extended"])
def test_every_built_in_kernel_by_its_program(name, ns):
    record = load_record(name)
    form, rng = record.closed_form, np.random.default_rng(3)
    signs = sign_axes(sign_names(record, "inverse"))

    def poses(count):
        return border.pose_components(record, rng.normal(size=(count, len(record.platform.pose))) * 100)

    with np.errstate(all="ignore"):
        branch = form.inverse.evaluated(ns, record.values, poses(3), signs)
        for kernel, given in [
            (form.inverse, (poses(3), signs)),
            *((kernel, (branch.core,)) for kernel in (form.joints, form.factors, form.jacobians)),
        ]:
            shape, numbers = numbers_of(kernel.evaluated(ns, record.values, *given))
            for _ in range(REPAID):
                by_program, fast = numbers_of(kernel(ns, record.values, *given))
            assert any(use.program for use in kernel.shapes.values())
            assert by_program == shape
            for one, other in zip(numbers, fast, strict=True):
                np.testing.assert_array_equal(one, other)


def test_intervals_too():
    record = load_record("zeng2019")
    form = record.closed_form
    pose = tuple(as_interval(value) for value in (-15.0, 9.0, 456.0))
    sign = SimpleNamespace(**dict.fromkeys(sign_names(record, "inverse"), 1.0))
    _, numbers = numbers_of(form.inverse.evaluated(Intervals(), record.values, pose, sign))
    for _ in range(REPAID):
        _, fast = numbers_of(form.inverse(Intervals(), record.values, pose, sign))
    assert [(float(x.low), float(x.high)) for x in map(as_interval, numbers)] == [
        (float(x.low), float(x.high)) for x in map(as_interval, fast)
    ]


def test_an_error_still_names_its_line():
    kernel = names_of("def f(ns, x):\n    y = x + 1\n    return 1 / (y - 1)\n", FILE)["f"]
    for x in (1.0,) * REPAID + (2.0,):
        assert kernel(Floats(), x) == 1 / x
    with pytest.raises(MechanismFileError, match=r"closed_form.py:3: ZeroDivisionError"):
        kernel(Floats(), 0.0)


def test_plain_data_is_part_of_the_shape():
    kernel = names_of("def f(ns, x, k):\n    return (x, x * x)[k], {'a': [x, None]}, 'text'\n", FILE)["f"]
    for _ in range(REPAID + 2):
        assert kernel(Floats(), 3.0, 0) == (3.0, {"a": [3.0, None]}, "text")
        assert kernel(Floats(), 3.0, 1) == (9.0, {"a": [3.0, None]}, "text")
        assert kernel(Floats(), x=3.0, k=1)[0] == 9.0


def test_names_in_a_text_are_no_code():
    text = 'def f(ns, x):\n    return {"x\\n    __import__(1)": x, "\'": 2 * x}\n'
    kernel = names_of(text, FILE)["f"]
    for _ in range(REPAID + 2):
        assert list(kernel(Floats(), 3.0).values()) == [3.0, 6.0]


def test_a_value_is_made_again_of_its_shape():
    value = (1.5, [2, 2.5], {"a": None}, SimpleNamespace(b=(True, 3.5)))
    shape, numbers = numbers_of(value)
    assert numbers == [1.5, 2.5, 3.5]
    assert made(shape, iter(numbers)) == value
    with pytest.raises(Shapeless):
        numbers_of((print,))


def test_true_is_not_one():
    kernel = names_of("def f(ns, x, flag):\n    return x if flag is True else -x\n", Path("k.py"))["f"]
    answers = [kernel(Floats(), 2.0, flag) for flag in (1, True) for _ in range(9)]
    assert answers == [-2.0] * 9 + [2.0] * 9


def test_long_arrays_are_given_back_before_the_answer():
    lines = "\n".join(f"    x{k + 1} = x{k} * x{k} + p" for k in range(40))
    kernel = names_of(f"def polynomial(ns, p, x0):\n{lines}\n    return x40\n", FILE)["polynomial"]
    values = np.linspace(0.0, 0.5, 100_000)
    for _ in range(REPAID):
        kernel(Floats(), 0.1, values)
    tracemalloc.start()
    kernel(Floats(), 0.1, values)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 6 * values.nbytes
