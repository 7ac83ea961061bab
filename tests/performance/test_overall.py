"""Means and extremes over a region against quadrature and known bounds; errors that cover."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.performance.indices import INDICES, indices
from assur.performance.overall import STUDENT, global_condition_index, overall
from assur.workspace.region import workspace

ZENG = assur.load("zeng2019")


@dataclass(frozen=True)
class Cube:
    """A region that is a box: volume known."""

    mode: str
    low: tuple[float, ...]
    high: tuple[float, ...]
    unit: str = "mm^3"
    volume_error: float = 0.0

    @property
    def volume(self):
        return float(np.prod(np.subtract(self.high, self.low)))

    def interior(self, count, rng):
        return rng.uniform(self.low, self.high, size=(count, len(self.low)))

    def inside(self, count, rng):
        return self.interior(count, rng), None


def orthoglide_cube():
    mechanism = assur.load("orthoglide")
    low, high = -mechanism.values.L / np.sqrt(6), mechanism.values.L / np.sqrt(18)
    return mechanism, Cube("+++", (low,) * 3, (high,) * 3)


def test_the_orthoglide_s_cube_has_the_bounds_of_its_design_within_the_errors():
    """Velocity factors between 1/2 and 2, both met at a corner, so never at an inner point: the errors say how far."""
    mechanism, cube = orthoglide_cube()
    found = overall(mechanism, cube, 2**12)
    slowest, fastest = found.values["smallest"], found.values["largest"]
    assert 0.5 < slowest.least < 0.5 + 4 * slowest.least_error + 0.02
    assert 2.0 - 4 * fastest.most_error - 0.02 < fastest.most < 2.0
    assert slowest.least_error > 0
    at = indices(mechanism, slowest.least_at)
    assert at["smallest"] == pytest.approx(slowest.least, rel=1e-12)
    assert (found.points, found.singular, found.factor_unit, found.length) == (2**12, 0, "", None)


def test_means_and_the_good_part_are_those_of_quadrature_within_their_errors():
    mechanism, cube = orthoglide_cube()
    nodes = cube.low[0] + (cube.high[0] - cube.low[0]) * (np.arange(24) + 0.5) / 24
    grid = np.stack(np.meshgrid(nodes, nodes, nodes, indexing="ij"), axis=-1).reshape(-1, 3)
    exact = indices(mechanism, grid)
    found = overall(mechanism, cube, 2**12)
    for name in INDICES:
        value = found.values[name]
        assert abs(value.mean - np.mean(exact[name])) < 2.0 * value.mean_error + 2e-4 * value.mean
        assert 0 < value.mean_error < 0.02 * value.mean
    share = np.mean(exact["transmission"] >= 0.7)
    assert 0.2 < share < 1.0
    assert abs(found.good.share - share) < 2.0 * found.good.share_error + 2e-3
    assert found.good.volume == pytest.approx(found.good.share * 200.0**3, rel=1e-9)
    assert found.good.volume_error == pytest.approx(found.good.share_error * 200.0**3, rel=1e-9)
    assert found.good.unit == "mm^3"


def test_the_mean_of_the_condition_index_is_the_global_condition_index():
    mechanism = assur.load("zeng2019")
    region = workspace(mechanism, resolution=8, near=300)
    known = global_condition_index(mechanism, region, 2**11)
    found = overall(mechanism, region, 2**11)
    value = found.values["condition"]
    assert value.mean == pytest.approx(known.value, rel=1e-9)
    assert value.mean_error == pytest.approx(known.error, rel=1e-6)
    assert found.points == known.points + known.singular
    assert found.mode == region.mode


def test_the_errors_of_share_and_mean_cover_what_forty_seeds_find():
    """95 % intervals, so two of forty miss on average; the truth is from a grid of nodes."""
    mechanism = assur.load("fivebar")
    plane = Cube("-+", (-100.0, 100.0), (100.0, 200.0), "mm^2")
    cells = (np.arange(120) + 0.5) / 120
    xs, ys = (low + (high - low) * cells for low, high in zip(plane.low, plane.high, strict=True))
    exact = indices(mechanism, np.stack(np.meshgrid(xs, ys), axis=-1))
    share, mean = np.mean(exact.transmission.good), np.mean(exact["transmission"])
    assert 0.2 < share < 0.8
    found = [overall(mechanism, plane, 512, rng=np.random.default_rng(seed)) for seed in range(40)]
    assert sum(abs(item.good.share - share) <= item.good.share_error for item in found) >= 33
    values = [item.values["transmission"] for item in found]
    assert sum(abs(value.mean - mean) <= value.mean_error for value in values) >= 33
    spread = np.std([value.mean for value in values])
    assert np.mean([value.mean_error for value in values]) / STUDENT == pytest.approx(spread, rel=0.35)


def test_the_length_is_one_for_the_whole_region():
    mechanism = assur.load("planar_3rpr")
    cube = Cube(mechanism.modes.default_working, *(np.array([mechanism.box[n] for n in ("x", "y", "phi")]).T / 4))
    found = overall(mechanism, cube, 256, "isotropic")
    poses = cube.interior(200, np.random.default_rng(1))
    assert found.length == pytest.approx(indices(mechanism, poses, cube.mode, "isotropic").length, rel=0.2)
    fixed = overall(mechanism, cube, 256, 2 * found.length)
    assert fixed.length == 2 * found.length
    assert fixed.values["condition"].mean < found.values["condition"].mean
    assert fixed.values["transmission"].mean == found.values["transmission"].mean


def test_an_empty_region_says_nothing():
    mechanism = assur.load("zeng2019")
    found = overall(mechanism, workspace(mechanism, box={"x": (200, 300)}, resolution=8), 256)
    assert (found.points, found.values, found.good) == (0, {}, None)


@pytest.mark.parametrize("count", [0, 100, 1e5, True])
def test_a_number_of_points_that_is_none_is_refused(count):
    mechanism, cube = orthoglide_cube()
    with pytest.raises(UsageError, match="count"):
        overall(mechanism, cube, count)


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_over_a_region_that_was_followed_the_values_are_those_of_the_closed_form(name):
    record = assur.load(name)
    known = workspace(record, resolution=12)
    found = workspace(replace(record, closed_form=None), resolution=12)
    first, second = overall(record, known, 512), overall(replace(record, closed_form=None), found, 512)
    assert second.points == first.points
    for index, value in first.values.items():
        assert second.values[index].mean == pytest.approx(value.mean, rel=1e-6), index
        assert second.values[index].least == pytest.approx(value.least, rel=1e-4, abs=1e-6), index
    assert second.good.share == pytest.approx(first.good.share)
    mean, same = (global_condition_index(some, region, 512) for some, region in ((record, known), (record, found)))
    assert same.value == pytest.approx(mean.value, rel=1e-6)
    assert (same.points, same.singular) == (mean.points, mean.singular)


def test_the_mean_over_the_paper_s_workspace_is_that_of_quadrature_within_its_error():
    """Second route: nothing depends on y, so a midpoint rule over the exact interval of z at x = 80 - s^2."""
    p = ZENG.values
    n = 300
    s = np.sqrt(190.0) * (np.arange(n) + 0.5) / n
    x = p.l4 - p.b + p.d - s**2
    c1 = p.l1 + np.sqrt(p.l4**2 - (x + p.b - p.d) ** 2)
    c3 = p.l1 + np.sqrt(p.l6**2 - (x - p.b + p.d) ** 2)
    top = np.minimum(480.0, np.minimum(c1 + p.l2, c3 + p.l6))
    bottom = np.maximum(180.0, np.maximum(c1 - p.l2, c3 - p.l6))
    span = np.maximum(top - bottom, 0.0)
    z = bottom[:, None] + span[:, None] * (np.arange(n) + 0.5) / n
    poses = np.stack(np.broadcast_arrays(x[:, None], 0.0, z), axis=-1)
    index = indices(ZENG, poses)["condition"]
    weights = np.broadcast_to((2 * s * span)[:, None], index.shape)
    exact = np.nansum(weights * index) / np.sum(weights * np.isfinite(index))
    found = global_condition_index(ZENG, workspace(ZENG, resolution=16))
    assert abs(found.value - exact) < 1.3 * found.error  # three standard errors
    assert found.error < 0.01 * exact
    assert found.points > 20_000


def test_the_error_of_the_mean_covers_other_seeds():
    region = workspace(ZENG, resolution=8, near=300)
    best = global_condition_index(ZENG, region, 2**17).value
    found = [global_condition_index(ZENG, region, 2**11, np.random.default_rng(seed)) for seed in range(12)]
    inside = [abs(item.value - best) <= item.error for item in found]
    assert sum(inside) >= 9
    assert all(abs(item.value - best) > 0 for item in found)


def test_an_empty_region_has_no_mean():
    found = global_condition_index(ZENG, workspace(ZENG, box={"x": (200, 300)}, resolution=8))
    assert (found.value, found.error, found.points) == (None, None, 0)
