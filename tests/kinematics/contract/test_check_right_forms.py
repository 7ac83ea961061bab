"""Right closed forms pass, whoever wrote them: the built-in ones as anyone's folder, with other dimensions too."""

import numpy as np
import pytest

import assur
from assur.export.c99 import c99_text
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import DEEP, IN_FULL
from assur.model.registry import load_record
from assur.singularity.distance import distance
from catalogue import REPRESENTATIVES, each

RAILS = "linear_delta_4s"
"""Divides by a formula of its dimensions that is zero for some: each choice of them is a question of its own."""


@pytest.mark.parametrize("name", [*each(quick=(*REPRESENTATIVES, RAILS)), "biglide"])
def test_a_right_form_passes_with_any_dimensions(copied, name):
    assert problems(load_record(copied(name))) == ((), name != RAILS)


@pytest.mark.parametrize("name", ["fivebar", "biglide", "gantry"])
def test_a_right_form_passes_in_full(copied, name):
    assert problems(load_record(copied(name)), IN_FULL) == ((), True)


def test_a_form_without_margins_and_factors_answers_every_question(copied):
    """Slides that cross: nothing merges, nothing is singular, and det Jp and det Jq are products of nothing."""
    record, poses = assur.load(copied("gantry")), np.array([[3.0, 4.0], [5.0, 6.0], [7.0, 8.0]])
    for solutions in (record.inverse(poses), record.direct(poses)):
        assert (solutions.exists.shape, solutions.status.tolist()) == ((3, 1), [[0]] * 3)
        assert solutions.inputs[:, 0].tolist() == solutions.poses[:, 0].tolist() == poses.tolist()
    verdict = record.singularity(poses[0])
    assert (verdict.kind, verdict.closest, verdict.det_jp, verdict.condition) == ("regular", "", 1.0, 1.0)
    assert np.isinf(distance(record, poses).value).all()
    for proved in (certified_inverse(record, poses[0]), certified_direct(record, poses[0])):
        assert (len(proved.solutions), proved.undecided) == (1, ())
    assert "GANTRY_DIRECT_MAX 1" in c99_text(record)


@pytest.mark.deep
@pytest.mark.parametrize("name", assur.names())
@pytest.mark.parametrize("extent", [IN_FULL, DEEP], ids=["full", "deep"])
def test_every_right_form_passes_every_check(copied, name, extent):
    assert problems(load_record(copied(name)), extent) == ((), name != RAILS)


@pytest.mark.deep
@pytest.mark.parametrize("name", assur.names())
@pytest.mark.parametrize("seed", range(20))
def test_a_right_form_passes_at_other_places(copied, name, seed):
    from assur.kinematics.contract.extent import AT_LOAD
    from assur.kinematics.contract.held import at_other_dimensions, at_places

    record = load_record(copied(name))
    assert at_places(record, AT_LOAD, seed) == []
    assert at_other_dimensions(record, AT_LOAD, seed)[0] == []


def test_a_form_for_special_dimensions_passes_with_these(copied):
    """With both rods equally long, and both written as r1: the form of a mechanism that has r1 alone."""
    folder = copied("biglide", ("p.r2", "p.r1"), ('"r2*r2"', '"r1*r1"'), ('"r2"', '"r1"'))
    path = folder / "mechanism.toml"
    text = path.read_text(encoding="utf-8").replace('"r2"', '"r1"')
    path.write_text("".join(line for line in text.splitlines(True) if not line.startswith("r2")), encoding="utf-8")
    assert problems(load_record(folder)) == ((), True)
