"""Every slider of a mechanism stands on its rail, and so does all of its stroke."""

import numpy as np

from assur.scene.rails import rails


def test_sliders_are_on_their_rails(every):
    found = rails(every.skeleton, every.companion)
    for mark in every.skeleton.marks:
        if mark.grounded and mark.slides:
            assert any(distance(mark.at, rail) < 1e-6 * every.skeleton.size for rail in found)


def distance(point, rail):
    start, end = rail
    share = np.clip((point - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
    return np.linalg.norm(start + share * (end - start) - point)
