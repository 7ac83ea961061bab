"""Poses that leave one angle of the platform open: against a solver of the swept circles alone, written out here."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.pose import pose_of

FloatArray = NDArray[np.float64]
TILTED_RAILS = """
format = 1
name   = "rails"
unit   = "mm"
angle  = "deg"
base   = "base"

[platform]
link = "platform"
pose = [{pose}]

[links]
base = {{}}
platform = {{}}
{links}

[joints]
{joints}

[inputs]
P1 = {{ name = "q1" }}
P2 = {{ name = "q2" }}
P3 = {{ name = "q3" }}

[home]
{home}
"""
FEET = np.array([[209.0, 18.0, 0.0], [-89.0, 168.0, 10.0], [-75.0, -217.0, -6.0]])
RAILS = np.array([[0.2, 0.0, 1.0], [-0.08, 0.18, 1.0], [-0.13, -0.15, 1.0]])
HINGES = np.array([[-18.0, 209.0, 0.0], [-168.0, -89.0, 10.0], [217.0, -75.0, 20.0]])
BALLS = np.array([[94.0, 25.0, 0.0], [-91.0, 115.0, 6.0], [-58.0, -75.0, -8.0]])
HOME = np.array([15.0, -10.0, 330.0])
RAILS, HINGES = (rows / np.linalg.norm(rows, axis=1, keepdims=True) for rows in (RAILS, HINGES))


def _file(folder: Path, pose: list[str]) -> str:
    """Rails that are not across their hinges: each ball is on an oblique cylinder, not in a plane."""
    links, joints, home = [], [], []
    for k in range(3):
        rod = (HOME + BALLS[k] - FEET[k]).tolist()
        foot, rail, hinge, ball = (rows[k].tolist() for rows in (FEET, RAILS, HINGES, BALLS))
        slide, bar, n = f'"slide{k}"', f'"rod{k}"', k + 1
        links += [f"slide{k} = {{}}\nrod{k} = {{}}"]
        joints += [
            f'P{n} = {{ type = "prismatic", parent = "base", child = {slide}, at = {foot}, axis = {rail} }}',
            f'R{n} = {{ type = "revolute", parent = {slide}, child = {bar}, axis = {hinge} }}',
            f'B{n} = {{ type = "spherical", parent = {bar}, child = "platform", at = {rod}, child_at = {ball} }}',
        ]
        home += [f"P{n} = 0\nR{n} = 0\nB{n} = [0, 0, 0]"]
    parts = {"links": links, "joints": joints, "home": home}
    named = ", ".join(f'"{name}"' for name in pose)
    path = folder / "rails.toml"
    path.write_text(TILTED_RAILS.format(pose=named, **{key: "\n".join(rows) for key, rows in parts.items()}))
    return str(path)


def _turn(axis: int, angles: FloatArray) -> FloatArray:
    """Turns (N, 3, 3) about x, y or z."""
    turned = np.zeros((len(angles), 3, 3))
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turned[:, axis, axis] = 1.0
    turned[:, first, first] = turned[:, second, second] = np.cos(angles)
    turned[:, second, first] = np.sin(angles)
    turned[:, first, second] = -np.sin(angles)
    return turned


def _swept(place: FloatArray, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Strokes (N, 3), and by how much (N, 3) each ball misses the circle at that stroke."""
    turned = _turn(2, angles[:, 0]) @ _turn(1, angles[:, 1]) @ _turn(0, angles[:, 2])
    balls = place[:, None] + np.einsum("nij,kj->nki", turned, BALLS)
    rods = HOME + BALLS - FEET
    away = balls - FEET - np.einsum("ki,ki->k", HINGES, rods)[:, None] * HINGES
    strokes = np.einsum("nki,ki->nk", away, HINGES) / np.einsum("ki,ki->k", RAILS, HINGES)
    arms = away - strokes[..., None] * RAILS
    lengths = np.sum(rods**2, axis=1) - np.einsum("ki,ki->k", HINGES, rods) ** 2
    return strokes, (np.sum(arms**2, axis=2) - lengths) / 1e4


def _strokes(open_angle: int, given: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Strokes (K, 3) of all assemblies at z and two angles: Newton's method from 3000 places and angles.

    A platform with theta beyond a right angle is printed with other angles.
    """

    def at(unknowns: FloatArray) -> tuple[FloatArray, FloatArray]:
        place = np.column_stack([unknowns[:, :2], np.full(len(unknowns), given[0])])
        return _swept(place, np.insert(np.tile(given[1:], (len(unknowns), 1)), open_angle, unknowns[:, 2], axis=1))

    unknowns = np.column_stack([rng.uniform(-600, 600, (3000, 2)), rng.uniform(-np.pi, np.pi, 3000)])
    steps = np.diag([1e-4, 1e-4, 1e-7])
    for _ in range(40):
        misses = at(unknowns)[1]
        slopes = np.stack([(at(unknowns + h)[1] - at(unknowns - h)[1]) / (2 * h.sum()) for h in steps], axis=-1)
        change = np.linalg.solve(slopes + 1e-12 * np.eye(3), -misses[..., None])[..., 0]
        unknowns = unknowns + change * np.minimum(1.0, 100.0 / (np.linalg.norm(change, axis=1, keepdims=True) + 1e-9))
    strokes, misses = at(unknowns)
    printed = np.cos(unknowns[:, 2]) > 0.0 if open_angle == 1 else True
    strokes = strokes[(np.max(np.abs(misses), axis=1) < 1e-9) & printed]
    return strokes[np.sort(np.unique(strokes.round(3), axis=0, return_index=True)[1])]


@pytest.mark.parametrize(("open_angle", "angles"), [(0, (0.2, -0.14)), (1, (0.3, 0.1)), (2, (-0.2, 0.15))])
def test_one_open_angle_is_solved_with_the_loops(tmp_path: Path, open_angle: int, angles: tuple[float, float]) -> None:
    named = ["z", *np.delete(["phi", "theta", "psi"], open_angle)]
    mechanism = assur.load(_file(tmp_path, named))
    given = np.array([350.0, *angles])
    solutions = solve_by_loops(mechanism, pose=given)
    assert solutions.complete
    assert np.allclose(pose_of(mechanism, solutions.joints), given, atol=1e-8)
    other = _strokes(open_angle, given, np.random.default_rng(1))
    ours = inputs_of(mechanism, solutions.joints)
    assert len(ours) == len(other)
    assert np.max(np.min(np.max(np.abs(ours[:, None] - other), axis=2), axis=0)) < 1e-3
