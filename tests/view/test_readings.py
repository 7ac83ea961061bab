"""Live numbers against the functions of the library."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.postures import postures
from assur.singularity.distance import distance
from assur.view.readings import Reading, clearance, closest_factor, limits_reading, readings, table
from assur.view.snapshot import start


def _working(snapshot):
    return postures(snapshot.record, snapshot.values, "inverse")


@pytest.fixture(scope="module")
def here():
    return start(assur.load("zeng2019"))


def test_the_numbers_are_those_of_the_library(here):
    found = {item.name: item.text for item in readings(here)}
    for name, value in zip(here.record.platform.pose, here.pose, strict=True):
        assert found[name] == f"{value:.4f} mm"
    for item, value in zip(here.record.inputs, here.inputs, strict=True):
        assert found[item.name] == f"{value:.4f} mm"
    assert found["condition number"] == f"{float(here.record.velocity_map(here.pose, '++-++').condition):.4g}"
    assert (found["working mode"], found["assembly mode"]) == ("++-++", "+++")
    assert float(found["residual"].split()[0]) < 1e-9


def test_the_closest_factor_is_that_of_the_verdict(here):
    verdict = here.record.singularity(here.pose, "++-++")
    said = closest_factor(here, _working(here))
    assert said.text == f"{verdict.closest} = {verdict.relative[verdict.closest]:.3g}"


@pytest.mark.slow
def test_the_clearance_is_the_distance_of_the_library(here):
    said = clearance(here, _working(here))
    found = distance(here.record, here.pose, "++-++")
    assert said.text == f"{float(found.value):.4g} mm"
    assert said.about == f"there {found.factor} = 0"


def test_without_a_closed_form_there_is_neither():
    record = assur.load("fivebar")
    import dataclasses

    bare = start(dataclasses.replace(record, closed_form=None))
    found = _working(bare)
    assert closest_factor(bare, found) is None
    assert clearance(bare, found) is None
    assert np.isfinite(float({item.name: item.text for item in readings(bare)}["condition number"]))


def test_what_a_file_says_is_text_in_the_page():
    assert "<script" not in table([Reading("<script>", "<script>", '"<script>')])


def test_the_limit_that_is_exceeded_most_is_read_off():
    """Legs of 400 mm where strokes end at 320."""
    record = assur.load("three_rps")
    here = start(record)
    values = next(iter(record.direct([400.0, 380.0, 390.0]))).joints
    outside = dataclasses.replace(here, values=np.array(list(values.values())))
    assert limits_reading(outside).text == "rho1 outside by 80 mm, 2 more"
    assert limits_reading(here).text == "within"
