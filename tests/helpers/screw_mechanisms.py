"""Mechanisms with screws, each question about which has an answer on paper, as files of their own."""

from pathlib import Path

import assur


def loaded(folder, text, *changes):
    """The mechanism of a text, written into a folder, with pieces of text exchanged before."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = Path(folder) / f"{text.split('name = ')[1].split()[0].strip(chr(34))}.toml"
    path.write_text(text, encoding="utf-8")
    return assur.load(path)


DIFFERENTIAL = """
format = 1
name = "differential"
title = "two screws in series"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "nut", pose = ["z"] }
[links]
base = {}
screw = {}
nut = {}
[joints]
H1 = { type = "helical", parent = "base", child = "screw", axis = "z", pitch = 5 }
H2 = { type = "helical", parent = "screw", child = "nut", axis = "z", pitch = -3 }
P = { type = "prismatic", parent = "base", child = "nut", axis = "z" }
[inputs]
H1 = { name = "q" }
[home]
H1 = 0
H2 = 0
P = 0
"""
"""The nut does not turn, so H2 = -H1 and z = (5 + 3) turns of H1, in mm."""

FIVEBAR = """
format = 1
name = "driven"
title = "five-bar with two sliders on ball screws"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "rod1", point = [130, 0, 0], pose = ["x", "y"] }
[links]
base = {}
shaft1 = {}
shaft2 = {}
nut1 = {}
nut2 = {}
rod1 = {}
rod2 = {}
[joints]
M1 = { type = "revolute", parent = "base", child = "shaft1", axis = "x" }
S1 = { type = "helical", parent = "shaft1", child = "nut1", axis = "x", pitch = 10 }
G1 = { type = "prismatic", parent = "base", child = "nut1", axis = "x" }
M2 = { type = "revolute", parent = "base", child = "shaft2", axis = "x" }
S2 = { type = "helical", parent = "shaft2", child = "nut2", axis = "-x", pitch = -5 }
G2 = { type = "prismatic", parent = "base", child = "nut2", axis = "x" }
B1 = { type = "revolute", parent = "nut1", child = "rod1", at = [-50, 0, 0], axis = "z" }
B2 = { type = "revolute", parent = "nut2", child = "rod2", at = [50, 0, 0], axis = "z" }
C = { type = "revolute", parent = "rod1", child = "rod2", at = [130, 0, 0], child_at = [130, 0, 0], axis = "z" }
[inputs]
M1 = { name = "q1" }
M2 = { name = "q2" }
[home]
M1 = 0
S1 = 0
G1 = 0
M2 = 0
S2 = 0
G2 = 0
B1 = 67.38
B2 = 112.62
C = 45.24
"""
"""Motors turn the shafts, the nuts are guided: -10 mm a turn of M1, 5 mm a turn of M2; rods of 130 mm between them."""

TRIPOD = """
format = 1
name = "tripod"
title = "3-PRS on ball screws"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "platform", pose = ["z", "theta", "psi"] }
[links]
base = {}
platform = {}
[limbs.leg]
repeat = { about = "z", count = 3 }
[limbs.leg.links]
shaft = {}
nut = {}
rod = {}
[limbs.leg.joints]
M = { type = "revolute", parent = "base", child = "shaft", at = [200, 0, 0], axis = "z" }
S = { type = "helical", parent = "shaft", child = "nut", axis = "z", pitch = 20 }
G = { type = "prismatic", parent = "base", child = "nut", at = [200, 0, 0], axis = "z" }
B = { type = "revolute", parent = "nut", child = "rod", axis = "y" }
C = { type = "spherical", parent = "rod", child = "platform", at = [-120, 0, 160], child_at = [80, 0, 0] }
[limbs.leg.inputs]
M = { name = "q" }
[limbs.leg.home]
M = 0
S = 0
G = 0
B = 0
C = [0, 0, 0]
"""
"""The motors turn the screws, so that -20 mm a turn lift the nuts; level, the platform stands 160 mm over them."""

JACK = """
format = 1
name = "jack"
title = "a screw jack whose nut is kept from turning by two hinges"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "beam", point = [90, 0, 0], pose = ["z"] }
[parameters]
lead = { value = 8, sign = "any" }
[links]
base = {}
shaft = {}
nut = {}
beam = {}
slide = {}
[joints]
M = { type = "revolute", parent = "base", child = "shaft", axis = "z" }
H = { type = "helical", parent = "shaft", child = "nut", axis = "z", pitch = "lead" }
A = { type = "revolute", parent = "nut", child = "beam", at = [0, 40, 0], child_at = [0, 40, 0], axis = "x" }
B = { type = "revolute", parent = "beam", child = "slide", at = [200, -60, 30], axis = "x" }
P = { type = "prismatic", parent = "base", child = "slide", at = [200, -60, 30], axis = "z" }
[inputs]
M = { name = "q" }
[home]
M = 0
H = 0
A = 0
B = 0
P = 0
"""
"""No loop has parallel axes alone. The hinges keep the nut upright, so H = -M and it sinks by the lead a turn. The beam
has two places: as at home, and turned over about the hinge A, with B as far under it as B is above it at home.
"""
