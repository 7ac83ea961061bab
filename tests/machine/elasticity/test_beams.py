"""Beams: flexibility against the textbook's matrix, shear areas by hand, masses as of slender rods."""

import numpy as np
import pytest

from assur.machine.elasticity.beams import beam, consistent_load, consistent_mass, shear_areas
from assur.model.machine_data import Material, Profile
from bending import textbook

STEEL = Material("steel", 7850.0, 210e9, 0.3)
BOX = Profile("box", "box", (0.03, 0.01), 3e-4, 2.5e-9, 2.25e-8, 1e-8)


@pytest.mark.parametrize("shear", [True, False])
def test_the_second_end_gives_way_as_the_textbook_says(shear):
    own = beam(BOX, STEEL, 0.4, shear=shear)
    order = [3, 4, 5, 0, 1, 2]
    held = textbook(BOX, STEEL, 0.4, shear)[6:, 6:]
    np.testing.assert_allclose(own.stiffness[np.ix_(order, order)], held, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("shear", [True, False])
def test_a_section_moves_as_the_end_of_a_shorter_beam_says(shear):
    """The same wrench at the second end, carried to a section: what is before it is a beam by itself."""
    own, wrench = beam(BOX, STEEL, 0.4, shear=shear), np.array([1.0, -2.0, 3.0, 4.0, -5.0, 6.0])
    strain = own.parts.sum(axis=0) @ wrench
    for along in (0.1, 0.25, 0.4):
        carried = wrench + np.concatenate([np.cross([0.4 - along, 0.0, 0.0], wrench[3:]), np.zeros(3)])
        expected = beam(BOX, STEEL, along, shear=shear).parts.sum(axis=0) @ carried
        moved = own.displaced(np.array([along]))[0] @ strain
        np.testing.assert_allclose(np.roll(moved, 3), expected, rtol=1e-9)


def test_shear_areas_of_tubes_grow_into_those_of_bars_and_of_thin_rings():
    def factor(inner):
        return shear_areas(Profile("tube", "tube", (1.0, inner), 1.0, 1.0, 1.0, 1.0), 0.3)[0]

    assert factor(0.0) == pytest.approx(6 * 1.3 / (7 + 6 * 0.3))
    assert factor(1.0) == pytest.approx(2 * 1.3 / (4 + 3 * 0.3))
    assert shear_areas(BOX, 0.3) == (2.5e-4, 2.5e-4)


def test_moved_rigidly_a_beam_weighs_as_a_slender_rod():
    own = beam(BOX, STEEL, 0.4)
    mass = consistent_mass(own, 2.0, 0.01)[:6, :6]
    expected = np.diag([0.4 * 0.01, 2 * 0.4**3 / 3, 2 * 0.4**3 / 3, 0.8, 0.8, 0.8])
    expected[2, 4] = expected[4, 2] = 0.8 * 0.2
    expected[1, 5] = expected[5, 1] = -0.8 * 0.2
    np.testing.assert_allclose(mass, expected, atol=1e-15)


def test_a_uniform_load_bends_a_cantilever_as_it_should():
    """By w L^4 / 8 E I and w L^3 / 6 E I, and w L^2 / 2 G A more by shear."""
    own = beam(BOX, STEEL, 0.4)
    load = consistent_load(own)[0] @ [0.0, 1.0, 0.0, 0.0]
    moved = own.parts.sum(axis=0) @ load[6:]
    bend, rigidity = 210e9 * 2.25e-8, 210e9 / 2.6 * 2.5e-4
    assert moved[4] == pytest.approx(0.4**4 / (8 * bend) + 0.4**2 / (2 * rigidity))
    assert moved[2] == pytest.approx(0.4**3 / (6 * bend))
    np.testing.assert_allclose(load[[2, 4]], [0.4**2 / 2, 0.4])
