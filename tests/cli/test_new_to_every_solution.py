"""From a line of notation to every solution under its name: six mechanisms, none of the catalogue, counted elsewhere.

The other count is by many starts on the verifier's joint graph, which shares no code with the solvers.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.answers.at_border import pose_at_border
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.registry import load_record
from assur.numerics.rotations import to_quaternion
from multistart import Multistart

OWN = {
    "a 2T1R hybrid": ["--chain", "{P[x] R[y] R[y] | P[x] R[y] R[y]} R[x]", "--chain", "P[y] U[x,y] S"],
    "a 6-RUS": ["6-RUS"],
    "a spherical one": ["--limb", "R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O"],
    "a planar six-bar": ["--chain", "{R[z] R[z] R[z] | R[z] R[z]} R[z]", "--chain", "R[z] R[z]"],
    "one with ball screws": ["--limb", "{R[z]@O H[z]@O | P[z]} R[x] S"],
    "a Par4": [],
}
PAR4 = Path(__file__).parents[1] / "kinematics" / "loops" / "par4.toml"
SLOW = ("a 6-RUS", "a Par4", "one with ball screws")
STARTS = 400


def answered(capsys, *words):
    capsys.readouterr()
    assert main([*words[:2], "--json", *words[2:]]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("kind", [pytest.param(name, marks=pytest.mark.deep) if name in SLOW else name for name in OWN])
def test_every_solution_under_its_name(kind, tmp_path, capsys):
    path = tmp_path / "mine.toml"
    if OWN[kind]:
        assert main(["new", str(path), *OWN[kind]]) == 0
    else:
        path.write_text(PAR4.read_text())  # platforms in parts are written, not drafted
    answered(capsys, "check", str(path))
    shown = answered(capsys, "show", str(path))
    inverse = answered(capsys, "inverse", str(path), "--", *map(repr, home_pose(path)))
    assert inverse["complete"]
    assert len({solution["mode"] for solution in inverse["solutions"]}) == len(inverse["solutions"])
    (own,) = [solution for solution in inverse["solutions"] if solution["home"]]
    inputs = [value + 1.0 for value in own["inputs"]]
    direct = answered(capsys, "direct", str(path), "--", *map(repr, inputs))
    assert direct["complete"]
    assert len({solution["mode"] for solution in direct["solutions"]}) == len(direct["solutions"])
    solver = Multistart(path.read_text(), 200.0)
    printed = [
        np.radians(value) if entry["kind"] == "angle" else value
        for value, entry in zip(inputs, shown["inputs"], strict=True)
    ]
    screws = (
        [-value for value in printed] if "screws" in kind else []
    )  # the shaft turns in the nut, which does not turn
    unknowns = solver.assemblies(printed, STARTS, screws)
    if kind == "a Par4":
        unknowns = unknowns[uncrossed(solver, unknowns)]
    expected = poses(solver, shown["coordinates"], unknowns)
    told = np.array([solution["pose"] for solution in direct["solutions"]])
    for pose in told:
        assert np.min(apart(shown["coordinates"], expected, pose)) < 1e-4
    for pose in expected:
        assert np.min(apart(shown["coordinates"], told, pose)) < 1e-4


def home_pose(path):
    """As `show` prints no pose of home, by the file's joint graph."""
    record = load_record(path)
    return pose_at_border(record, pose_of(record, home_values(record))).tolist()


def uncrossed(solver, unknowns):
    """Whether (N,) the two rods of each arm are parallel, as the answer takes them to be."""
    sides = [
        [solver.point(f"C{side}{k}", unknowns) - solver.point(f"B{side}{k}", unknowns) for side in "mp"]
        for k in range(4)
    ]
    return np.max([np.linalg.norm(first - second, axis=1) for first, second in sides], axis=0) < 1e-3


def poses(solver, names, unknowns):
    """Coordinates (K, m) of the platform, each once, angles in deg."""
    rotation, place = solver.platform(unknowns)
    columns = {name: place[:, k] for k, name in enumerate("xyz")}
    columns["phi"] = np.degrees(np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]))
    columns["theta"] = np.degrees(np.arcsin(np.clip(-rotation[:, 2, 0], -1, 1)))
    columns["psi"] = np.degrees(np.arctan2(rotation[:, 2, 1], rotation[:, 2, 2]))
    if "qw" in names:
        quaternion = to_quaternion(rotation)
        columns |= {name: quaternion[:, k] for k, name in enumerate(("qw", "qx", "qy", "qz"))}
    return np.stack([columns[name] for name in names], axis=1)


def apart(names, poses, pose):
    """By how much poses (K, m) differ from one, turns less."""
    off = np.abs(poses - pose)
    turning = np.array([name in ("phi", "theta", "psi") for name in names])
    return np.max(np.where(turning, np.minimum(off, np.abs(off - 360.0)), off), axis=1)
