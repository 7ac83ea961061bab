"""Natural vibrations: by hand, and as rigid links on springs."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure
from assur.machine.elasticity.vibrations import vibrations
from bending import bending
from weighed import place

POSE = [-15.4714, 9.6849, 456.3315]


def test_soft_actuators_and_stiff_bars_are_the_same_as_rigid_bars():
    bare = assur.load("planar_3rrr")
    record = bending(bare, 1e6)
    rigid = {name: replace(data, rigid=True) for name, data in record.machine.links.items()}
    values = place(bare)
    other = replace(record, machine=replace(record.machine, links=rigid))
    own = stiffness_at(record, values).vibrations().frequencies[:3]
    np.testing.assert_allclose(own, stiffness_at(other, values).vibrations().frequencies, rtol=1e-4)


def test_spins_of_rods_between_balls_do_not_count():
    record = assur.load("linear_delta_4s")
    state = strains(structure(record), record.home_values[None])
    own = vibrations(state)
    assert len(own.frequencies) == 6
    assert own.frequencies[0] > 1.0
    assert np.all(np.diff(own.frequencies) >= 0)


def test_links_without_a_mass_are_named():
    record = assur.load("zeng2019")
    links = {name: data for name, data in record.machine.links.items() if name != "slider2"}
    own = replace(record, machine=replace(record.machine, links=links)).stiffness(POSE).vibrations()
    assert own.lacking == ("slider2",)
    assert own.frequencies.size == 0


def test_a_slender_cantilever_by_hand():
    """The parts of a bar of one element: 1.875^2 within what one cubic can follow."""
    from assur.machine.elasticity.beams import beam, consistent_mass
    from assur.model.machine_data import Material, Profile

    profile = Profile("rod", "round", (0.01,), 7.85e-5, 4.9e-10, 4.9e-10, 9.8e-10)
    own = beam(profile, Material("steel", 7850.0, 210e9, 0.3), 1.0, shear=False)
    mass = consistent_mass(own, 7850.0 * profile.area, 1e-9)[6:, 6:]
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(mass, own.stiffness)).real)
    exact = 1.8751**2 * np.sqrt(210e9 * profile.iz / (7850.0 * profile.area))
    assert np.sqrt(squares[0]) == pytest.approx(exact, rel=5e-3)
