"""What is said to be zero nowhere keeps its sign at thousands of poses; what vanishes somewhere is never said to."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.workspace.aspects.nowhere import nothing_reached, nowhere_zero
from assur.workspace.region import workspace

NAMES = ("zeng2019", "fivebar", "linear_delta_4r", "three_upu", "h4_robot")


@pytest.mark.parametrize("name", NAMES)
def test_what_is_proved_keeps_its_sign_at_poses_inside(name):
    record = assur.load(name)
    proved = nowhere_zero(record)
    assert proved
    region = workspace(record, resolution=12)
    found = record.inverse(region.interior(4000, np.random.default_rng(7)), record.modes.default_working or None)
    for factor in proved:
        values = found.factors[factor][np.asarray(found.exists)]
        assert len(values) > 200
        assert np.all(values > 0) or np.all(values < 0)


def test_a_locus_inside_is_never_denied():
    for name in ("zeng2019", "orthoglide", "planar_3rpr"):
        record = assur.load(name)
        there = {locus.factor for locus in workspace(record, resolution=12).loci if locus.area}
        assert there
        assert not there & nowhere_zero(record)


def test_the_region_counts_and_so_do_strokes():
    """Level links: w = 0 at z = 260 at the latest. A box above is free of it; so is what short strokes leave."""
    record = assur.load("zeng2019")
    assert "w" not in nowhere_zero(record)
    assert "w" in nowhere_zero(record, box={"z": (300, 480)})
    assert nowhere_zero(record, ["v"], box={"z": (300, 480)}) == {"v"}
    assert nowhere_zero(record, ["sin_alpha_minus_beta"]) == {"sin_alpha_minus_beta"}


@pytest.mark.parametrize("name", NAMES)
def test_a_region_with_poses_is_never_said_to_have_none(name):
    assert not nothing_reached(assur.load(name))


def test_nothing_is_reached_beyond_the_arms_and_something_just_within():
    """P of the five-bar is at most l1 + l2 = 294 from either pivot, at (-+70, 0): beyond x = 224 nothing is."""
    record = assur.load("fivebar")
    for x, there in ((223.0, True), (224.5, False)):
        box = {"x": (x, x + 100.0), "y": (-50.0, 50.0)}
        assert nothing_reached(record, box=box) is not there
        points = np.stack(np.meshgrid(np.linspace(*box["x"], 201), np.linspace(*box["y"], 101)), axis=-1).reshape(-1, 2)
        assert bool(np.any(record.inverse(points, "-+").exists)) is there
    short = {item.name: (0.0, 1e-3) for item in record.inputs}
    assert nothing_reached(record, box={"x": (-20.0, 20.0), "y": (100.0, 120.0)}, strokes=short)


def test_without_a_closed_form_nothing_is_proved():
    with pytest.raises(UsageError):
        nowhere_zero(dataclasses.replace(assur.load("fivebar"), closed_form=None))
