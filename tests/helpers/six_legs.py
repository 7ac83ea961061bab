"""Files of platforms on six U-P-S legs, and of planar ones on three R-P-R legs, from points and a pose."""

from __future__ import annotations

import numpy as np

from assur.numerics import rotations

HEAD = """format = 1
name = "{name}"
title = "{name}"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "platform", pose = {pose} }}
[links]
base = {{}}
platform = {{}}
"""


def six_ups(name, base, platform, origin, rotation):
    """Text of a file: universal joints at base points (6, 3), balls at platform points (6, 3), home at a pose."""
    joints, home = [], []
    across = 'axes = ["x", "y"]'
    for k, (foot, ball) in enumerate(zip(np.asarray(base), np.asarray(platform), strict=True), 1):
        leg = rotation @ ball + origin - foot
        length = float(np.linalg.norm(leg))
        x, y, z = leg / length
        first, second = np.arctan2(-y, z), np.arcsin(x)  # Rx(first) Ry(second) takes z to the leg
        turned = rotations.to_vector((_about_x(first) @ _about_y(second)).T @ rotation)
        joints += [
            f'U{k} = {{ type = "universal", parent = "base", child = "c{k}", at = {foot.tolist()}, {across} }}',
            f'P{k} = {{ type = "prismatic", parent = "c{k}", child = "r{k}", axis = "z" }}',
            f'S{k} = {{ type = "spherical", parent = "r{k}", child = "platform", child_at = {ball.tolist()} }}',
        ]
        home += [
            f"U{k} = {np.degrees([first, second]).tolist()}",
            f"P{k} = {length!r}",
            f"S{k} = {np.degrees(turned).tolist()}",
        ]
    pose = '["x", "y", "z", "phi", "theta", "psi"]'
    return _text(name, pose, 6, joints, home)


def three_rpr(name, base, platform, x, y, phi):
    """Text of a file: hinges at base points (3, 2) and platform points (3, 2), home at a pose, phi in rad."""
    joints, home = [], []
    turned = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    for k, (foot, hinge) in enumerate(zip(np.asarray(base), np.asarray(platform), strict=True), 1):
        leg = turned @ hinge + [x, y] - foot
        angle, places = np.arctan2(leg[1], leg[0]), ([*map(float, foot), 0.0], [*map(float, hinge), 0.0])
        joints += [
            f'A{k} = {{ type = "revolute", parent = "base", child = "c{k}", at = {places[0]}, axis = "z" }}',
            f'P{k} = {{ type = "prismatic", parent = "c{k}", child = "r{k}", axis = "x" }}',
            f'B{k} = {{ type = "revolute", parent = "r{k}", child = "platform", child_at = {places[1]}, axis = "z" }}',
        ]
        home += [
            f"A{k} = {float(np.degrees(angle))!r}",
            f"P{k} = {float(np.hypot(*leg))!r}",
            f"B{k} = {float(np.degrees(phi - angle))!r}",
        ]
    return _text(name, '["x", "y", "phi"]', 3, joints, home)


def _text(name, pose, legs, joints, home):
    links = [f"{part}{k} = {{}}" for k in range(1, legs + 1) for part in "cr"]
    inputs = [f'P{k} = {{ name = "l{k}" }}' for k in range(1, legs + 1)]
    lines = [*links, "[joints]", *joints, "[inputs]", *inputs, "[home]", *home]
    return HEAD.format(name=name, pose=pose) + "\n".join(lines) + "\n"


def _about_x(angle):
    return np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])


def _about_y(angle):
    return np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
