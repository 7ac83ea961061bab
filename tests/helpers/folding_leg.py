"""A table that one or two slides drive, and a leg of two rods that nobody drives.

The leg folds where the table's point is as far from its foot as one rod is longer than the other: 0.6.
"""

import numpy as np

import assur

LONG, SHORT = 1.0, 0.4
TEXT = """
format = 1
name = "table"
unit = "m"
angle = "rad"
base = "base"
platform = {{ link = "table", pose = {pose} }}
[links]
base = {{}}
{cart}
rod = {{}}
arm = {{}}
table = {{}}
[joints]
X = {{ type = "prismatic", parent = "base", child = "{first}", axis = "x" }}
{second}
foot = {{ type = "revolute", parent = "base", child = "rod", axis = "z" }}
knee = {{ type = "revolute", parent = "rod", child = "arm", axis = "z", at = [1, 0, 0] }}
hip = {{ type = "revolute", parent = "arm", child = "table", axis = "z", at = [0.4, 0, 0] }}
[inputs]
X = {{ name = "X" }}
{driven}
[home]
{home}
"""


def table(folder):
    """Driven along x and y, as a file in a folder."""
    parts = {"cart": "cart = {}", "first": "cart", "driven": 'Y = { name = "Y" }', "pose": '["x", "y"]'}
    parts["second"] = 'Y = { type = "prismatic", parent = "cart", child = "table", axis = "y" }'
    return _loaded(folder / "table.toml", parts, dict(zip("XY", (0.3, 1.0), strict=True)))


def rail(folder):
    """Driven along x alone."""
    parts = {"cart": "", "first": "table", "second": "", "driven": "", "pose": '["x"]'}
    return _loaded(folder / "rail.toml", parts, {"X": 0.9})


def _loaded(path, parts, slides):
    x, y = slides["X"], slides.get("Y", 0.0)
    knee = np.arccos((x * x + y * y - LONG**2 - SHORT**2) / (2 * LONG * SHORT))
    foot = np.arctan2(y, x) - np.arctan2(SHORT * np.sin(knee), LONG + SHORT * np.cos(knee))
    home = {**slides, "foot": foot, "knee": knee, "hip": -foot - knee}
    text = "\n".join(f"{name} = {float(value)!r}" for name, value in home.items())
    path.write_text(TEXT.format(home=text, **parts), encoding="utf-8")
    return assur.load(path)
