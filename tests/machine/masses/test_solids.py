"""Links that weigh as the solids that are exported of them, against integrals by hand and triangles of files."""

from dataclasses import replace

import numpy as np
import pytest

from assur.errors import UsageError
from assur.export.cad.stl import RECORD, stl_files
from assur.machine.masses.link_masses import masses
from assur.machine.masses.solids import moments
from assur.model.machine_data import LinkData, MachineData, Material
from assur.model.registry import load_record
from assur.numerics.rotations import about_axis
from assur.scene.shapes import Cuboid
from assur.scene.sizes import with_thickness

ALUMINIUM = Material("aluminium", 2700.0)


def made_of_aluminium(name, links):
    data = MachineData({"aluminium": ALUMINIUM}, links=dict.fromkeys(links, LinkData(material="aluminium", rigid=True)))
    return replace(load_record(name), machine=data)


def test_moments_of_a_box_that_is_turned_and_moved_are_those_by_hand():
    turn, middle = about_axis(np.array([0.6, 0.0, 0.8]), np.array(0.7)), np.array([0.3, -2.0, 1.0])
    half = [0.1, 0.2, 0.5]
    volume, centre, inertia = moments(Cuboid(middle, np.diag(half) @ turn.T).mesh("#000000").corners)
    by_hand = 0.08 / 3 * np.diag([0.2**2 + 0.5**2, 0.1**2 + 0.5**2, 0.1**2 + 0.2**2])
    assert volume == pytest.approx(0.08, rel=1e-12)
    np.testing.assert_allclose(centre, middle, atol=1e-12)
    np.testing.assert_allclose(inertia, turn @ by_hand @ turn.T, atol=1e-12)


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_a_link_of_a_material_alone_weighs_as_the_triangles_that_are_exported(name):
    record = load_record(name)
    links = [link for link in record.links if link != record.base]
    record = with_thickness(made_of_aluminium(name, links), 4e-3 if record.unit == "m" else 4.0)
    bodies, files = masses(record).bodies, stl_files(record)
    assert [*bodies] == links
    for link, body in bodies.items():
        corners = np.frombuffer(files[f"{link}.stl"][84:], dtype=RECORD)["corners"].astype(float) / 1e3
        sixth = np.einsum("ki,ki->k", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        assert body.mass == pytest.approx(2700 * sixth.sum(), rel=1e-4)
        np.testing.assert_allclose(body.centre, sixth @ corners.mean(axis=1) * 0.75 / sixth.sum(), atol=1e-6)
        low, middle, high = np.linalg.eigvalsh(body.inertia)
        assert 0 < low <= middle <= high < low + middle


def test_without_a_stated_thickness_a_material_alone_is_refused():
    with pytest.raises(UsageError, match="crank1 of fivebar: made of aluminium, but its sizes are") as refused:
        masses(made_of_aluminium("fivebar", ["crank1"]))
    assert "thickness" in refused.value.hint
