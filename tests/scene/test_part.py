"""Parts: every one has a role that its description names, and a shape in its link's frame."""

import re

from assur.scene.part import Part
from assur.scene.parts import parts


def test_every_role_is_described(every):
    said = re.search(r"role: what it does: (.*?)\.\n", Part.__doc__, re.DOTALL)
    assert said is not None
    roles = set(re.split(r",\s+", said[1]))
    assert {item.role for item in parts(every.skeleton, every.companion)} <= roles
