"""MuJoCo, Newton, Drake and Pinocchio themselves read the exported files, and the documentation says what they read."""

import re
from pathlib import Path

import numpy as np
import pytest

import assur
import simulators
from assur.export.mjcf import mjcf
from assur.joint_graph.geometry import characteristic_length
from simulators import CLOSED, MECHANISMS, SCREWS, SIMULATORS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "export.md").read_text(encoding="utf-8")


def pinned():
    return dict(re.findall(r"^([\w-]+)==(\S+)$", (ROOT / "constraints.txt").read_text(encoding="utf-8"), re.M))


def test_the_table_is_of_the_pinned_versions_and_of_what_is_written():
    assert simulators.head(pinned()) in PAGE
    for name in MECHANISMS:
        constraints, actuators = simulators.written(assur.load(name))
        assert f"| `{name}` | {constraints} + {actuators} |" in PAGE


@pytest.fixture
def file(record, tmp_path):
    path = tmp_path / "it.xml"
    path.write_text(mjcf(record))
    return path


@pytest.mark.engines
@pytest.mark.parametrize("name", SIMULATORS)
def test_it_reads_every_loop_and_actuator_and_closes_them_where_we_do(
    name, record, file, home, elsewhere, anywhere, metre
):
    rests = simulators.file_values(record, home)
    reading = SIMULATORS[name][1](file, rests)
    screws = sum(joint.type.letter == "H" for joint in record.joints.values())
    constraints, actuators = simulators.written(record)
    assert reading.constraints == constraints - (0 if SCREWS[name] else screws)
    assert reading.actuators in (actuators, None)
    size = metre * characteristic_length(record)
    for values in (home, elsewhere):
        assert reading.gap(simulators.file_values(record, values)) < CLOSED[name] * size
    assert reading.gap(simulators.file_values(record, anywhere)) > 1e-3 * size


@pytest.mark.engines
def test_the_table_is_what_they_read(tmp_path):
    lines = [simulators.head(simulators.installed_versions())]
    for name in MECHANISMS:
        record, path = assur.load(name), tmp_path / f"{name}.xml"
        path.write_text(mjcf(record))
        rests = simulators.file_values(record, np.array(record.home))
        readings = {one: read(path, rests) for one, (_, read) in SIMULATORS.items()}
        lines.append(simulators.row(name, simulators.written(record), readings))
    missing = [line for line in lines if line not in PAGE]
    assert missing == [], "docs/export.md has other lines"
