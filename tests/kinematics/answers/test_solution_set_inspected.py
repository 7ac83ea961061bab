"""No answer raises when it is looked at: a property answers, or says by an AttributeError that it is not there."""

import inspect

import pytest

import assur
from assur.errors import BatchError, UsageError

POSE = [-15.4714, 9.6849, 456.3315]
INPUTS = [162.6907, -143.3209, -24.6776]
ANSWERS = {
    "a mechanism": lambda zeng, _: zeng,
    "solutions": lambda zeng, _: zeng.inverse(POSE),
    "a solution": lambda zeng, _: next(iter(zeng.inverse(POSE))),
    "no solution": lambda zeng, _: zeng.inverse([0.0, 0.0, 9000.0]),
    "a batch": lambda zeng, _: zeng.direct([INPUTS, INPUTS]),
    "a batch by loops": lambda _, bar: bar.direct([[0.3, 2.0]], method="loops"),
    "a batch by search": lambda _, bar: bar.inverse([[0.0, 200.0]], method="search"),
    "a velocity map": lambda zeng, _: zeng.velocity_map([POSE, POSE]),
    "rates": lambda zeng, _: zeng.instantaneous(zeng.home_values),
    "a verdict": lambda zeng, _: zeng.singularity(POSE),
    "indices": lambda _, bar: bar.indices([[0.0, 200.0]]),
    "a proof": lambda _, bar: bar.certified_direct([0.3, 2.0]),
    "a workspace": lambda _, bar: bar.workspace(resolution=8),
    "aspects": lambda _, bar: bar.aspects("-+", finest={"x": 40.0, "y": 40.0}),
    "a path": lambda _, bar: bar.follow(next(iter(bar.inverse([0.0, 200.0]))).joints, poses=[0.0, 210.0]),
    "a topology": lambda zeng, _: zeng.topology(),
}


@pytest.fixture(scope="module")
def mechanisms():
    return assur.load("zeng2019"), assur.load("fivebar")


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_can_be_inspected(mechanisms, name):
    answer = ANSWERS[name](*mechanisms)
    assert inspect.getmembers(answer)
    for attribute in dir(type(answer)):
        assert hasattr(answer, attribute) in (True, False)


def test_what_only_one_answer_has_is_no_attribute_of_a_batch(mechanisms):
    zeng, _ = mechanisms
    one, batch = zeng.direct(INPUTS), zeng.direct([INPUTS])
    assert [hasattr(one, name) for name in ("curves", "failures", "poses")] == [True, True, True]
    assert [hasattr(batch, name) for name in ("curves", "failures", "poses")] == [False, False, True]
    with pytest.raises(BatchError, match="one problem at a time") as caught:
        _ = batch.curves
    assert isinstance(caught.value, UsageError)
