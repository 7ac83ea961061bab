"""Figures of errors have the numbers of errors: bars of each tolerance, deviations, maps; none without tolerances."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.figures.accuracy import errors_drawn
from assur.figures.context import Context
from assur.machine.accuracy.error_maps import SQUARES, TURNED, WORST, error_maps
from assur.model.machine_data import Tolerance
from assur.workspace.region import workspace

OFF = {"l1": Tolerance(0.05, 0.02), "rod1.l2": Tolerance(0.03, 0.01), "theta1": Tolerance(1e-4, 3e-5)}


@pytest.fixture(scope="module")
def toleranced():
    record = assur.load("fivebar")
    return Context(replace(record, machine=replace(record.machine, tolerances=OFF)))


def test_bars_are_what_each_tolerance_does_and_the_ellipsoid_their_covariance(toleranced):
    data = figures.drawing(toleranced.record, "accuracy", toleranced).data
    own = toleranced.kept("errors", lambda: None)
    for name, tolerance in OFF.items():
        assert data["displacement"][name] == pytest.approx(
            1e3 * tolerance.bound * np.linalg.norm(own.sensitivity[name][:3])
        )
    sizes, ways = (np.array(data[name], dtype=float) for name in ("deviations", "directions"))
    np.testing.assert_allclose(ways.T @ np.diag(sizes**2) @ ways, own.covariance[:3, :3], atol=1e-15)
    turned = "(c)" in figures.spec(toleranced.record, "accuracy", toleranced).caption
    assert turned == bool(data["rotation"])


def test_the_map_is_that_of_the_workspace(toleranced):
    data = figures.drawing(toleranced.record, "errors", toleranced).data
    values = np.array(data["maps"][WORST]["values"], dtype=float)
    assert np.nanmin(values) > 0.0
    assert TURNED in data["maps"]
    assert "largest displacement" in figures.spec(toleranced.record, "errors", toleranced).caption


def test_a_platform_that_never_turns_has_no_map_of_rotations():
    record = assur.load("tripteron")
    record = replace(record, machine=replace(record.machine, tolerances={"q1": Tolerance(0.1, 0.03)}))
    region = workspace(record, resolution=8)
    maps = error_maps(record, region, ["x", "z"], nodes=4)
    assert list(errors_drawn(Context(record, region), maps).data["maps"]) == [WORST, SQUARES]


def test_without_tolerances_there_is_none():
    assert figures.left_out(assur.load("fivebar"))["accuracy"].startswith("fivebar states no tolerances")
