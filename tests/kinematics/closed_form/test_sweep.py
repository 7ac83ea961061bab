"""Sweeps: the same numbers as one problem at a time, whatever the block, in no more memory than the answer."""

from __future__ import annotations

import hashlib
import tracemalloc

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form.sweep import (
    WANT,
    direct_all_sweep,
    inverse_all_expanded_sweep,
    inverse_all_sweep,
    inverse_sweep,
)
from assur.kinematics.modes import all_modes

COUNT = 4999  # odd, and no multiple of any block
WITH_BRANCHES = [name for name in assur.names() if callable(assur.load(name).closed_form.direct)]
"""Mechanisms whose direct problem is told by branches of signs, not by a polynomial or a search."""


@pytest.fixture(params=WITH_BRANCHES)
def mechanism(request):
    return assur.load(request.param)


@pytest.fixture
def zeng():
    return assur.load("zeng2019")


def poses_of(mechanism, count=COUNT):
    """Random poses (m, N) in the mechanism's box, or about its home pose."""
    rng = np.random.default_rng(5)
    limits = [mechanism.box[name] for name in mechanism.platform.pose]
    return np.array([rng.uniform(low, high, count) for low, high in limits])


def inputs_of(mechanism, count=COUNT):
    """Inputs (n, N): those of poses that exist, and every third with a first input far from them."""
    poses = poses_of(mechanism, 6 * count)
    found = inverse_sweep(mechanism, poses)
    real = found["inputs"][:, found["exists"]]
    assert real.shape[1] > 50
    rng = np.random.default_rng(6)
    picked = real[:, rng.integers(real.shape[1], size=count)]
    picked[0, ::3] = rng.normal(real[0].mean(), 6 * real[0].std(), size=len(picked[0, ::3]))
    return picked


def jobs(mechanism):
    poses, inputs = poses_of(mechanism), inputs_of(mechanism)
    return {
        "one": lambda **options: list(inverse_sweep(mechanism, poses, **options).values()),
        "distinct": lambda **options: _flat(inverse_all_sweep(mechanism, poses, **options)),
        "expanded": lambda **options: list(inverse_all_expanded_sweep(mechanism, poses, **options)),
        "direct": lambda **options: list(direct_all_sweep(mechanism, inputs, **options)),
    }


def _flat(answer):
    inputs, exists = answer
    return [*inputs, exists]


def _digest(arrays):
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(repr((array.shape, array.dtype)).encode() + array.tobytes())
    return digest.hexdigest()


@pytest.mark.parametrize("job", ["one", "distinct", "expanded", "direct"])
def test_bits_do_not_depend_on_the_block(mechanism, job):
    work = jobs(mechanism)[job]
    digests = {block: _digest(work(block=block)) for block in (7, 1000, 4096, COUNT, 10 * COUNT)}
    assert len(set(digests.values())) == 1, digests


def test_agrees_with_one_mode_at_a_time_of_the_solution_set(mechanism):
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


def test_determinants_are_those_of_the_velocity_map(mechanism):
    poses = poses_of(mechanism)
    swept = inverse_sweep(mechanism, poses)
    real = swept["exists"]
    here = mechanism.velocity_map(poses[:, real].T)
    for name, matrix in (("det_jp", here.jp), ("det_jq", here.jq)):
        size = np.prod(np.linalg.norm(matrix, axis=-1), axis=-1).max()  # Hadamard: no determinant is larger
        np.testing.assert_allclose(swept[name][real], np.linalg.det(matrix), rtol=1e-9, atol=1e-12 * size)


def test_determinants_are_the_products_of_their_factors(zeng):
    poses = poses_of(zeng)
    swept = inverse_sweep(zeng, poses, "+---+")
    named = dict(zip([item.name for item in zeng.closed_form.factor_list], swept["factors"], strict=True))
    parallel = named["u1_minus_u2"] * named["w"] * named["v"] * named["sin_alpha_minus_beta"]
    serial = named["u1"] * named["u2"] * named["u3"] * named["sin_alpha"] * named["sin_beta"]
    for found, expected in ((swept["det_jp"], parallel), (swept["det_jq"], serial)):
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12 * 280**3)


def test_every_row_of_the_expanded_answer_is_its_mode(mechanism):
    poses = poses_of(mechanism)
    inputs, exists = inverse_all_expanded_sweep(mechanism, poses, block=999)
    modes = all_modes(mechanism, "inverse")
    assert inputs.shape == (len(modes), len(mechanism.inputs), COUNT)
    for k, mode in enumerate(modes):
        one = inverse_sweep(mechanism, poses, mode, ("inputs", "exists"))
        np.testing.assert_array_equal(inputs[k], one["inputs"])
        np.testing.assert_array_equal(exists[k], one["exists"])


def test_distinct_numbers_broadcast_to_the_expanded_answer(mechanism):
    poses = poses_of(mechanism)
    distinct, exists = inverse_all_sweep(mechanism, poses)
    expanded, all_exist = inverse_all_expanded_sweep(mechanism, poses)
    axes = (2,) * len(mechanism.modes.working)
    for k, values in enumerate(distinct):
        wide = np.broadcast_to(values, (*axes, COUNT)).reshape(-1, COUNT)
        np.testing.assert_array_equal(wide, expanded[:, k])
    np.testing.assert_array_equal(np.broadcast_to(exists, (*axes, COUNT)).reshape(-1, COUNT), all_exist)


def test_32_inverses_are_12_numbers(zeng):
    distinct, exists = inverse_all_sweep(zeng, poses_of(zeng))
    assert [values.size // COUNT for values in distinct] == [4, 4, 4]
    assert exists.size // COUNT == 4


def test_directs_contain_the_pose_whose_inputs_they_are_given(mechanism):
    poses = poses_of(mechanism)
    found = inverse_sweep(mechanism, poses)
    sizes = np.abs(found["factors"]) / np.abs(found["factors"]).max(axis=1, keepdims=True)
    regular = found["exists"] & np.all(sizes > 1e-3, axis=0)
    assert regular.sum() > 50
    directs, exist = direct_all_sweep(mechanism, found["inputs"][:, regular])
    gaps = np.abs(directs - poses[:, regular]).max(axis=1)  # (K, N)
    np.testing.assert_array_less(np.where(exist, gaps, np.inf).min(axis=0), 1e-8 * np.ptp(poses))


def test_directs_agree_with_the_solution_set(mechanism):
    inputs = inputs_of(mechanism)
    poses, exist = direct_all_sweep(mechanism, inputs, block=100)
    found = mechanism.direct(inputs.T)
    np.testing.assert_array_equal(exist.T, found.exists)
    assert exist.any()
    np.testing.assert_array_equal(np.moveaxis(poses, 2, 0)[exist.T], found.poses[exist.T])


@pytest.mark.parametrize(("x", "exists"), [(80.0, True), (79.9999, True), (80.0 + 1e-15, True), (80.0 + 1e-6, False)])
def test_existence_ends_where_a_margin_ends(zeng, x, exists):
    # x + b - d = l4 at x = 80: link 12 lies along X, the margin is zero to rounding and the branch still exists
    assert inverse_sweep(zeng, ([x], [0.0], [250.0]), "++-++")["exists"].tolist() == [exists]


@pytest.mark.parametrize(("gap", "exists"), [(0.0, False), (1e-3, True), (-1e-3, True)])
def test_self_motion_is_no_pose(zeng, gap, exists):
    # B = yA1 - l3 - yA2 = 0 lets the platform move with all inputs locked: a curve, of which no sample is listed
    _, exist = direct_all_sweep(zeng, ([100.0 + gap], [-40.0], [60.0]))
    assert bool(exist.any()) is exists


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
    distinct, exists = inverse_all_sweep(mechanism, np.empty((m, 0)))
    assert len(distinct) == n
    assert exists.shape[-1] == 0
    assert inverse_all_expanded_sweep(mechanism, np.empty((m, 0)))[0].shape[1:] == (n, 0)
    assert direct_all_sweep(mechanism, np.empty((n, 0)))[0].shape[1:] == (m, 0)


@pytest.mark.parametrize("want", WANT)
def test_only_what_is_wanted(zeng, want):
    poses = poses_of(zeng)
    alone = inverse_sweep(zeng, poses, want=(want,))
    assert list(alone) == [want]
    np.testing.assert_array_equal(alone[want], inverse_sweep(zeng, poses)[want])


@pytest.mark.parametrize("job", ["one", "distinct", "expanded", "direct"])
def test_progress_is_told_after_every_block(zeng, job):
    calls = []
    jobs(zeng)[job](block=2000, progress=lambda done, total: calls.append((done, total)))
    assert calls == [(2000, COUNT), (4000, COUNT), (COUNT, COUNT)]


@pytest.mark.parametrize("job", ["one", "distinct", "expanded", "direct"])
def test_memory_is_the_answer_and_a_block(zeng, job):
    work, block = jobs(zeng)[job], 250
    work(block=block)  # whatever is kept from call to call
    tracemalloc.start()
    answer = work(block=block)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    size = sum(array.nbytes for array in answer)
    branches = 8 if job == "direct" else 4
    assert peak - size < 80 * branches * 8 * block  # fewer than 80 temporaries of a block
    assert 80 * branches * 8 * block < COUNT * 8 * 20 * branches  # which is far less than 80 of all poses


@pytest.mark.parametrize("block", [0, -1])
def test_refuses_an_empty_block(zeng, block):
    with pytest.raises(UsageError, match="block"):
        inverse_sweep(zeng, poses_of(zeng), block=block)


def test_refuses_wrong_names_and_components(zeng):
    poses = poses_of(zeng, 10)
    with pytest.raises(UnknownNameError, match="det_jp"):
        inverse_sweep(zeng, poses, want=("determinant",))
    with pytest.raises(UnknownNameError, match="working mode"):
        inverse_sweep(zeng, poses, "+++")
    with pytest.raises(UsageError, match="2 components, 3 wanted"):
        inverse_sweep(zeng, poses[:2])
    with pytest.raises(UsageError, match="shapes"):
        inverse_all_sweep(zeng, (poses[0], poses[1], poses[2, :5]))
    with pytest.raises(UsageError, match="shapes"):
        direct_all_sweep(zeng, (1.0, 2.0, 3.0))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_refuses_what_is_not_finite(zeng, bad):
    poses = poses_of(zeng, 10)
    poses[1, 7] = bad
    with pytest.raises(UsageError, match="finite"):
        inverse_all_expanded_sweep(zeng, poses, block=4)


def test_condition_index_is_that_of_the_velocity_map_by_svd(mechanism):
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
def test_bits_do_not_depend_on_threads(zeng, threads):
    for job, work in jobs(zeng).items():
        assert _digest(work(block=999, threads=threads)) == _digest(work(block=COUNT)), job
