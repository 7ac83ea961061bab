"""The page moves a platform through a right angle of theta, as Python follows it there."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from assur.kinematics.following.following import follow
from assur.mechanism import load
from assur.page.content import content
from spherical import ANGLES, OBLIQUE, spherical

WEB = Path(__file__).parents[2] / "web"
MOVE = """
import { readFileSync } from "node:fs";
const { scene, poses } = JSON.parse(readFileSync(0, "utf8"));
const { Mechanism } = await import(`${process.argv[1]}/src/mechanism.js`);
const { compiled } = await import(`${process.argv[1]}/test/compiled.js`);
const mechanism = new Mechanism(compiled(scene));
process.stdout.write(JSON.stringify(poses.map((pose) => mechanism.toPose(pose))));
"""


@pytest.mark.node
def test_it_goes_through_and_comes_back(tmp_path):
    record = load(spherical(tmp_path, ANGLES, OBLIQUE))
    poses = np.radians([[0, -90, 0], [180, -89.5, 180], [0, -90, 0], [0, -45, 0], [0, 0, 0]])
    words = [str(shutil.which("node")), "--input-type=module", "-e", MOVE, str(WEB)]
    given = json.dumps({"scene": content(record, ()), "poses": poses.tolist()})
    done = subprocess.run(words, input=given, capture_output=True, text=True, check=True)
    states = json.loads(done.stdout)
    assert [(state["status"], state["reason"]) for state in states] == [("moved", None)] * len(poses)
    path = follow(record, record.home_values, poses=poses[:2])
    for state, expected in zip((states[1], states[-1]), (path.joints[-1], record.home_values), strict=True):
        assert np.max(np.abs(np.sin((np.array(state["values"]) - expected) / 2))) < 1e-8
