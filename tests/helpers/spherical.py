"""Spherical 3-RRR mechanisms as files, by their axes and the coordinates of their pose."""

TEXT = """format = 1
name = "{name}"
title = "Spherical 3-RRR"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "platform", pose = {pose} }}
[parameters]
size = {{ value = 100 }}
[links]
base = {{}}
platform = {{}}
[limbs.leg]
repeat = {{ about = [1, 1, 1], count = 3 }}
[limbs.leg.links]
proximal = {{}}
distal = {{}}
[limbs.leg.joints]
A = {{ type = "revolute", parent = "base", child = "proximal", axis = "x" }}
B = {{ type = "revolute", parent = "proximal", child = "distal", axis = {middle} }}
C = {{ type = "revolute", parent = "distal", child = "platform", axis = {last} }}
[limbs.leg.inputs]
A = {{ name = "q" }}
[limbs.leg.home]
A = 0
B = 0
C = 0
"""
ANGLES, QUATERNION = '["phi", "theta", "psi"]', '["qw", "qx", "qy", "qz"]'
AGILE_EYE = ("[0, 0, 1]", "[0, 1, 0]")
OBLIQUE = ("[0.2, 0.5, 1]", "[-0.3, 1, 0.1]")


def spherical(folder, pose=ANGLES, axes=AGILE_EYE, name="spherical"):
    """The file of a spherical mechanism, written into a folder; home is not turned."""
    path = folder / f"{name}.toml"
    path.write_text(TEXT.format(name=name, pose=pose, middle=axes[0], last=axes[1]))
    return path
