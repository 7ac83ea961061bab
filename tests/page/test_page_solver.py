"""The solver in the page against Python: the numbers that its own tests read are those that Python gives today."""

import json
import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closing_system
from assur.kinematics.following.locked import general_ranks
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.mechanism import load
from assur.page.content import content
from assur.view.resizing import resized
from catalogue import each
from folding_leg import rail, table
from pages import content_of

WEB = Path(__file__).parents[2] / "web"
STORED = WEB / "test" / "numbers.json"
NAMES = ("zeng2019", "planar_3rrr", "three_crr", "gough_stewart", "fivebar", "delta_4s", "orthoglide")
MODES = ("fivebar", "delta_4s", "three_crr", "orthoglide")
KEPT = ("name", "unit", "angleUnit", "extent", "characteristicLength", "graph", "configuration", "coordinates")
KEPT += ("platform", "inputs", "poseRange", "home", "branches", "modes", "sizes", "resize")
MOVED = 0.02
"""How far inputs are moved from home, in characteristic lengths or rad."""

GROWN = 1.05
"""How many times as large a dimension becomes."""

DIGITS = 9
"""After the point, of joint values that are only compared."""

WALKED = ("graph", "configuration", "coordinates", "platform", "inputs", "characteristicLength", "home", "unit")
"""What of a scene the solver needs to walk."""

WALK = """
import { readFileSync } from "node:fs";
const { scene, moves, seed } = JSON.parse(readFileSync(0, "utf8"));
const { modelOf } = await import(`${process.argv[1]}/src/solver/configuration.js`);
const { compiled } = await import(`${process.argv[1]}/test/compiled.js`);
const { walked } = await import(`${process.argv[1]}/test/walks.js`);
process.stdout.write(JSON.stringify(walked(modelOf(compiled(scene)), { moves, seed })));
"""

WALKED_HERE = ("three_rps", "linear_delta_4r", "tripteron")
"""In every run, beside those that the page's own tests walk."""

SELDOM = {"three_crr": 4, "tripteron": 4}
"""They are seldom stopped: so many times as many moves."""

AWAY = {"fivebar": (0.0, 270.0)}
"""Where modes are named: this lies beyond a parallel singularity of a working mode, others near home."""


def numbers(name: str) -> dict[str, Any]:
    """What the page is given of a mechanism, and what Python finds: gaps, derivatives, moved inputs, measures."""
    record = load(name)
    rng = np.random.default_rng(7)
    whole = content_of(name)
    home, length = record.home_values, whole["characteristicLength"]
    scale = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    loose = home + 0.3 * scale * rng.normal(size=len(home))
    pose = pose_of(record, home)
    gaps, derivative = closing_system(record, loose[None], pose[None])
    return {
        "scene": {key: whole[key] for key in KEPT},
        "loose": {"values": loose.tolist(), "gaps": gaps[0].tolist(), "derivative": derivative[0].tolist()},
        "moves": [_move(record, length, rng) for _ in range(4)],
        "resized": _resized(record, whole["sizes"]),
        "singular": _singular_values(record, home),
        "named": _named(record, pose) if name in MODES else [],
    }


def stored(folder: Path) -> dict[str, Any]:
    """Everything that the page's own tests read."""
    legs = {"table": table(folder), "rail": rail(folder)}
    scenes = {name: content(record, []) for name, record in legs.items()}
    return {
        **{name: numbers(name) for name in NAMES},
        **{name: {"scene": {key: scene[key] for key in WALKED}} for name, scene in scenes.items()},
    }


def _named(record: Any, home: np.ndarray) -> list[dict[str, Any]]:
    """At home's pose and at another: every working mode, its assembly mode and every assembly at its inputs."""
    away = np.array(
        AWAY.get(record.name, home + 0.1 * characteristic_length(record) * np.array([1.0, -0.6, 0.3])[: len(home)])
    )
    found = []
    for pose in (home, away):
        for solution in record.inverse(pose):
            working, current = mode_names(record, np.array(list(solution.joints.values())))
            there = record.direct(solution.inputs)
            listed = [
                {"label": str(label), "values": values.round(DIGITS).tolist()}
                for label, values in zip(there.labels[there.exists], there.joints[there.exists], strict=True)
            ]
            assert current in [item["label"] for item in listed]
            found.append({"at": np.asarray(pose).tolist(), "working": working, "current": current, "assembly": listed})
    return found


def _move(record: Any, length: float, rng: np.random.Generator) -> dict[str, Any]:
    units = np.array([length if item.coordinate.kind == "length" else 1.0 for item in record.inputs])
    target = inputs_of(record, record.home_values) + MOVED * units * rng.uniform(-1, 1, size=len(units))
    path = record.follow(record.home_values, inputs=target)
    assert path.stopped is None
    return {"inputs": target.tolist(), "pose": np.asarray(path.poses[-1]).tolist()}


def _resized(record: Any, sizes: list[dict[str, Any]]) -> dict[str, Any]:
    """A dimension changed a little, inputs at home's: all dimensions as the page takes them, its length, the pose."""
    size = max(sizes, key=lambda item: item["value"] if item["unit"] == record.unit else 0.0)
    home = record.home_values
    found = resized(record, home, size["name"], GROWN * size["value"], "inputs", general_ranks(record, home))
    assert not found.why
    return {
        "sizes": [item["value"] * (GROWN if item is size else 1.0) for item in sizes],
        "length": characteristic_length(found.record),
        "pose": np.asarray(pose_of(found.record, found.values)).tolist(),
    }


def _singular_values(record: Any, home: np.ndarray) -> dict[str, float]:
    measures = record.instantaneous(home).measures
    return {"parallel": float(measures["output"]), "serial": float(measures["input"])}


def close(found: Any, wanted: Any) -> bool:
    """Whether plain data are the same, numbers to 1e-9."""
    if isinstance(wanted, dict):
        return set(found) == set(wanted) and all(close(found[key], wanted[key]) for key in wanted)
    if isinstance(wanted, list):
        return len(found) == len(wanted) and all(map(close, found, wanted))
    if isinstance(wanted, float):
        return bool(found == pytest.approx(wanted, rel=1e-9, abs=1e-9))
    return bool(found == wanted)


def test_the_stored_numbers_are_what_python_says(tmp_path):
    """To make them anew, from the root: `PYTHONPATH=tests/helpers:tests/page python -m test_page_solver`."""
    found, wanted = json.loads(STORED.read_text(encoding="utf-8")), json.loads(json.dumps(stored(tmp_path)))
    assert set(found) == set(wanted)
    assert [name for name in wanted if not close(found[name], wanted[name])] == []


@pytest.mark.node
@pytest.mark.parametrize("deep", ["", pytest.param("yes", marks=pytest.mark.deep)])
def test_the_pages_own_tests_pass(node, monkeypatch, deep):
    """By node's own runner, on the sources that the bundle is built from."""
    monkeypatch.setenv("ASSUR_DEEP", deep)
    files = sorted(map(str, (WEB / "test").glob("*.test.js")))
    assert len(files) > 3
    done = subprocess.run(
        [str(shutil.which("node")), "--test", *files], capture_output=True, text=True, timeout=240, check=False
    )
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]


@pytest.mark.node
@pytest.mark.parametrize("name", each(quick=WALKED_HERE))
@pytest.mark.parametrize(("moves", "seed"), [(15, 11), pytest.param(300, 13, marks=pytest.mark.deep)])
def test_no_stop_is_a_trap_and_every_reason_is_true(name, moves, seed):
    """Random moves of every mechanism: from a stop the way back is free, and the measures are as the reason says."""
    whole = content_of(name)
    given = {"scene": {key: whole[key] for key in WALKED}, "moves": moves * SELDOM.get(name, 1), "seed": seed}
    command = [str(shutil.which("node")), "--input-type=module", "-e", WALK, str(WEB)]
    done = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout)
    assert found["faults"] == []
    assert found["moves"] >= given["moves"]
    assert sum(found["stops"].values()) > 0


if __name__ == "__main__":
    with TemporaryDirectory() as made:
        STORED.write_text(json.dumps(stored(Path(made))), encoding="utf-8")
