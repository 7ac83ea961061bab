"""Williams' snapshot examples of the ABB FlexPicker, each number under its address."""

import math

import numpy as np
import pytest

import assur

PRINTED = {
    "Nominal position, inverse row 1": ["-20.5", "-20.5", "-20.5"],
    "General position, inverse row 1": ["47.5", "-11.6", "21.4"],
    "General position, direct row 1": ["0.108", "-0.180", "-1.244"],
}


@pytest.mark.parametrize("address", PRINTED)
def test_snapshot_agrees(at, address):
    rows = at(address).values()
    assert [row.printed for row in rows] == PRINTED[address]
    assert [row.verdict for row in rows] == ["ok", "ok", "ok"]
    assert all(row.tolerance < 0.051 for row in rows)


def test_height_at_horizontal_arms_is_printed_from_dimensions_less_rounded(at):
    """Erratum E2: by Pythagoras, from the printed sides of the two triangles."""
    rows = at("Nominal position, direct row 1")
    height = -math.sqrt(1.244**2 - (0.524 + 0.567 / math.sqrt(12) - 0.076 / math.sqrt(3)) ** 2)
    assert rows["z"].computed == pytest.approx(height, abs=1e-12)
    assert (rows["z"].verdict, rows["z"].erratum) == ("wrong", "E2")
    assert 0.0005 < abs(rows["z"].off_by) < 0.0006


def test_angles_of_the_general_position_by_bisection():
    """A second route: the distance of knee and wrist, without any closed form."""
    radius, corner = 0.567 / math.sqrt(12), 0.076 / math.sqrt(3)
    for azimuth, printed in zip((-90, 30, 150), (47.5, -11.6, 21.4), strict=True):
        c, s = math.cos(math.radians(azimuth)), math.sin(math.radians(azimuth))
        outwards, around = 0.3 * c + 0.5 * s + corner - radius, 0.5 * c - 0.3 * s

        def miss(angle, outwards=outwards, around=around):
            knee = (0.524 * math.cos(math.radians(angle)), -0.524 * math.sin(math.radians(angle)))
            return math.hypot(outwards - knee[0], around, -1.1 - knee[1]) - 1.244

        low, high = printed - 0.05, printed + 0.05
        assert miss(low) * miss(high) < 0


@pytest.mark.parametrize(
    ("angles", "position"),
    [
        ([0, 0, 0], [0.0, 0.0, -1064.4517]),
        ([10, 20, 30], [108.1354, -180.3484, -1243.5413]),
        ([-20.5, -20.5, -20.5], [0.0, 0.0, -900.3195]),
        ([47.5, -11.6, 21.4], [300.4598, 499.9385, -1099.8281]),
        ([0, 0, 60], [619.5159, -357.6777, -1040.1298]),
    ],
)
def test_a_public_program_for_the_paper_has_the_same_positions(angles, position):
    """In mm, as github.com/Pieces98/Deltarobot_Kinematics prints them for sB = 567, sP = 76, L = 524, l = 1244."""
    found = assur.load("delta_4s").direct(np.radians(angles), "+")
    np.testing.assert_allclose(1000 * found.poses[0], position, rtol=0, atol=6e-5)


def test_audit_is_complete(found):
    assert found.origin == "printed"
    assert found.claims_hold
    assert found.ok > 10
    assert found.wrong == 1
