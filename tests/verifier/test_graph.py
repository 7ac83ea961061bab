"""The verifier's plain joint graph against the kernel of the rest: two readers, two algebras, the same mechanism."""

from pathlib import Path

import numpy as np
import pytest

import assur
import planar_joints
import screw_mechanisms
from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import geometry
from assur.joint_graph.state import state_names, state_of
from assur.joint_graph.tree import joint_graph
from assur.model.file.reader import examined
from assur.model.registry import load_record
from assur.numerics import rotations
from assur.verifier.formula import FloatNumbers
from assur.verifier.graph import Graph
from assur.verifier.mechanism import mechanism
from assur.verifier.vectors import about, taking

TESTS = Path(__file__).parents[1]
FILES = [*sorted(TESTS.glob("kinematics/**/*.toml")), TESTS / "model/fourbar.toml", TESTS / "model/file/delta.toml"]
LIMBS = """
format = 1
name = "limbs"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "top", point = [0, "k/2", 3.25], pose = ["x", "y", "z", "phi", "theta", "psi"] }
[parameters]
k = { value = "2*m*cos(tilt)" }
m = { value = 12.5 }
tilt = { value = 40, unit = "deg" }
twist = { value = 0.3, unit = "rad", sign = "any" }
[links]
base = {}
top = {}
[limbs.leg]
repeat = { about = [1, "sqrt(2)", -0.5], angles = [0, "2*pi/5", "tilt + twist", 200] }
[limbs.leg.links]
rod = {}
nut = {}
[limbs.leg.joints]
U = { type = "universal", parent = "base", child = "rod", at = ["k", 1, 0], axes = ["x", ["0", "cos(tilt)", "1"]] }
H = { type = "helical", parent = "nut", child = "rod", axis = "-z", pitch = "k/10", child_axis = [1, "m", 2] }
E = { type = "planar", parent = "nut", child = "top", axis = ["-m", 1, 0], at = ["sqrt(k*k + m*m)", 0, 1e-3] }
[limbs.leg.inputs]
"U.first" = { name = "q" }
"E.second" = { name = "r" }
[limbs.leg.home]
U = [0, 0]
H = 0
E = [0, 0, 0]
"""


@pytest.fixture
def record(request, tmp_path):
    """A mechanism by its name, its file or its text; of a text the loops need not close."""
    if "\n" not in str(request.param):
        return load_record(request.param)
    path = tmp_path / "own.toml"
    path.write_text(request.param, encoding="utf-8")
    return examined(request.param, path)[0]


def states(record, values):
    """NumberType of each joint at joint values: those of the kernel, and those of the plain graph."""
    numbers = iter(state_of(record, values[:, None])[:, 0].tolist())
    kernel = {name: [next(numbers) for _ in own] for name, own in state_names(record).items()}
    slices = joint_graph(record).slices
    balls = [name for name, joint in record.joints.items() if joint.type.ball]
    turns = {name: rotations.from_vector(values[slices[name]]).ravel().tolist() for name in balls}
    return kernel, kernel | turns


def differences(record, seed):
    """How far the two are from one another, in the mechanism's length and as numbers of rotations."""
    random, length = np.random.default_rng(seed), float(geometry(record).length)
    values = [random.uniform(-3, 3) * (1 if item.kind == "angle" else length) for item in record.coordinates]
    ours, own = states(record, np.array(values))
    written = mechanism(record.file.read_text(encoding="utf-8"))
    graph = Graph(written, FloatNumbers(), written.dimensions(FloatNumbers()))
    kernel = Configuration(joint_graph(record), geometry(record), ours)
    frames, apart = graph.frames(own), []

    def compare(first, second, unit=1.0):
        apart.append(np.max(np.abs(np.array(first, dtype=float) - np.array(second, dtype=float)), initial=0) / unit)

    assert set(frames) == set(kernel.frames)
    assert graph.cut == [joint.name for joint in kernel.graph.cut]
    for link, (rotation, origin) in kernel.frames.items():
        compare(rotation, frames[link][0])
        compare(origin, frames[link][1], length)
    for joint in kernel.graph.cut:
        (distance, turn), (far, apart_by) = kernel.gap(joint), graph.gap(joint.name, own, frames)
        compare(distance, far, length)
        compare(turn, apart_by)
    for joint in kernel.graph.joints:
        pairs = zip(kernel.twists(joint, (0, 0, 0)), graph.twists(joint.name, own, frames), strict=True)
        for (angular, velocity), (turning, moving) in pairs:
            compare(angular, turning)
            compare(velocity, moving, length)
    compare(record.platform.point, graph.point, length)
    assert [(item.coordinate.joint, item.coordinate.component) for item in record.inputs] == list(written.inputs)
    assert record.platform.pose == written.pose
    return max(apart)


CASES = [
    *assur.names(),
    *FILES,
    LIMBS,
    screw_mechanisms.FIVEBAR,
    screw_mechanisms.TRIPOD,
    screw_mechanisms.JACK,
    planar_joints.three_rer(planar=True),
    planar_joints.three_er(planar=True),
    planar_joints.table(planar=True),
]


@pytest.mark.parametrize("record", CASES, indirect=True)
def test_frames_gaps_and_twists_are_those_of_the_kernel(record):
    assert max(differences(record, seed) for seed in range(3)) < 1e-12


def test_about_and_taking_are_turns():
    turn = np.array(about((0.6, 0.0, 0.8), 0.28, 0.96))
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(
        turn, rotations.from_vector(np.arctan2(0.96, 0.28) * np.array([0.6, 0, 0.8])), atol=1e-15
    )
    assert np.array(taking((0, 1, 0), (0, 0, 1))) @ [0, 1, 0] == pytest.approx([0, 0, 1])
    assert taking((0, 0, 1), (0, 0, 1)) == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
