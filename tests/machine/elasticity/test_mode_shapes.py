"""Mode shapes: they hang together at the joints, and their energies are those of their frequencies."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.machine.elasticity.mode_shapes import mode_shapes
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure
from assur.machine.elasticity.vibrations import mass_matrix, vibrations
from assur.machine.masses.bars import joint_points
from assur.machine.masses.link_masses import masses
from bending import bending
from own_machines import own_machine


@pytest.fixture(scope="module")
def state():
    record = assur.load("zeng2019")
    return strains(structure(record), record.home_values[None])


@pytest.fixture(scope="module")
def shapes(state):
    return mode_shapes(vibrations(state))


def off_its_bars():
    """A Par4 whose bars are beams between their couplers: the balls of its rods are beside these."""
    record = bending(own_machine("par4"))
    links = {name: replace(record.machine.links[name], bars=(joints,)) for name, joints in BARS.items()}
    return replace(record, machine=replace(record.machine, links={**record.machine.links, **links}))


BARS = {"bar1": ("Q1", "Q2"), "bar2": ("Q3", "Q4")}


@pytest.mark.parametrize("record", [assur.load("zeng2019"), off_its_bars()], ids=["zeng2019", "par4"])
def test_links_that_a_hinge_joins_move_there_alike(record):
    """Two links at a hinge or a ball have a point there, and it goes the same way."""
    for shape in mode_shapes(vibrations(strains(structure(record), home_values(record)[None]))):
        for joint in record.joints.values():
            if joint.type.slides or record.base in (joint.parent, joint.child):
                continue
            (first, moved), (second, other) = (shape.links[link] for link in (joint.parent, joint.child))
            gaps = np.linalg.norm(first[:, None] - second[None], axis=2)
            k, j = np.unravel_index(np.argmin(gaps), gaps.shape)
            assert gaps[k, j] < 1e-9, joint.name
            np.testing.assert_allclose(moved[k], other[j], atol=1e-9)


def test_frequencies_are_those_of_rayleighs_quotient(state, shapes):
    own, mass = vibrations(state), mass_matrix(state, masses(state.structure.record))
    for shape, unknowns in zip(shapes, own.shapes.T, strict=True):
        squared = (unknowns @ state.stiffness[0] @ unknowns) / (unknowns @ mass @ unknowns)
        assert np.sqrt(squared) / (2 * np.pi) == pytest.approx(shape.frequency, rel=1e-9)
        assert 2 * shape.shares.energy == pytest.approx(unknowns @ state.stiffness[0] @ unknowns, rel=1e-9)


def test_the_point_that_moves_most_has_gone_one_metre_and_the_base_none(state, shapes):
    for shape in shapes:
        sizes = {link: np.max(np.linalg.norm(moved, axis=1)) for link, (_, moved) in shape.links.items()}
        assert max(sizes.values()) == pytest.approx(1.0)
        assert sizes[state.structure.record.base] < 1e-12
        assert sum(shape.shares.links.values()) == pytest.approx(1.0)


def test_points_of_rigid_links_are_their_joints(state, shapes):
    record = state.structure.record
    rigid = next(link for link in record.links if link not in state.structure.skeletons and link != record.base)
    assert len(shapes[0].links[rigid][0]) == len(joint_points(record, rigid))
