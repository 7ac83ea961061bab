"""What is called regular without singular values is regular by them, and hardly anything regular is left in doubt."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.closure import assemble
from assur.kinematics.rates import finite_motion
from assur.kinematics.rates.finite_motion import classify_at, status_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.regularity import surely_regular
from assur.kinematics.starts import by_chance
from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.model.registry import names

PLANAR = ("fivebar", "planar_3rrr", "planar_3rpr")


def anywhere(mechanism, count):
    """Assemblies by chance, anywhere."""
    found = assemble(mechanism, by_chance(mechanism, count, np.random.default_rng(0)), far=True)
    return found.values[found.closed]


def _agree(mechanism, joints):
    sure, first_order = surely_regular(mechanism, joints), instantaneous(mechanism, joints)
    status = status_of(mechanism, joints, first_order)
    assert np.all(status[sure] == Status.regular)
    return sure, status, first_order


@pytest.mark.parametrize("name", PLANAR)
def test_near_a_singularity_nothing_is_sure(name):
    mechanism = assur.load(name)
    sure, status, first_order = _agree(mechanism, anywhere(mechanism, 4000))
    near = status == Status.near_singular
    assert np.sum(near) >= 3
    least = np.min([first_order.measures["output"], first_order.measures["input"]], axis=0)
    assert np.mean(sure[least > 30 * NEAR_SINGULAR]) > 0.98


@pytest.mark.parametrize("name", ["delta_4s", "zeng2019", "three_rrc"])
def test_nearly_all_that_is_regular_is_sure(name):
    mechanism = assur.load(name)
    sure, status, _ = _agree(mechanism, anywhere(mechanism, 256))
    assert np.mean(sure[status == Status.regular]) > 0.85


@pytest.mark.deep
@pytest.mark.parametrize("name", names())
def test_what_is_sure_is_regular(name):
    mechanism = assur.load(name)
    _agree(mechanism, anywhere(mechanism, 2000))


def test_an_open_loop_and_more_inputs_than_rates_are_never_sure():
    mechanism = assur.load("fivebar")
    joints = np.repeat(mechanism.home_values[None], 4, axis=0)
    joints[1] += 1e-3
    assert surely_regular(mechanism, joints).tolist() == [True, False, True, True]
    one = replace(mechanism, closed_form=None, inputs=mechanism.inputs[:1])
    assert not np.any(surely_regular(one, joints))


def test_where_all_are_sure_no_first_order_motion_is_worked_out(monkeypatch):
    mechanism = assur.load("delta_4s")
    monkeypatch.setattr(finite_motion, "instantaneous", None)
    assert classify_at(mechanism, np.repeat(mechanism.home_values[None], 3, axis=0)).tolist() == [0, 0, 0]
