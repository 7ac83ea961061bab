"""Home as the file means it."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.carried_home import OTHERS_HINT
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.dimensions import with_parameters
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains


@pytest.mark.parametrize(("name", "unit"), [("delta_4s", 1.0), ("h4_robot", 1000.0)])
def test_a_symmetric_mechanism_stands_symmetric(name, unit):
    """Joint values are written to ten digits, so that what is zero by symmetry is zero to picometres."""
    mechanism = assur.load(name)
    pose = dict(zip(mechanism.platform.pose, pose_of(mechanism, mechanism.home_values), strict=True))
    off = [value for key, value in pose.items() if key != "z"]
    np.testing.assert_allclose(off, 0.0, rtol=0, atol=2e-12 * unit)


def test_dimensions_that_lead_into_another_mode_say_which_and_what_can_be_done(tmp_path):
    """The mode has one group of signs, so that no blank stands beside it."""
    chains = parse_chains(["R[z] R[z] R[z]"] * 3)
    (tmp_path / "my.toml").write_text(drafted(chains, tmp_path / "my.toml", coordinates=True).text, encoding="utf-8")
    record = assur.load(tmp_path / "my.toml")
    with pytest.raises(UsageError) as caught:
        home_values(with_parameters(record, C_x=900.0))
    assert caught.value.message == "my: from home the loops close in the mode ---, not in +++ as before"
    assert caught.value.hint == OTHERS_HINT
    assert "a copy of the file" in OTHERS_HINT
