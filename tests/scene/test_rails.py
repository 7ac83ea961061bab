"""Every slider of a mechanism stands on its rail, and so does all of its stroke."""

import numpy as np

import assur
from assur.scene.bodies import home_skeleton
from assur.scene.companion import companion
from assur.scene.parts import machine
from assur.scene.rails import rails


def test_sliders_are_on_their_rails(every):
    found = rails(every.skeleton, every.companion)
    for mark in every.skeleton.marks:
        if mark.grounded and mark.slides:
            assert any(distance(mark.at, rail) < 1e-6 * every.skeleton.size for rail in found)


def distance(point, rail):
    start, end = rail.ends
    share = np.clip((point - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
    return np.linalg.norm(start + share * (end - start) - point)


def test_rails_lie_about_the_sliders_and_not_about_the_point_where_their_axes_meet():
    record = assur.load("orthoglide")
    drawn = home_skeleton(record)
    platform, origin = drawn.frames[record.platform.link]
    place = origin + platform @ record.platform.point
    for rail in rails(drawn, companion(record)):
        assert np.min(np.linalg.norm(rail.ends - place, axis=1)) > 0.5 * np.linalg.norm(rail.sliders[0].at - place)


def test_what_a_base_stands_on_reaches_under_every_rail(every):
    parts = machine(every.record)
    (plate,) = [part.shape for part in parts if part.name == "base plate"] or [None]
    if plate is not None:
        low, high = plate.outline.min(axis=0)[:2], plate.outline.max(axis=0)[:2]
        for rail in rails(every.skeleton, every.companion):
            assert np.all(rail.ends[:, :2] >= low)
            assert np.all(rail.ends[:, :2] <= high)


def test_a_column_ends_in_the_middle_of_its_rail():
    """Also of one that lies below its slider, as what is hinged to the slider needs room."""
    for name in ("orthoglide", "linear_delta_4s", "tripteron"):
        made = machine(assur.load(name))
        beds = [part.shape for part in made if part.role == "rail"]
        for column in (part.shape for part in made if part.role == "column"):
            ends = [bed.centre + sense * bed.sides[0] for bed in beds for sense in (-1, 1)]
            tops = [*ends, *(part.shape.start for part in made if part.role == "column")]
            assert min(np.linalg.norm(column.end - top) for top in tops) < 1e-9 * np.max(np.abs(ends))
