"""Derivatives of tapes: reverse beside forward, both beside dual numbers, SymPy and differences."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy

import assur
from assur.errors import UnknownNameError
from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.modes import mode_signs
from assur.numerics.dual import Dual, Duals
from assur.numerics.recording.derivatives import derivative, directional, gradient
from assur.numerics.recording.loops import compiled
from assur.numerics.recording.tape import Recorder
from assur.numerics.small_matrices import by_cofactors

NAMES = ("x", "y", "p")


@pytest.fixture(scope="module")
def tape():
    """Every operation with a derivative, shared entries, and an output that depends on nothing."""
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    root = recorder.sqrt(x * x + p * y * y + 2)
    value = (x - y) / (root + 1) - -(x * root) + 3 / (p + y * y) + abs(x - 2 * y) * root
    return recorder.tape({"value": value, "root": root, "large": root > 2, "fixed": recorder.number(4.0)})


@pytest.fixture(scope="module")
def points():
    rng = np.random.default_rng(2)
    return rng.normal(size=(2, 400)) * 3


def test_gradient_is_that_of_sympy(tape, points):
    x, y, p = symbols = sympy.symbols("x y p", real=True)
    outputs = _symbolic(x, y, p)
    found = gradient(tape, ["value", "root"], NAMES).evaluate(points, [1.7])
    for output, expression in outputs.items():
        for name, symbol in zip(NAMES, symbols, strict=True):
            wanted = sympy.lambdify(symbols, sympy.diff(expression, symbol), "numpy")(*points, 1.7)
            np.testing.assert_allclose(found[derivative(output, name)], wanted, rtol=1e-11, atol=1e-11)


def _symbolic(x, y, p):
    root = sympy.sqrt(x * x + p * y * y + 2)
    value = (x - y) / (root + 1) + x * root + 3 / (p + y * y) + sympy.Abs(x - 2 * y) * root
    return {"value": value, "root": root}


def test_forward_is_reverse_times_the_direction(tape, points):
    reverse = gradient(tape, ["value"], ["x", "y"]).evaluate(points, [1.7])
    rates = np.random.default_rng(8).normal(size=(2, points.shape[1]))
    forward = directional(tape).evaluate([*points, *rates], [1.7])
    wanted = reverse["dvalue/dx"] * rates[0] + reverse["dvalue/dy"] * rates[1]
    np.testing.assert_allclose(forward["dvalue"], wanted, rtol=1e-11, atol=1e-11)
    assert forward["dfixed"] == 0
    assert "dlarge" not in forward


def test_outputs_are_kept_with_their_bits_or_left_out(tape, points):
    found = gradient(tape, ["value"], ["x"]).evaluate(points, [1.7])
    for name, value in tape.evaluate(points, [1.7]).items():
        np.testing.assert_array_equal(found[name], value)
    assert list(gradient(tape, ["value"], ["x"], keep=False).outputs) == ["dvalue/dx"]


def test_what_an_output_does_not_depend_on_has_derivative_zero(tape):
    found = gradient(tape, ["fixed", "root"], ["x", "p"]).evaluate(np.array([[1.0], [0.0]]), [1.7])
    assert found["dfixed/dx"] == found["dfixed/dp"] == 0
    assert found["droot/dp"] == 0


def test_magnitude_at_zero_has_slope_zero():
    recorder = Recorder()
    x = recorder.varying("x")
    slopes = gradient(recorder.tape({"y": abs(x)}), ["y"], ["x"])
    np.testing.assert_array_equal(slopes.evaluate([np.array([-2.0, 0.0, 3.0])], [])["dy/dx"], [-1, 0, 1])


def test_the_output_itself_and_a_number_that_occurs_twice():
    recorder = Recorder()
    x = recorder.varying("x")
    slopes = gradient(recorder.tape({"x": x, "square": x * x}), ["x", "square"], ["x"])
    found = slopes.evaluate([np.array([3.0])], [])
    assert (float(found["dx/dx"]), float(found["dsquare/dx"][0])) == (1, 6)


def test_refuses_what_has_no_derivative(tape):
    with pytest.raises(UnknownNameError, match="large"):
        gradient(tape, ["large"], ["x"])
    with pytest.raises(UnknownNameError, match="given number"):
        gradient(tape, ["value"], ["z"])


@pytest.mark.parametrize("name", ["zeng2019", "orthoglide", "fivebar"])
def test_kernels_beside_dual_numbers_and_differences(name):
    mechanism = assur.load(name)
    found = recording(mechanism, "inverse", ("det_jp", "det_jq", "condition_index"))
    tape = found.tape
    rng = np.random.default_rng(1)
    poses = np.array([rng.uniform(*mechanism.box[axis], 500) for axis in mechanism.platform.pose])
    uniform = found.uniform(mode_signs(mechanism, "inverse", mechanism.modes.default_working))
    parameters = [item for item in tape.uniform if item.startswith("p.")]
    wrt = [*tape.varying, *parameters]
    given = found.prepared(poses)
    slopes = gradient(tape, ["det_jp", "det_jq", "condition_index"], wrt)
    values = slopes.evaluate(given, uniform)
    fine = np.all([np.isfinite(np.broadcast_to(value, 500)) for value in values.values()], axis=0)
    assert fine.sum() > 100
    for place, item in enumerate(wrt):
        step = 1e-6 * max(1.0, *(abs(uniform) if item in parameters else [1.0]))
        moved = [_evaluated(tape, given, uniform, item, sign * step) for sign in (1, -1)]
        for output in ("det_jp", "det_jq", "condition_index"):
            exact = np.broadcast_to(values[derivative(output, item)], 500)[fine]
            rough = ((moved[0][output] - moved[1][output]) / (2 * step) + np.zeros(500))[fine]
            size = np.abs(exact).max() + np.abs(tape.evaluate(given, uniform)[output]).max() * 1e-9 / step
            assert np.quantile(np.abs(exact - rough), 0.8) < 1e-5 * size, (place, output)
        if item in tape.varying:
            exact = _by_duals(mechanism, poses, item)
            for output, dual in exact.items():
                np.testing.assert_allclose(
                    np.broadcast_to(values[derivative(output, item)], 500)[fine],
                    np.broadcast_to(dual.derivative if isinstance(dual, Dual) else 0.0, 500)[fine],
                    rtol=1e-7,
                    atol=1e-7 * np.abs(dual.value).max() if isinstance(dual, Dual) else 0,
                )


def _evaluated(tape, given, uniform, item, step):
    varying = [row + step * (name == item) for row, name in zip(given, tape.varying, strict=True)]
    return tape.evaluate(
        varying, [value + step * (name == item) for value, name in zip(uniform, tape.uniform, strict=True)]
    )


def _by_duals(mechanism, poses, item):
    """The kernel itself over dual numbers, without any recording."""
    form = mechanism.closed_form
    pose = [Dual(row, 1.0 if name == item else 0.0) for row, name in zip(poses, mechanism.platform.pose, strict=True)]
    signs = mode_signs(mechanism, "inverse", mechanism.modes.default_working)
    sign = SimpleNamespace(**dict(zip(mechanism.modes.working, map(float, signs), strict=True)))
    branch = form.inverse(Duals(), mechanism.values, pose, sign)
    jp, jq = form.jacobians(Duals(), mechanism.values, branch.core)
    return {"det_jp": by_cofactors(jp), "det_jq": by_cofactors(jq)}


def test_a_compiled_gradient_has_the_bits_of_its_tape(tape, points):
    slopes = gradient(tape, ["value"], NAMES)
    found, wanted = compiled(slopes)(points, [1.7]), slopes.evaluate(points, [1.7])
    for name, value in wanted.items():
        np.testing.assert_array_equal(found[name], np.broadcast_to(value, found[name].shape))
