"""Sweeps: the same numbers as one problem at a time, whatever the block, in no more memory than the answer."""

import hashlib
import tracemalloc

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.sweep import WANT, inverse_sweep


@pytest.fixture
def jobs(poses_of, inputs_of):
    """A function: every sweep of a mechanism by its name."""
    return lambda mechanism: _jobs(mechanism, poses_of(mechanism), inputs_of(mechanism))


def _jobs(mechanism, poses, inputs):
    return {
        "one": lambda **options: list(inverse_sweep(mechanism, poses, **options).values()),
        "expanded": lambda **options: list(all_modes_sweep(mechanism, "inverse", poses, **options)),
        "direct": lambda **options: list(all_modes_sweep(mechanism, "direct", inputs, **options)),
    }


def _digest(arrays):
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(repr((array.shape, array.dtype)).encode() + array.tobytes())
    return digest.hexdigest()


@pytest.mark.parametrize("job", ["one", "expanded", "direct"])
def test_bits_do_not_depend_on_the_block(mechanism, job, jobs, count):
    work = jobs(mechanism)[job]
    digests = {block: _digest(work(block=block)) for block in (7, 1000, 4096, count, 10 * count)}
    assert len(set(digests.values())) == 1, digests


def test_agrees_with_one_mode_at_a_time_of_the_solution_set(mechanism, poses_of):
    poses = poses_of(mechanism)
    found = mechanism.inverse(poses.T, mechanism.modes.default_working)
    swept = inverse_sweep(mechanism, poses, block=512)
    real = swept["exists"]
    assert real.sum() > 50
    np.testing.assert_array_equal(real, found.exists[:, 0])
    np.testing.assert_array_equal(swept["inputs"][:, real], found.inputs[real, 0].T)
    names = [item.name for item in mechanism.closed_form.factor_list]
    expected = np.array([found.factors[name][real, 0] for name in names])
    np.testing.assert_array_equal(swept["factors"][:, real], expected)


def test_determinants_are_those_of_the_velocity_map(mechanism, poses_of):
    poses = poses_of(mechanism)
    swept = inverse_sweep(mechanism, poses)
    real = swept["exists"]
    here = mechanism.velocity_map(poses[:, real].T)
    for name, matrix in (("det_jp", here.jp), ("det_jq", here.jq)):
        size = np.prod(np.linalg.norm(matrix, axis=-1), axis=-1).max()  # Hadamard: no determinant is larger
        np.testing.assert_allclose(swept[name][real], np.linalg.det(matrix), rtol=1e-9, atol=1e-12 * size)


def test_determinants_are_the_products_of_their_factors(zeng, poses_of):
    poses = poses_of(zeng)
    swept = inverse_sweep(zeng, poses, "+---+")
    named = dict(zip([item.name for item in zeng.closed_form.factor_list], swept["factors"], strict=True))
    parallel = named["u1_minus_u2"] * named["w"] * named["v"] * named["sin_alpha_minus_beta"]
    serial = named["u1"] * named["u2"] * named["u3"] * named["sin_alpha"] * named["sin_beta"]
    for found, expected in ((swept["det_jp"], parallel), (swept["det_jq"], serial)):
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12 * 280**3)


@pytest.mark.parametrize(("x", "exists"), [(80.0, True), (79.9999, True), (80.0 + 1e-15, True), (80.0 + 1e-6, False)])
def test_existence_ends_where_a_margin_ends(zeng, x, exists):
    # x + b - d = l4 at x = 80: link 12 lies along X, the margin is zero to rounding and the branch still exists
    assert inverse_sweep(zeng, ([x], [0.0], [250.0]), "++-++")["exists"].tolist() == [exists]


def test_no_poses_at_all(mechanism):
    n, m = len(mechanism.inputs), len(mechanism.platform.pose)
    found = inverse_sweep(mechanism, np.empty((m, 0)))
    assert {name: found[name].shape for name in WANT} == {
        "inputs": (n, 0),
        "exists": (0,),
        "det_jp": (0,),
        "det_jq": (0,),
        "factors": (len(mechanism.closed_form.factor_list), 0),
    }
    assert all_modes_sweep(mechanism, "inverse", np.empty((m, 0)))[0].shape[1:] == (n, 0)
    assert all_modes_sweep(mechanism, "direct", np.empty((n, 0)))[0].shape[1:] == (m, 0)


@pytest.mark.parametrize("want", WANT)
def test_only_what_is_wanted(zeng, want, poses_of):
    poses = poses_of(zeng)
    alone = inverse_sweep(zeng, poses, want=(want,))
    assert list(alone) == [want]
    np.testing.assert_array_equal(alone[want], inverse_sweep(zeng, poses)[want])


@pytest.mark.parametrize("job", ["one", "expanded", "direct"])
def test_progress_is_told_after_every_block(zeng, job, jobs, count):
    calls = []
    jobs(zeng)[job](block=2000, progress=lambda done, total: calls.append((done, total)))
    assert calls == [(2000, count), (4000, count), (count, count)]


@pytest.mark.parametrize("job", ["one", "expanded", "direct"])
def test_memory_is_the_answer_and_a_block(zeng, job, jobs, count):
    work, block = jobs(zeng)[job], 250
    work(block=block)  # whatever is kept from call to call
    tracemalloc.start()
    answer = work(block=block)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    size = sum(array.nbytes for array in answer)
    branches = 8 if job == "direct" else 4
    assert peak - size < 80 * branches * 8 * block  # fewer than 80 temporaries of a block
    assert 80 * branches * 8 * block < count * 8 * 20 * branches  # which is far less than 80 of all poses


@pytest.mark.parametrize("block", [0, -1])
def test_refuses_an_empty_block(zeng, block, poses_of):
    with pytest.raises(UsageError, match="block"):
        inverse_sweep(zeng, poses_of(zeng), block=block)


def test_refuses_wrong_names_and_components(zeng, poses_of):
    poses = poses_of(zeng, 10)
    with pytest.raises(UnknownNameError, match="det_jp"):
        inverse_sweep(zeng, poses, want=("determinant",))
    with pytest.raises(UnknownNameError, match="working mode"):
        inverse_sweep(zeng, poses, "+++")
    with pytest.raises(UsageError, match="2 components, 3 wanted"):
        inverse_sweep(zeng, poses[:2])
    with pytest.raises(UsageError, match="shapes"):
        all_modes_sweep(zeng, "inverse", (poses[0], poses[1], poses[2, :5]))
    with pytest.raises(UsageError, match="shapes"):
        all_modes_sweep(zeng, "direct", (1.0, 2.0, 3.0))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_refuses_what_is_not_finite(zeng, bad, poses_of):
    poses = poses_of(zeng, 10)
    poses[1, 7] = bad
    with pytest.raises(UsageError, match="finite"):
        all_modes_sweep(zeng, "inverse", poses, block=4)


def test_condition_index_is_that_of_the_velocity_map_by_svd(mechanism, poses_of):
    poses = poses_of(mechanism)
    swept = inverse_sweep(mechanism, poses, want=("exists", "condition_index", "smallest", "det_jp", "det_jq"))
    sizes = [np.abs(swept[name]) for name in ("det_jp", "det_jq")]
    real = swept["exists"] & np.all([size > 1e-3 * size[swept["exists"]].max() for size in sizes], axis=0)
    assert real.sum() > 20
    here = mechanism.velocity_map(poses[:, real].T)
    values = np.linalg.svd(np.linalg.solve(here.jp, here.jq), compute_uv=False)
    np.testing.assert_allclose(swept["condition_index"][real], values[:, -1] / values[:, 0], rtol=1e-7)
    np.testing.assert_allclose(swept["smallest"][real], values[:, -1], rtol=1e-7)


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_bits_do_not_depend_on_threads(zeng, threads, jobs, count):
    for job, work in jobs(zeng).items():
        assert _digest(work(block=999, threads=threads)) == _digest(work(block=count)), job
