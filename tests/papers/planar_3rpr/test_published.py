"""The planar Stewart platform of a textbook: T. Sauer, Numerical Analysis, Pearson, Reality Check 1.

The book gives the struts p1, p2, p3 from (0, 0), (x1, 0) and (x2, y2) to a triangle with the sides L1, L2, L3 and the
angle gamma between L2 and L3. Where it says how many poses there are, the numbers here are its own.
"""

import math

import numpy as np
import pytest

import assur

ROOT2, ROOT5 = math.sqrt(2), math.sqrt(5)
FIGURE = {"x1": 4, "x2": 0, "y2": 4, "L1": 2, "L2": ROOT2, "L3": ROOT2, "gamma": math.pi / 2}
STEP4 = {"x1": 5, "x2": 0, "y2": 6, "L1": 3, "L2": 3 * ROOT2, "L3": 3, "gamma": math.pi / 4}


def poses(book, struts):
    lengths = {"a2": book["x1"], "a3": book["x2"], "h3": book["y2"]}
    sides = {"d1": book["L3"], "d2": book["L1"], "d3": book["L2"]}
    found = assur.load("planar_3rpr").with_parameters(**lengths, **sides).direct(struts)
    assert found.complete
    return found.poses[found.exists]


def roots(book, struts):
    """A second route: changes of sign of the book's f(theta) over a turn."""
    theta = np.linspace(-np.pi, np.pi, 20001)
    p1, p2, p3 = struts
    a2, b2 = book["L3"] * np.cos(theta) - book["x1"], book["L3"] * np.sin(theta)
    a3, b3 = (
        book["L2"] * np.cos(theta + book["gamma"]) - book["x2"],
        book["L2"] * np.sin(theta + book["gamma"]) - book["y2"],
    )
    left, right = p2**2 - p1**2 - a2**2 - b2**2, p3**2 - p1**2 - a3**2 - b3**2
    across, along = b3 * left - b2 * right, a2 * right - a3 * left
    f = across**2 + along**2 - (p1 * 2 * (a2 * b3 - b2 * a3)) ** 2
    changes = np.flatnonzero(f[:-1] * f[1:] < 0)
    return theta[changes] - f[changes] * (theta[1] - theta[0]) / (f[changes + 1] - f[changes])


def test_figure_has_the_poses_of_plus_and_minus_a_quarter_of_pi():
    found = poses(FIGURE, [ROOT5] * 3)
    np.testing.assert_allclose(found, [[1, 2, -math.pi / 4], [2, 1, math.pi / 4]], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("p2", "printed"), [(5, 4), (7, 6)], ids=["step 4: four poses", "step 5: six poses"])
def test_number_of_poses_is_the_printed_one(p2, printed):
    struts = [5, p2, 3]
    found = poses(STEP4, struts)
    assert len(found) == printed
    np.testing.assert_allclose(np.sort(found[:, 2]), roots(STEP4, struts), rtol=0, atol=1e-5)


@pytest.mark.parametrize(("p2", "number"), [(3.0, 0), (4.0, 2), (6.0, 4), (7.0, 6), (7.5, 4), (8.5, 2), (9.5, 0)])
def test_steps_6_and_7_ask_for_lengths_with_none_two_four_and_six(p2, number):
    assert len(poses(STEP4, [5, p2, 3])) == len(roots(STEP4, [5, p2, 3])) == number
