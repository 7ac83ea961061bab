"""The table of joint types: letters and freedoms of the theory."""

import pytest

from assur.joints.catalogue import JOINT_TYPES


@pytest.mark.parametrize(
    ("name", "letter", "freedoms"),
    [
        ("revolute", "R", 1),
        ("prismatic", "P", 1),
        ("helical", "H", 1),
        ("cylindrical", "C", 2),
        ("universal", "U", 2),
        ("spherical", "S", 3),
    ],
)
def test_joint_types_have_the_freedoms_of_the_theory(name, letter, freedoms):
    joint_type = JOINT_TYPES[name]
    assert (joint_type.letter, joint_type.freedoms) == (letter, freedoms)
    assert len(joint_type.kinds) == freedoms
