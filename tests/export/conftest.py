"""Mechanisms to export: the built-in ones, one with a joint of every type, seen from every link as its base, and others
that strangers write: two screws in one line, a spherical one with all joints in one point, drafts of chains."""

import re
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.model.file.reader import read_text
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains
from catalogue import each

LINKS = ("world", "a", "b", "c", "d", "e", "f")
EVERY_TYPE = """
format = 1
name = "every"
title = "a joint of every type -- in one loop"
source = "a test"
unit = "cm"
angle = "deg"
base = "BASE"
[platform]
link = "PLATFORM"
point = [1, 2, 3]
pose = ["x", "y", "z"]
orientation = "any"
[parameters]
k = { value = 20, meaning = "a length" }
[links]
world = {}
a = {}
b = {}
c = {}
d = {}
e = {}
f = {}
[joints]
J1 = { type = "revolute", parent = "world", child = "a", at = ["k", 0, 0], axis = [1, 2, 2], limits = [-90, 120] }
J2 = { type = "prismatic", parent = "b", child = "a", at = [0, "k", 0], axis = "-y", child_axis = "z" }
J3 = { type = "helical", parent = "b", child = "c", at = [0, 0, "k"], axis = "z", pitch = 5 }
J4 = { type = "cylindrical", parent = "c", child = "d", at = ["k", "k", 0], child_at = [1, 2, 3], axis = "x" }
J5 = { type = "universal", parent = "d", child = "e", at = [0, "k", "k"], axes = ["x", "y"] }
J6 = { type = "spherical", parent = "e", child = "f", at = [3, 2, "k"], child_at = [-4, 0, 1] }
J7 = { type = "revolute", parent = "f", child = "world", at = ["k", 5, 0], axis = "z" }
[points]
Q = { link = "a", at = [1, 2, 3] }
[inputs]
order = ["INPUT"]
INPUT = { name = "q", sign = -1, offset = 10 }
[home]
J1 = 10
J2 = 3
J3 = 20
J4 = [2, 30]
J5 = [10, 20]
J6 = [5, 6, 7]
J7 = 0
"""
CASES = [f"{base}/{driven}" for base in LINKS for driven in ("J1", "J2")]
WRITTEN = {
    "screws": """
format = 1
name = "screws"
title = "a differential screw"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "nut", pose = ["z"] }
[links]
base = {}
spindle = {}
nut = {}
[joints]
H1 = { type = "helical", parent = "base", child = "spindle", axis = "z", pitch = 5 }
H2 = { type = "helical", parent = "spindle", child = "nut", axis = "z", pitch = -3 }
P = { type = "prismatic", parent = "base", child = "nut", axis = "z" }
[inputs]
H1 = { name = "q", offset = 90, sign = -1, stroke = [-2000, 2000] }
[home]
H1 = 30
H2 = -30
P = 0.5
""",
    "spherical": """
format = 1
name = "spherical"
title = "spherical 3-RRR"
unit = "m"
angle = "deg"
base = "base"
platform = { link = "platform", pose = ["phi", "theta", "psi"] }
[links]
base = {}
platform = {}
[limbs.leg]
repeat = { about = [1, 1, 1], count = 3 }
[limbs.leg.links]
near = {}
far = {}
[limbs.leg.joints]
A = { type = "revolute", parent = "base", child = "near", axis = "x" }
B = { type = "revolute", parent = "near", child = "far", axis = "z" }
C = { type = "revolute", parent = "far", child = "platform", axis = "y" }
[limbs.leg.inputs]
A = { name = "q" }
[limbs.leg.home]
A = 0
B = 0
C = 0
""",
}
DRAFTED = {
    "draft": ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"),
    "planar draft": ("R[z] R[z] R[z]", "P[x] R[z] R[z]", "R[z] P[x] R[z]"),
}


@lru_cache
def _built_in(name):
    return assur.load(name)


@lru_cache
def _own(name):
    text = WRITTEN.get(name) or drafted(parse_chains(DRAFTED[name]), Path("my.toml")).text
    return read_text(text, Path("my.toml"))


@pytest.fixture(params=[*each(), *CASES, *WRITTEN, *DRAFTED])
def record(request, tmp_path):
    """A built-in mechanism, the one of every type with a base and an input (each of its joints is cut in turn), or an
    own one."""
    if request.param in (*WRITTEN, *DRAFTED):
        return _own(request.param)
    if request.param not in CASES:
        return _built_in(request.param)
    base, driven = request.param.split("/")
    text = EVERY_TYPE.replace("BASE", base).replace("PLATFORM", "c" if base in "ef" else "f")
    path = tmp_path / "every.toml"
    path.write_text(re.sub("INPUT", driven, text))
    return load_record(path)


@pytest.fixture
def metre(record):
    return {"mm": 1e-3, "cm": 1e-2, "m": 1.0}[record.unit]


@pytest.fixture
def home(record):
    return assemble(record, record.home).values


@pytest.fixture
def anywhere(record, home):
    """Joint values far from home and from closing."""
    length = characteristic_length(record)
    units = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    return home + units * np.random.default_rng(4).uniform(-1.5, 1.5, size=len(units))


@pytest.fixture
def elsewhere(record, home):
    """Joint values that close the loops, away from home."""
    length = characteristic_length(record)
    units = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    starts = home + units * np.random.default_rng(5).uniform(-0.4, 0.4, size=(20, len(units)))
    found = assemble(record, starts)
    apart = np.max(np.abs((found.values - home) / units), axis=-1)
    return found.values[int(np.argmax(np.where(found.closed, apart, -1.0)))]
