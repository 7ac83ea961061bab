"""What is proved for a report, and what is answered where nothing is."""

import pytest

import assur
from assur.errors import UsageError
from assur.report.proofs import TOLERANCE, cube
from assur.results.attempt import attempt
from assur.workspace.certified.volume_bounds import GAPS, volume_bounds
from assur.workspace.region import workspace


def refuse():
    raise UsageError("it does not apply", hint="leave it out")


def fail():
    raise ZeroDivisionError


def test_a_refusal_is_a_reason_and_a_fault_stays_a_fault():
    assert attempt(lambda: 3) == 3
    assert attempt(refuse) == "it does not apply"
    with pytest.raises(ZeroDivisionError):
        attempt(fail)


def test_the_gap_follows_how_many_coordinates_the_region_depends_on():
    for name, depends in (("zeng2019", 2), ("orthoglide", 3)):
        record = assur.load(name)
        found = volume_bounds(record, workspace(record, resolution=8))
        assert len(found.paving.names) == depends
        assert found.gap == GAPS[depends]
        assert found.gap_reached <= found.gap
        assert found.stopped == ""


def test_angles_are_held_as_they_are_in_the_configuration():
    record = assur.load("planar_3rpr")
    here = next(iter(record.direct([10.0, 12.0, 11.0])), None) or next(
        iter(record.direct(record.home_values[[1, 4, 7]]))
    )
    found = cube(record, here)
    assert dict(found.held) == {"phi": here.pose[2]}
    assert found.shape.centre == pytest.approx(here.pose[:2], abs=0)
    assert found.refuted <= (1 + 2 * TOLERANCE) * found.size


def test_about_a_quaternion_it_is_refused():
    with pytest.raises(UsageError, match="quaternion"):
        cube(assur.load("gough_stewart"), None)
