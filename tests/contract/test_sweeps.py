"""Every mechanism with a closed form: the recorded kernel, and its compiled loop, have the bits of NumPy."""

import numpy as np
import pytest

import assur
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.filling import finished
from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.closed_form.sweep import ALL_WANTED, inverse_sweep
from assur.kinematics.modes import mode_signs
from catalogue import each

NAMES = [name for name in assur.names() if assur.load(name).closed_form is not None]
WITH_BRANCHES = [name for name in NAMES if callable(assur.load(name).closed_form.direct)]
COMPILED = ("zeng2019", "planar_3rrr")
COUNT = 1999


def poses_of(mechanism):
    rng = np.random.default_rng(11)
    return np.array([rng.uniform(*mechanism.box[name], COUNT) for name in mechanism.platform.pose])


def inputs_of(mechanism):
    """Inputs of poses that exist, one of them moved for every third."""
    found = inverse_sweep(mechanism, np.tile(poses_of(mechanism), 4))
    real = found["inputs"][:, found["exists"]]
    rng = np.random.default_rng(12)
    picked = real[:, rng.integers(real.shape[1], size=COUNT)]
    picked[0, ::3] = rng.normal(real[0].mean(), 4 * real[0].std(), size=len(picked[0, ::3]))
    return picked


def same(found, wanted):
    assert found.shape == wanted.shape
    assert found.dtype == wanted.dtype
    np.testing.assert_array_equal(found, wanted)  # NaN equals NaN, 0.0 equals -0.0


def evaluated(tape, given, signs=()):
    """Rows and truths of a tape by NumPy, entry by entry."""
    values = tape.tape.evaluate(tape.prepared(given), tape.uniform(signs))
    wide = {name: np.broadcast_to(np.asarray(value), given.shape[1]) for name, value in values.items()}
    with np.errstate(divide="ignore", invalid="ignore"):
        rows = {name: np.array([finished(row, wide) for row in items]) for name, items in tape.rows.items()}
    return rows, np.array([wide[name] for name in tape.truths])


@pytest.mark.parametrize("name", NAMES)
def test_one_mode_recorded(name):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    wanted = inverse_sweep(mechanism, poses_of(mechanism), mode, ALL_WANTED, engine="numpy")
    assert wanted["exists"].any()
    tape = recording(mechanism, "inverse", ALL_WANTED)
    rows, truths = evaluated(tape, poses_of(mechanism), mode_signs(mechanism, "inverse", mode))
    same(truths[0], wanted.pop("exists"))
    for quantity, values in wanted.items():
        same(rows[quantity] if values.ndim == 2 else rows[quantity][0], values)


@pytest.mark.parametrize("name", NAMES)
def test_every_inverse_recorded(name):
    mechanism = assur.load(name)
    inputs, exists = all_modes_sweep(mechanism, "inverse", poses_of(mechanism), engine="numpy")
    rows, truths = evaluated(recording(mechanism, "inverse", every=True), poses_of(mechanism))
    same(rows["inputs"].reshape(inputs.shape), inputs)
    same(truths, exists)


@pytest.mark.parametrize("name", WITH_BRANCHES)
def test_every_direct_recorded(name):
    mechanism = assur.load(name)
    poses, exists = all_modes_sweep(mechanism, "direct", inputs_of(mechanism), engine="numpy")
    assert exists.any()
    rows, truths = evaluated(recording(mechanism, "direct", every=True), inputs_of(mechanism))
    same(rows["poses"].reshape(poses.shape), poses)
    same(truths, exists)


@pytest.mark.parametrize("name", each(NAMES, COMPILED))
def test_one_mode_compiled(name):
    """Of two in the quick run: the recording of every one has NumPy's bits, machine code those of each operation."""
    mechanism, want = assur.load(name), ALL_WANTED[:5]
    wanted = inverse_sweep(mechanism, poses_of(mechanism), want=want, engine="numpy")
    for block, threads in ((COUNT, 1), (333, 2)):
        found = inverse_sweep(
            mechanism, poses_of(mechanism), want=want, engine="compiled", block=block, threads=threads
        )
        assert list(found) == list(wanted)
        for quantity, values in wanted.items():
            same(found[quantity], values)


@pytest.mark.parametrize("name", each(NAMES, COMPILED))
def test_every_branch_compiled(name):
    mechanism = assur.load(name)
    poses = poses_of(mechanism)
    jobs = [("inverse", poses)]
    if name in WITH_BRANCHES:
        jobs.append(("direct", inputs_of(mechanism)))
    for problem, given in jobs:
        for found, values in zip(
            all_modes_sweep(mechanism, problem, given, engine="compiled", threads=2, block=700),
            all_modes_sweep(mechanism, problem, given, engine="numpy"),
            strict=True,
        ):
            same(found, values)
