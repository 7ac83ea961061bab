"""The page moves screws by real turns, as Python does; each expected number is worked out from the pitches."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from assur.page.content import content
from screw_mechanisms import FIVEBAR, loaded

WEB = Path(__file__).parents[2] / "web"
MOVE = """
import { readFileSync } from "node:fs";
const { scene, inputs, pose } = JSON.parse(readFileSync(0, "utf8"));
const { Mechanism } = await import(`${process.argv[1]}/src/mechanism.js`);
const { compiled } = await import(`${process.argv[1]}/test/compiled.js`);
const mechanism = new Mechanism(compiled(scene));
const found = inputs.map((target) => mechanism.toInputs(target));
process.stdout.write(JSON.stringify({ found, back: mechanism.toPose(pose) }));
"""


@pytest.mark.node
def test_sliders_of_screws_turn_as_often_as_they_are_asked_to(tmp_path):
    record = loaded(tmp_path, FIVEBAR, ("pitch = -5 }", "pitch = -5, limits = [-1800, 1800] }"))
    turns = [(2.0, 0.0), (7.5, -6.0), (0.0, 0.0)]
    given = {
        "scene": content(record, ()),
        "inputs": (2 * np.pi * np.array(turns)).tolist(),
        "pose": [-30.0, 110.0],
    }
    words = [str(shutil.which("node")), "--input-type=module", "-e", MOVE, str(WEB)]
    done = subprocess.run(words, input=json.dumps(given), capture_output=True, text=True, timeout=120, check=True)
    moved = json.loads(done.stdout)
    reached = [turns[0], (2 + 5.5 * 5 / 6, -5.0), turns[2]]  # the second way ends where S2 has made its five turns
    for state, (first, second) in zip(moved["found"], reached, strict=True):
        left, right = -50 - 10 * first, 50 + 5 * second
        height = np.sqrt(130**2 - (0.5 * (right - left)) ** 2)
        assert state["pose"] == pytest.approx([0.5 * (left + right), height], abs=0.05)
        assert state["limits"]["stated"] is True
        assert state["limits"]["exceeded"] == []
    assert [state["status"] for state in moved["found"]] == ["moved", "stopped", "moved"]
    half = np.sqrt(130**2 - 110**2)
    wanted = 2 * np.pi * np.array([(-50 - (-30 - half)) / 10, (-30 + half - 50) / 5])
    assert moved["back"]["inputs"] == pytest.approx(wanted, abs=1e-9)
