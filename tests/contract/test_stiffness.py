"""Laws of stiffness, for every mechanism with beams of random profiles; none knows a printed number."""

import numpy as np
import pytest

from assur.kinematics.status import Status
from assur.machine.stiffness import stiffness_at
from bending import bending, by_multipliers
from weighed import place


@pytest.fixture
def bent(mechanism):
    return stiffness_at(bending(mechanism), place(mechanism))


def test_compliance_is_symmetric_positive_and_that_of_the_other_route(bent):
    """Bars by the matrix of the textbook, joints by multipliers: rigid links and joints that hold twice among them."""
    (compliance,) = bent.compliance
    assert bent.status[0] == Status.regular
    other = by_multipliers(bent.record, bent.values[0])
    units = np.repeat([bent.length, 1.0], 3)
    size = np.abs(other / units / units[:, None]).max()
    np.testing.assert_allclose(compliance / units / units[:, None], other / units / units[:, None], atol=1e-8 * size)
    assert np.linalg.eigvalsh(compliance / units / units[:, None])[0] >= -1e-12 * size


def test_work_of_loads_is_energy_of_strains_and_shares_are_whole(bent):
    shares = bent.shares()
    assert shares.energy == pytest.approx(0.5 * np.trace(bent.compliance[0, :3, :3]), rel=1e-9)
    for split in (shares.links, shares.kinds, shares.actuators):
        assert sum(split.values()) == pytest.approx(1.0)


def test_as_links_stiffen_only_the_actuators_are_left(mechanism):
    values = place(mechanism)
    motors = stiffness_at(bending(mechanism), values).actuator_only
    units = np.repeat([motors.length, 1.0], 3)
    left, less = (
        np.abs((stiffness_at(bending(mechanism, factor), values).compliance - motors.compliance)[0] / units).max()
        for factor in (10.0, 1e3)
    )
    assert motors.rank[0] == len(mechanism.inputs)
    assert less <= 0.012 * left + 1e-9 * np.abs(motors.compliance[0] / units).max()
