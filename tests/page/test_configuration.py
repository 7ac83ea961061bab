"""The program of a configuration in the page: against Python's arrays, and against formulas that are written here."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import closing_system, residuals
from assur.kinematics.pose import platform_frame, platform_twists
from assur.mechanism import load
from assur.model.dimensions import with_parameters
from assur.numerics import rotations
from assur.page.configuration import configuration
from assur.page.graph import coordinates, graph
from assur.page.resizing import resizing
from catalogue import REPRESENTATIVES, each
from folding_leg import table
from screw_mechanisms import FIVEBAR, loaded

WEB = Path(__file__).parents[2] / "web"
READ = """
import { readFileSync } from "node:fs";
const { scene, configurations, sizes } = JSON.parse(readFileSync(0, "utf8"));
const { configurationAt, modelOf, resize } = await import(`${process.argv[1]}/src/solver/configuration.js`);
const { closureRows, gaps } = await import(`${process.argv[1]}/src/solver/closure.js`);
const { compiled } = await import(`${process.argv[1]}/test/compiled.js`);
const model = modelOf(compiled(scene));
if (sizes) resize(model, sizes);
const read = (values) => {
  const at = configurationAt(model, values);
  const frames = at.frames.map(({ turn, origin }) => [...turn, ...origin]);
  const platform = [...at.platform.turn, ...at.platform.origin];
  const matrices = { moves: at.moves, closure: closureRows(model, at) };
  const rows = Object.entries(matrices).map(([name, found]) => [name, found.map((row) => [...row])]);
  return { gaps: gaps(model, at), frames, platform, ...Object.fromEntries(rows) };
};
process.stdout.write(JSON.stringify(configurations.map(read)));
"""
BALLS = ("R[y] P[z] S", "R[y] P[z] S", "U[x,y] P[z] S")
CONFIGURATIONS = 3


@pytest.fixture(scope="session")
def record_of(tmp_path_factory):
    """A mechanism of the catalogue or a file: with ball joints, with screws, with a joint whose child is the base."""
    folder = tmp_path_factory.mktemp("configurations")

    def made(name):
        if name == "screws":
            return loaded(folder, FIVEBAR)
        if name == "backward":
            text = (
                table(folder).file.read_text(encoding="utf-8").replace('"base", child = "rod"', '"rod", child = "base"')
            )
            return loaded(folder, text.replace("foot = 0.", "foot = -0."))
        if name == "balls":
            path = folder / "balls.toml"
            assert main(["new", str(path), *(word for chain in BALLS for word in ("--chain", chain)), "--force"]) == 0
            return load(path)
        return load(name)

    return made


def in_node(record, configurations, sizes=None):
    """What the page reads of joint values (N, n), with other dimensions if so asked."""
    scene = {
        "graph": graph(record),
        "configuration": configuration(record),
        "coordinates": coordinates(record),
        "characteristicLength": characteristic_length(record),
        "platform": {"pose": list(record.platform.pose)},
        "home": record.home_values.tolist(),
        "inputs": [],
        **resizing(record, ()),
    }
    given = json.dumps({"scene": scene, "configurations": configurations.tolist(), "sizes": sizes})
    words = [str(shutil.which("node")), "--input-type=module", "-e", READ, str(WEB)]
    done = subprocess.run(words, input=given, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def loose(record, rng):
    """Joint values (N, n) about home at which loops are open."""
    unit = [characteristic_length(record) if item.kind == "length" else 1.0 for item in record.coordinates]
    return record.home_values + 0.2 * np.array(unit) * rng.normal(size=(CONFIGURATIONS, len(unit)))


def motion(joint, own):
    """Turn and shift of a joint's child at its values, by matrices of whole turns: a second route."""
    axes = joint.axes
    turn = {
        "R": lambda: rotations.about_axis(axes[0], own[0]),
        "P": lambda: np.eye(3),
        "H": lambda: rotations.about_axis(axes[0], own[0]),
        "C": lambda: rotations.about_axis(axes[0], own[1]),
        "U": lambda: rotations.about_axis(axes[0], own[0]) @ rotations.about_axis(axes[1], own[1]),
        "S": lambda: rotations.from_vector(own),
    }[joint.type.letter]()
    along = {"P": 1.0, "C": 1.0, "H": joint.pitch / (2 * np.pi)}.get(joint.type.letter, 0.0)
    return turn @ joint.turn, joint.at + (along * own[0] * axes[0] if along else np.zeros(3))


def gaps_of(record, values):
    """Gaps of the cut joints, one number at a time: lengths, then rotation vectors."""
    found = joint_graph(record)

    def child(joint, frame):
        turn, shift = motion(joint, values[found.slices[joint.name]])
        rotation = frame[0] @ turn
        return rotation, frame[1] + frame[0] @ shift - rotation @ joint.child_at

    def parent(joint, frame):
        turn, shift = motion(joint, values[found.slices[joint.name]])
        rotation = frame[0] @ turn.T
        return rotation, frame[1] + frame[0] @ joint.child_at - rotation @ shift

    placed = {found.base: (np.eye(3), np.zeros(3))}
    for joint, forward in found.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        placed[far] = (child if forward else parent)(joint, placed[near])
    rows = []
    for joint in found.cut:
        (r, o), (rotation, origin) = child(joint, placed[joint.parent]), placed[joint.child]
        at = joint.child_at
        rows.append([*(r @ at + o - rotation @ at - origin), *rotations.to_vector(r @ rotation.T)])
    return np.array(rows)


@pytest.mark.node
@pytest.mark.parametrize("name", [*each(quick=(*REPRESENTATIVES, "fivebar")), "balls", "screws", "backward"])
def test_everything_that_the_page_reads_is_what_python_says(record_of, name, rng):
    record = record_of(name)
    values, length = loose(record, rng), characteristic_length(record)
    unit = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    for here, found in zip(values, in_node(record, values), strict=True):
        close = {"rtol": 1e-11, "atol": 1e-11 * length}
        assert np.allclose(found["gaps"], residuals(record, here).ravel(), **close)
        scaled = gaps_of(record, here)
        scaled[:, 3:] *= length
        assert np.allclose(found["gaps"], scaled.ravel(), **close)
        assert np.max(np.abs(scaled)) > 1e-3 * length
        _, derivative = closing_system(record, here[None], None)
        assert np.allclose(found["closure"], derivative[0] * unit / length, rtol=1e-11, atol=1e-11)
        rotation, point = platform_frame(record, here)
        assert np.allclose(found["platform"], [*rotation.ravel(), *point], **close)
        assert np.allclose(found["moves"], platform_twists(record, here), **close)
        placed = frames(record, here)
        for link, numbers in zip(graph(record)["links"], found["frames"], strict=True):
            assert np.allclose(numbers, [*placed[link][0].ravel(), *placed[link][1]], **close)


@pytest.mark.node
@pytest.mark.parametrize("name", [*each(quick=("zeng2019", "three_crr")), "balls"])
def test_with_other_dimensions_the_page_reads_what_python_says_of_them(record_of, name, rng):
    record = record_of(name)
    sizes = resizing(record, ())["sizes"]
    values = [item["value"] + 0.2 * (item["range"][1] - item["value"]) * rng.uniform() for item in sizes]
    units = [np.degrees(1.0) if item["unit"] == "deg" else 1.0 for item in sizes]
    given = {item["name"]: value * unit for item, value, unit in zip(sizes, values, units, strict=True)}
    other = with_parameters(record, **given)
    assert not np.allclose(characteristic_length(other), characteristic_length(record), rtol=1e-6, atol=0.0)
    loose_values, length = loose(record, rng), characteristic_length(other)
    for own, found in zip(loose_values, in_node(record, loose_values, values), strict=True):
        assert np.allclose(found["gaps"], residuals(other, own).ravel(), rtol=1e-10, atol=1e-10 * length)
        rotation, point = platform_frame(other, own)
        assert np.allclose(found["platform"], [*rotation.ravel(), *point], rtol=1e-10, atol=1e-10 * length)


def test_dimensions_that_strokes_depend_on_stay(tmp_path):
    text = load("three_rps").file.read_text(encoding="utf-8")
    path = tmp_path / "own.toml"
    path.write_text(text.replace("stroke = [160, 320]", 'stroke = ["R - 40", 320]'), encoding="utf-8")
    found = [resizing(load(own), ()) for own in ("three_rps", path)]
    assert [own["sizesFixed"] for own in found] == [[], ["R"]]
    assert [[item["name"] for item in own["sizes"]] for own in found] == [["R", "r"], ["r"]]


@pytest.mark.parametrize("name", each())
def test_joint_values_are_named_in_their_order(name):
    record = load(name)
    joints = graph(record)["joints"]
    assert sum(joint["freedoms"] for joint in joints) == len(coordinates(record)) == len(record.home)
    for joint in joints:
        own = coordinates(record)[joint["first"] : joint["first"] + joint["freedoms"]]
        assert all(item["label"].split(".")[0] == joint["name"].split(".")[0] for item in own)
        assert len(joint["limits"]) == joint["freedoms"]
