"""Stored sweeps: at every problem of a block the status and the numbers of the single answer, for every mechanism."""

import tracemalloc

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.closed_form_sweep import ClosedFormSweep
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import ALL, stored_sweep
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.status import Status
from assur.model.dimensions import with_parameters

COUNTS = 40
RECORDS = [record for record in map(assur.load, assur.names()) if record.closed_form is not None]
SIGNED = [record for record in RECORDS if callable(record.closed_form.direct)]
POSED = [record for record in RECORDS if "qw" not in record.platform.pose]


def sweep_of(record, problem, mode="", keep=()):
    names = record.platform.pose if problem == "inverse" else border.input_names(record)
    zeros = (0.0,) * len(names)
    return stored_sweep(record, problem, Grid(names, zeros, zeros, (2,) * len(names)), mode, keep)


def around_home(record, problem):
    """Problems (N, k): home itself, near it, and so far off that some have no solution."""
    home = home_values(record)
    start = pose_of(record, home) if problem == "inverse" else border.inputs_of(record, home)
    size = np.maximum(np.abs(start), 0.2 * np.max(np.abs(start)))
    steps = np.random.default_rng(7).uniform(-1.0, 1.0, (COUNTS, len(start)))
    steps[0] = 0.0
    given = start + steps * size * np.linspace(0.0, 2.5, COUNTS)[:, None]
    return border.in_range(record, given) if problem == "inverse" else given


def in_file_angles(record, values, names):
    if record.angle != "deg":
        return values
    kinds = {item.name: item.coordinate.kind for item in record.inputs}
    scale = [
        np.pi / 180 if kinds.get(name, "angle" if name in ("phi", "theta", "psi") else "") == "angle" else 1
        for name in names
    ]
    return values / np.array(scale)


@pytest.mark.parametrize("record", POSED, ids=lambda record: record.name)
def test_an_inverse_block_is_the_single_answers(record):
    given, mode = around_home(record, "inverse"), record.modes.default_working
    found = sweep_of(record, "inverse", keep=("inputs", "exists", "status")).solve(given.T)
    every = sweep_of(record, "inverse", ALL, ("inputs", "status")).solve(given.T)
    assert found["exists"].any()
    for k, one in enumerate(given):
        answer = record.inverse(one, mode)
        assert Status(found["status"][k]) == answer.overall_status
        wanted = in_file_angles(record, answer.inputs[0], border.input_names(record))
        np.testing.assert_allclose(found["inputs"][:, k], wanted, rtol=1e-12, atol=1e-9)
        answer = record.inverse(one)
        np.testing.assert_array_equal(every["status"][:, k], answer.status)
        wanted = in_file_angles(record, answer.inputs, border.input_names(record))
        np.testing.assert_allclose(every["inputs"][:, :, k], wanted, rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize("record", SIGNED, ids=lambda record: record.name)
def test_a_direct_block_is_the_single_answers(record):
    given = around_home(record, "direct")
    sweep = sweep_of(record, "direct", keep=("poses", "exists", "status"))
    found = sweep.solve(given.T)
    assert found["exists"].any()
    for k, one in enumerate(given):
        answer = record.direct(one)
        real = found["exists"][:, k]
        if answer.overall_status == Status.unreachable:
            assert (found["status"][:, k] == Status.unreachable).all()
            assert not real.any()
            continue
        np.testing.assert_array_equal(found["status"][:, k], answer.status)
        wanted = in_file_angles(record, answer.poses, record.platform.pose)
        np.testing.assert_allclose(found["poses"][:, :, k], wanted, rtol=1e-12, atol=1e-9)
    for row, mode in enumerate(sweep.modes):
        one = sweep_of(record, "direct", mode, ("poses", "exists", "status")).solve(given.T)
        for name, values in one.items():
            np.testing.assert_array_equal(values, found[name][row])


@pytest.mark.parametrize(
    ("inputs", "status"), [((140.0, 0.0, 0.0), Status.self_motion), ((140.0, 0.0, 2000.0), Status.unreachable)]
)
def test_where_the_platform_may_move_while_the_inputs_stand_no_pose_is_kept(inputs, status):
    record = assur.load("zeng2019")
    found = sweep_of(record, "direct", keep=("poses", "exists", "status")).solve(np.array(inputs)[:, None])
    assert record.direct(inputs).overall_status == status
    assert (found["status"] == status).all()
    assert np.isnan(found["poses"]).all()
    assert not found["exists"].any()


def test_where_the_formulas_degenerate_it_is_undecided_as_alone():
    record = with_parameters(assur.load("fivebar"), l2=100.0)  # cranks as long as rods: P may stand on a motor
    poses = np.array([[-70.0, 0.0], [0.0, 100.0], [-70.0, 900.0]])
    for mode in ("-+", ALL):
        status = sweep_of(record, "inverse", mode).solve(poses.T)["status"]
        for k, pose in enumerate(poses):
            answer = record.inverse(pose, None if mode == ALL else mode)
            np.testing.assert_array_equal(status[..., k], answer.status[0] if mode != ALL else answer.status)
    assert status[0].tolist() == [Status.undecided, Status.regular, Status.unreachable]


def test_size_and_shapes_are_those_of_the_files(tmp_path):
    record = assur.load("zeng2019")
    grid = Grid(("x", "y", "z"), (-100.0, 5.0, 250.0), (90.0, 5.0, 500.0), (4, 1, 3))
    for mode, keep in (("", ("inputs", "exists", "status", "factors", "smallest")), (ALL, ("inputs", "exists"))):
        sweep, folder = stored_sweep(record, "inverse", grid, mode, keep), tmp_path / (mode or "one")
        with sweep.store(folder) as store:
            store.open()
            sweep.fill(store)
            found = store.finish()
        assert {name: values.shape for name, values in found.items()} == {one.name: one.shape for one in sweep.arrays}
        assert sum(values.nbytes for values in found.values()) == sweep.plan().bytes
        np.testing.assert_array_equal(np.isnan(found["inputs"]).any(axis=-3), ~found["exists"])


def test_memory_is_that_of_a_block(tmp_path, monkeypatch):
    record = assur.load("zeng2019")
    low, high = zip(*(record.box[name] for name in record.platform.pose), strict=True)
    monkeypatch.setattr(ClosedFormSweep, "block_length", 5000)

    def peak(counts):
        sweep = stored_sweep(
            record, "inverse", Grid(record.platform.pose, low, high, counts), keep=("inputs", "exists")
        )
        tracemalloc.start()
        with sweep.store(tmp_path / f"{counts[0]}") as store:
            store.open()
            sweep.fill(store, threads=1)
            store.finish()
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    peak((2, 50, 50))
    small, large = peak((4, 50, 50)), peak((200, 50, 50))  # 10^4 and 5 10^5 poses
    assert large - small < 0.1 * (200 - 4) * 50 * 50 * 25  # 25 bytes a pose; the digests of the blocks stay


def test_what_it_refuses():
    record = assur.load("zeng2019")
    grid = Grid(("x", "y"), (0.0, 0.0), (1.0, 1.0), (2, 2))
    with pytest.raises(UsageError, match="a grid of x, y"):
        stored_sweep(record, "inverse", grid)
    with pytest.raises(UnknownNameError, match="quantity of the direct problem 'det_jp'"):
        sweep_of(record, "direct", keep=("det_jp",))
    with pytest.raises(UnknownNameError, match="assembly mode"):
        sweep_of(record, "direct", "++-++")
    with pytest.raises(UsageError, match="no closed direct solution by signs"):
        sweep_of(assur.load("planar_3rpr"), "direct")
