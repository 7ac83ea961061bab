"""One condition number, wherever it is printed: the page, the report, the indices, the view, Python."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.following.following import follow
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.units import is_mixed
from assur.kinematics.rates.velocity import velocity_map_at
from assur.mechanism import load
from assur.page.content import content
from assur.performance.indices import indices_at
from assur.report.findings import Findings
from assur.report.sections.velocity import velocity
from assur.results.kinds import Scalar
from assur.view.readings import readings
from assur.view.snapshot import start
from spherical import ANGLES, OBLIQUE, QUATERNION, spherical

WEB = Path(__file__).parents[2] / "web"
MEASURES = """
import { readFileSync } from "node:fs";
const { scene, values } = JSON.parse(readFileSync(0, "utf8"));
const { modelOf } = await import(`${process.argv[1]}/src/solver/configuration.js`);
const { compiled } = await import(`${process.argv[1]}/test/compiled.js`);
const { conditionAt, measuresAt } = await import(`${process.argv[1]}/src/solver/rates.js`);
const model = modelOf(compiled(scene));
const { parallel, serial } = measuresAt(model, values);
process.stdout.write(JSON.stringify({ condition: conditionAt(model, values), output: parallel, input: serial }));
"""
DRAFTS = {
    "mixed": ["{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "P[x] R[y] R[y] R[z]"],
    "hybrid": ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"],
    "planar": ["R[z] R[z] R[z]", "P[x] R[z] R[z]", "R[z] R[z] R[z]"],
}
BUILT_IN = ("fivebar", "planar_3rpr", "planar_3rrr", "three_rps", "h4_robot", "gough_stewart", "zeng2019")


@pytest.fixture(scope="module")
def mechanisms(tmp_path_factory):
    """Some of the catalogue, some that are drafted from notation, some from a file."""
    folder = tmp_path_factory.mktemp("drafts")
    found = {name: load(name) for name in BUILT_IN}
    for name, chains in DRAFTS.items():
        path = str(folder / f"{name}.toml")
        assert main(["new", path, *(word for chain in chains for word in ("--chain", chain))]) == 0
        found[name] = load(path)
    for name, pose in (("angles", ANGLES), ("quaternion", QUATERNION)):
        found[name] = load(spherical(folder, pose, OBLIQUE, name))
    return found


def own(record, values):
    """By singular values of J from the null space of the closure, lengths over L where they mix with angles."""
    matrix = velocity_map_at(record, values).matrix
    length = characteristic_length(record) if is_mixed(record) else 1.0
    rates = [length if name in ("x", "y", "z") else 1.0 for name in (*record.platform.pose, "", "", "")[: len(matrix)]]
    inputs = [length if item.coordinate.kind == "length" else 1.0 for item in record.inputs]
    return float(np.linalg.cond(matrix / np.array(rates)[:, None] * np.array(inputs)))


@pytest.mark.parametrize("name", [*BUILT_IN, *DRAFTS, "angles", "quaternion"])
def test_python_the_report_and_the_view_agree(mechanisms, name):
    record = mechanisms[name]
    found = Findings(record, illustrated=False)
    numbers = [item for item in velocity(found).results[-1].results if isinstance(item, Scalar)]
    said = next(item for item in numbers if item.name == "condition number")
    expected = own(record, found.joints)
    assert said.value == pytest.approx(expected, rel=1e-6)
    assert ("characteristic length" in said.note) == is_mixed(record)
    assert float(indices_at(record, found.joints).condition_number) == pytest.approx(expected, rel=1e-6)
    assert float(1 / indices_at(record, found.joints)["condition"]) == pytest.approx(expected, rel=1e-6)
    home = start(record)
    reading = next(item for item in readings(home) if item.name == "condition number")
    assert float(reading.text) == pytest.approx(own(record, home.values), rel=1e-3)
    assert ("characteristic length" in reading.about) == is_mixed(record)


@pytest.mark.node
@pytest.mark.parametrize("name", [*BUILT_IN, *DRAFTS, "angles", "quaternion"])
def test_the_page_agrees(mechanisms, name, monkeypatch):
    monkeypatch.setattr("assur.page.content.branches", lambda _: {})  # which take longest, and nothing here reads
    record = mechanisms[name]
    scene = content(record, [])
    node = shutil.which("node")
    assert node
    values = record.home_values
    if name == "angles":  # away from home, where rates of angles and angular velocities differ
        values = follow(record, values, poses=[0.3, 0.5, -0.2]).joints[-1]
    words = [node, "--input-type=module", "-e", MEASURES, WEB.as_uri()]
    given = json.dumps({"scene": scene, "values": values.tolist()})
    found = json.loads(subprocess.run(words, input=given, capture_output=True, text=True, check=True).stdout)
    assert found["condition"] == pytest.approx(own(record, values), rel=1e-6)
    measures = instantaneous(record, values).measures
    assert found["output"] == pytest.approx(float(measures["output"]), rel=1e-6)
    assert found["input"] == pytest.approx(float(measures["input"]), rel=1e-6)
