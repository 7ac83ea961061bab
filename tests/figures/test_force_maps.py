"""Maps of forces are those of the capacity over the workspace."""

import numpy as np

from assur.figures import catalogue as figures
from assur.machine.forces.capacity_maps import capacity_maps


def test_maps_are_those_of_the_workspace(context):
    data = figures.drawing(context.record, "forces", context).data
    (first, xs), (second, _) = data["axes"].items()
    maps = capacity_maps(context.record, context.workspace, [first, second], data["held"], len(xs))
    np.testing.assert_allclose(np.array(data["maps"]["sphere"]["values"], dtype=float), maps["sphere"], rtol=1e-9)
    assert "held in every direction" in figures.spec(context.record, "forces", context).caption
