"""What the pose leaves out, as it is printed: at a pose and over a workspace."""

import re

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.pose import pose_of

COARSE = ("--resolution", "8")


def test_every_inverse_solution_comes_with_the_platforms_other_coordinates(assur_cli):
    asked = ("inverse", "three_rps", "300", "20", "10")
    first = assur_cli(*asked, "--json").json["solutions"][0]
    theta, psi = np.radians([20.0, 10.0])
    phi = np.degrees(np.arctan2(np.sin(theta) * np.sin(psi), np.cos(theta) + np.cos(psi)))
    assert first["parasitic"].keys() == {"x", "y", "phi"}
    assert first["parasitic"]["phi"] == pytest.approx(phi)
    out = assur_cli(*asked).out
    assert "coordinates that the pose leaves out" in out
    assert f"{phi:.4f}" in out


def test_what_is_nought_but_for_rounding_is_printed_as_nought(assur_cli):
    lines = assur_cli("direct", "three_rps", "250", "250", "250").out.splitlines()
    start = next(k for k, line in enumerate(lines) if "leaves out" in line)
    rows = [line.split() for line in lines[start + 3 :] if line.split()[0][0] in "+-"]
    numbers = [number for row in rows for number in row[1:]]
    assert "0.0000" in numbers
    assert all(re.fullmatch(r"-?\d+\.\d{4}", number) for number in numbers)
    assert "-0.0000" not in numbers


def test_where_nothing_else_moves_nothing_is_said(assur_cli):
    run = assur_cli("inverse", "planar_3rrr", "0", "0", "0")
    assert "leaves out" not in run.out
    data = assur_cli("workspace", "planar_3rrr", *COARSE, "--json").json
    assert data["parasitic"] == {}


def test_the_workspace_says_how_large_it_is_and_where(assur_cli):
    asked = ("workspace", "three_rps", *COARSE, "--box", "theta=-20:20", "--box", "psi=-20:20", "--stroke", "1:999")
    found = assur_cli(*asked, "--json").json["parasitic"]
    tilt = np.radians(20.0)
    largest = np.degrees(np.arctan(np.sin(tilt) ** 2 / (2 * np.cos(tilt))))
    assert abs(found["phi"]["value"]) == pytest.approx(largest)
    assert abs(found["phi"]["at"]["theta"]) == pytest.approx(20.0)
    out = assur_cli(*asked).out
    assert "largest parasitic motion" in out
    assert f"{largest:.6g} deg" in out


@pytest.mark.parametrize("way", [(), ("--method", "search")])
def test_the_solution_that_is_home_is_named(assur_cli, way):
    """Of all solutions at home's pose it is the one with home's inputs; of those that are sought it is the first."""
    record = assur.load("fivebar")
    pose = [repr(float(value)) for value in pose_of(record, record.home_values)]
    data = assur_cli("inverse", record.name, "--json", *way, "--", *pose).json
    assert len(data["solutions"]) > 1
    (item,) = [item for item in data["solutions"] if item["home"]]
    home = np.degrees(inputs_of(record, record.home_values))
    assert np.cos(np.radians(item["inputs"] - home)) == pytest.approx(1.0)
    assert data["solutions"][0] is item or not way
    away = assur_cli("inverse", record.name, "--json", *way, "--", *pose[:-1], repr(float(pose[-1]) + 1.0)).json
    (there,) = [item for item in away["solutions"] if item["home"]]
    assert np.cos(np.radians(there["inputs"] - home)) == pytest.approx(1.0, abs=1e-3)
