"""Right closed forms pass, whoever wrote them: the built-in ones as anyone's folder, with other dimensions too."""

import pytest

import assur
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import DEEP, IN_FULL
from assur.model.registry import load_record
from catalogue import REPRESENTATIVES, each

RAILS = "linear_delta_4s"
"""Divides by a formula of its dimensions that is zero for some: each choice of them is a question of its own."""


@pytest.mark.parametrize("name", [*each(quick=(*REPRESENTATIVES, RAILS)), "biglide"])
def test_a_right_form_passes_with_any_dimensions(copied, name):
    assert problems(load_record(copied(name))) == ((), name != RAILS)


@pytest.mark.parametrize("name", ["fivebar", "biglide"])
def test_a_right_form_passes_in_full(copied, name):
    assert problems(load_record(copied(name)), IN_FULL) == ((), True)


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
