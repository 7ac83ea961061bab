"""MuJoCo, Newton, Drake and Pinocchio themselves read the URDF file as the tree that it is."""

from xml.etree import ElementTree

import numpy as np
import pytest

from assur.export.bodies import bodies
from assur.export.names import link_name
from assur.export.urdf import anchor, urdf
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from simulators import TREES

pytestmark = pytest.mark.engines
ROUNDING = {"Newton": 1e-5}
"""Newton computes with single precision."""


@pytest.mark.parametrize("name", TREES)
def test_its_links_stand_at_home_and_each_joint_has_one_value(name, record, tmp_path, home, metre):
    path = tmp_path / "it.urdf"
    path.write_text(urdf(record))
    values, links = TREES[name](path)
    assert values == len(ElementTree.parse(path).getroot().findall("joint"))
    model = bodies(record)
    allowed = ROUNDING.get(name, 1e-9)
    compared = 0
    for own, (rotation, origin) in frames(record, home).items():
        link = link_name(own)
        if link in links:  # MuJoCo makes the base part of its world
            place = metre * origin + rotation @ anchor(model.bodies[own])
            np.testing.assert_allclose(links[link][0], rotation, atol=allowed)
            np.testing.assert_allclose(links[link][1], place, atol=allowed * metre * characteristic_length(record))
            compared += 1
    assert compared >= len(record.links) - 1
