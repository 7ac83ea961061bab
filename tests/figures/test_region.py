from __future__ import annotations

import numpy as np
import pytest

from assur.workspace.fields import at_points


def test_the_numbers_are_those_of_the_workspace(context, data):
    found = data("workspace")
    assert found["volume"] == context.workspace.volume
    assert found["mode"] == context.workspace.mode
    assert found["parallel_singular"]["share"] == context.workspace.share


def test_the_drawn_surface_encloses_the_volume(data):
    found = data("workspace")
    corners = found["vertices"][found["faces"]]
    if corners.shape[-1] == 3:
        volume = np.sum(np.linalg.det(corners)) / 6
    else:
        volume = (
            np.sum(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])) / 2
            if False
            else None
        )
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        volume = np.sum(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    assert volume == pytest.approx(found["volume"], rel=1e-6)


def test_the_loci_are_zeros_of_their_factors(context, data):
    from assur.workspace.fields import factor_fields

    fields = factor_fields(context.record, context.workspace.mode)
    for item in data("workspace")["loci"]:
        if len(item["vertices"]):
            values = at_points(fields[item["factor"]], len(context.record.platform.pose), item["vertices"])
            assert np.max(np.abs(values)) < 0.5
