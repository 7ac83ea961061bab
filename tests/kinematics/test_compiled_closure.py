"""Newton's method as one loop: the same assemblies as damped least squares, and honest where there is none."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics import compiled_closure as module
from assur.kinematics.closure import CLOSED, assemble, characteristic_length, closure_error, mobility
from assur.kinematics.compiled_closure import assemblies_around, compiled_closure
from assur.kinematics.pose import pose_of
from catalogue import each

SPIN = {"delta_4s", "h4_robot", "linear_delta_4s"}
"""Mechanisms with rods that spin: what turns them is no part of the answer."""
AGREED = 1e-12


def _units(mechanism):
    return np.array(
        [characteristic_length(mechanism) if item.kind == "length" else 1.0 for item in mechanism.coordinates]
    )


def _starts(mechanism, count=60, away=0.04, push=0.01):
    """Assemblies around home, with their inputs pushed a little."""
    rng, units, held = np.random.default_rng(1), _units(mechanism), list(mechanism.input_indices)
    around = mechanism.home_values + rng.uniform(-away, away, (count, len(units))) * units
    found = assemble(mechanism, around, held=held, near=True)
    start = found.values[found.closed]
    start[:, held] += rng.uniform(-push, push, (len(start), len(held))) * units[held]
    return start


@pytest.mark.parametrize("name", each())
def test_neighbouring_starts_close_as_by_least_squares(name):
    mechanism = assur.load(name)
    held, length = list(mechanism.input_indices), characteristic_length(mechanism)
    start = _starts(mechanism)
    closure = compiled_closure(mechanism, held)
    found = closure(start, engine="numpy")
    expected = assemble(mechanism, start, held=held, near=True, tolerance=1e-14, max_steps=20)
    assert len(start) > 50
    assert np.mean(found.closed) > 0.98
    np.testing.assert_array_equal(found.closed, expected.closed)
    np.testing.assert_array_equal(found.values[:, held], start[:, held])
    assert np.all(closure_error(mechanism, found.values[found.closed]) <= AGREED * length)
    np.testing.assert_allclose(found.residual, closure_error(mechanism, found.values), atol=1e-14 * length, rtol=1e-6)
    one, other = (pose_of(mechanism, item.values[found.closed]) for item in (found, expected))
    np.testing.assert_allclose(one, other, rtol=0, atol=AGREED * max(length, 1.0))
    if name not in SPIN:
        gaps = np.abs(found.values - expected.values)[found.closed] / _units(mechanism)
        assert gaps.max() <= AGREED


@pytest.mark.parametrize("name", each())
def test_as_many_unknowns_as_independent_equations(name):
    """The rank by singular values, of a matrix that was written elsewhere."""
    mechanism = assur.load(name)
    held = mechanism.input_indices
    closure = compiled_closure(mechanism, held)
    samples = assemblies_around(mechanism, mechanism.home_values, held)
    assert not set(closure.unknowns) & set(held)
    assert {len(closure.unknowns)} == set(mobility(mechanism, samples).rank.tolist())


def test_machine_code_has_the_same_bits_whatever_the_block(monkeypatch):
    mechanism = assur.load("zeng2019")
    start = _starts(mechanism, 333)
    closure = compiled_closure(mechanism, mechanism.input_indices)
    expected = closure(start, engine="numpy").values
    for block in (1024, 100, 37):
        monkeypatch.setattr(module, "BLOCK", block)
        one = closure(start, engine="compiled")
        other = closure(start, engine="numpy")
        np.testing.assert_array_equal(one.values, other.values)
        np.testing.assert_array_equal(one.residual, other.residual)
        np.testing.assert_array_equal(one.values, expected)


def test_neighbours_change_no_bit():
    """Some starts are closed already, some need more steps than others: each ends where it does alone."""
    mechanism = assur.load("zeng2019")
    away = [_starts(mechanism, 4, push=push) for push in (0.0, 1e-9, 1e-5, 1e-3, 0.02)]
    start = np.concatenate(away)
    closure = compiled_closure(mechanism, mechanism.input_indices)
    together = closure(start, engine="numpy")
    alone = [closure(one, engine="numpy") for one in start]
    assert len({one.steps for one in alone}) > 2
    np.testing.assert_array_equal(together.values, np.stack([one.values for one in alone]))
    np.testing.assert_array_equal(together.residual, np.stack([one.residual for one in alone]))


def test_other_dimensions_share_the_program():
    one = compiled_closure(assur.load("fivebar"), [0, 3])
    longer = assur.load("fivebar", **_stretched(assur.load("fivebar")))
    other = compiled_closure(longer, [0, 3])
    assert one.tape.operations == other.tape.operations
    assert not np.array_equal(one.numbers, other.numbers)


def _stretched(mechanism):
    name, item = next((name, item) for name, item in mechanism.parameters.items() if item.value > 0.0)
    return {name: 1.01 * item.value}


def test_starts_from_anywhere_are_never_called_closed_where_they_are_not():
    """Most are too far for Newton's method; least squares has them, and some are closest approaches."""
    mechanism = assur.load("fivebar")
    start = np.random.default_rng(2).uniform(-np.pi, np.pi, (400, len(mechanism.coordinates)))
    held = list(mechanism.input_indices)
    found = compiled_closure(mechanism, held)(start, engine="numpy")
    length = characteristic_length(mechanism)
    true = closure_error(mechanism, found.values)
    np.testing.assert_array_equal(found.closed, true <= CLOSED * length)
    assert 0.5 < np.mean(found.closed) < 1.0
    np.testing.assert_allclose(found.residual, true, atol=1e-13 * length, rtol=1e-6)


def test_crossed_parallelograms_are_closed_where_pivots_are_chosen_around_them(monkeypatch):
    mechanism = assur.load("zeng2019")
    held, home = list(mechanism.input_indices), np.array(mechanism.home_values)
    rng = np.random.default_rng(5)
    start = rng.uniform(-np.pi, np.pi, (200, len(home)))
    start[:, held] = home[held]
    found = assemble(mechanism, start, held=held)
    away = np.abs(pose_of(mechanism, found.values) - pose_of(mechanism, home)).max(axis=-1)
    other = found.values[found.closed & (away > 1.0)][0]
    near = other + rng.uniform(-1e-3, 1e-3, (20, len(other))) * _units(mechanism)
    near[:, held] = other[held]
    closure = compiled_closure(mechanism, held, around=other)
    monkeypatch.setattr(module, "assemble", lambda *_, **__: pytest.fail("Newton's method must do"))
    closed = closure(near, engine="numpy")
    assert np.all(closed.closed)
    np.testing.assert_allclose(closure_error(mechanism, closed.values), 0.0, atol=1e-9)


def test_shapes_are_those_of_the_start():
    mechanism = assur.load("fivebar")
    closure = compiled_closure(mechanism, mechanism.input_indices)
    home = np.array(mechanism.home_values)
    for shape in ((), (0,), (2, 3)):
        found = closure(np.broadcast_to(home, (*shape, len(home))))
        assert found.values.shape == (*shape, len(home))
        assert found.residual.shape == found.closed.shape == shape
    before = home.copy()
    closure(home + 0.0)
    np.testing.assert_array_equal(home, before)


def test_what_is_held_may_be_anything():
    """Nothing held: all the loops ask for is closed, and what they leave free stays."""
    mechanism = assur.load("fivebar")
    start = mechanism.home_values + np.array([[0.0, 0.02, 0.0, 0.01, 0.0]])
    closure = compiled_closure(mechanism, ())
    found = closure(start, engine="numpy")
    assert bool(found.closed[0])
    free = sorted(set(range(5)) - set(closure.unknowns))
    assert len(free) == 2
    np.testing.assert_array_equal(found.values[:, free], start[:, free])


@pytest.mark.parametrize(
    ("name", "held", "said"),
    [("fivebar", [7], "no joint values"), ("linear_delta_4s", "part", "ball joint")],
)
def test_misuse_is_refused(name, held, said):
    mechanism = assur.load(name)
    if held == "part":
        held = [next(item.index for item in mechanism.coordinates if item.component == "ry")]
    with pytest.raises(UsageError, match=said):
        compiled_closure(mechanism, held)


def test_around_is_one_assembly():
    with pytest.raises(UsageError, match="around"):
        compiled_closure(assur.load("fivebar"), [0, 3], around=np.zeros((2, 5)))


def test_where_nothing_closes_around_is_refused():
    """More joints held than there are freedoms: no neighbour closes."""
    mechanism = assur.load("fivebar")
    with pytest.raises(UsageError, match="no assembly near"):
        compiled_closure(mechanism, range(5))


def test_starts_and_engines_that_do_not_fit_are_refused(monkeypatch):
    mechanism = assur.load("fivebar")
    closure = compiled_closure(mechanism, mechanism.input_indices)
    with pytest.raises(UsageError, match="5 of them"):
        closure(np.zeros((3, 4)))
    with pytest.raises(UnknownNameError):
        closure(np.zeros((3, 5)), engine="fast")
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    assert bool(closure(np.array(mechanism.home_values)).closed)
