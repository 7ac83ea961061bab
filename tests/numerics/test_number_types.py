"""The same kernel lines over every number type: floats, duals, symbols and exact rationals agree."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import checked_poses
from assur.kinematics.modes import mode_signs, sign_names
from assur.model.pose import is_angle
from assur.numerics.dual import Dual, Duals
from assur.numerics.number_types import Extended, Floats, Symbols
from catalogue import each


@pytest.fixture(params=each())
def mechanism(request):
    return assur.load(request.param)


def _pose(mechanism):
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    poses = checked_poses(mechanism, np.random.default_rng(0).uniform(low, high, size=(50, len(low))))
    return poses[mechanism.inverse(poses, mechanism.modes.default_working).exists[:, 0]][0]


def _sign(mechanism):
    signs = mode_signs(mechanism, "inverse", mechanism.modes.default_working)
    return SimpleNamespace(**dict(zip(sign_names(mechanism, "inverse"), signs, strict=True)))


def _numbers(inputs):
    return [number for value in inputs for number in (value if isinstance(value, tuple) else (value,))]


def _components(mechanism, pose):
    """The pose as kernels take it, of floats: numbers, angles as (cosine, sine)."""
    return tuple(
        (np.cos(value), np.sin(value)) if is_angle(name) else value
        for name, value in zip(mechanism.platform.pose, pose, strict=True)
    )


def _symbol(name):
    letter = sympy.Symbol(name)
    return (sympy.cos(letter), sympy.sin(letter)) if is_angle(name) else letter


def _dual(name, value, rate):
    if is_angle(name):
        return (Dual(np.cos(value), -np.sin(value) * rate), Dual(np.sin(value), np.cos(value) * rate))
    return Dual(value, rate)


def test_symbols_give_the_formula_whose_value_is_the_float(mechanism):
    form, pose = mechanism.closed_form, _pose(mechanism)
    names = mechanism.platform.pose
    letters = SimpleNamespace(**{name: sympy.Symbol(name) for name in mechanism.parameters})
    formulas = _numbers(form.inverse(Symbols(), letters, tuple(map(_symbol, names)), _sign(mechanism)).inputs)
    floats = _numbers(form.inverse(Floats(), mechanism.values, _components(mechanism, pose), _sign(mechanism)).inputs)
    values = dict(zip(map(sympy.Symbol, names), pose, strict=True)) | {
        sympy.Symbol(name): item.inside for name, item in mechanism.parameters.items()
    }
    for formula, number in zip(formulas, floats, strict=True):
        assert float(formula.subs(values).evalf(30)) == pytest.approx(float(number), abs=1e-10)


def test_duals_give_the_derivative_of_the_float(mechanism):
    form, pose = mechanism.closed_form, _pose(mechanism)
    along = np.random.default_rng(1).normal(size=len(pose))
    length = characteristic_length(mechanism)
    along *= [1.0 if is_angle(name) else length for name in mechanism.platform.pose]

    def inputs(step):
        moved = _components(mechanism, pose + step * along)
        return _numbers(form.inverse(Floats(), mechanism.values, moved, _sign(mechanism)).inputs)

    duals = tuple(map(_dual, mechanism.platform.pose, pose, along))
    found = _numbers(form.inverse(Duals(), mechanism.values, duals, _sign(mechanism)).inputs)
    for number, ahead, behind in zip(found, inputs(1e-6), inputs(-1e-6), strict=True):
        assert number.derivative == pytest.approx((ahead - behind) / 2e-6, rel=1e-4, abs=1e-4 * length)


def test_extended_agrees_with_floats_where_every_margin_is_positive(mechanism):
    form, pose = mechanism.closed_form, _pose(mechanism)
    first = form.inverse(Floats(), mechanism.values, _components(mechanism, pose), _sign(mechanism))
    second = form.inverse(Extended(), mechanism.values, _components(mechanism, pose), _sign(mechanism))
    assert _numbers(first.inputs) == _numbers(second.inputs)
    assert dict(first.margins) == dict(second.margins)
