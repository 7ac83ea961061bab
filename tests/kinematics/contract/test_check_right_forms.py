"""Right closed forms pass, whoever wrote them: the built-in ones as anyone's folder, with other dimensions too."""

from __future__ import annotations

import pytest

import assur
from assur.kinematics.contract.check import problems
from assur.model.registry import load_record


@pytest.mark.parametrize("name", [*assur.names(), "biglide"])
def test_a_right_form_passes_with_any_dimensions(copied, name):
    assert problems(load_record(copied(name))) == ((), True)


def test_a_form_for_special_dimensions_passes_with_these(copied):
    """With both rods equally long, and both written as r1: the form of a mechanism that has r1 alone."""
    folder = copied("biglide", ("p.r2", "p.r1"), ('"r2*r2"', '"r1*r1"'), ('"r2"', '"r1"'))
    path = folder / "mechanism.toml"
    text = path.read_text(encoding="utf-8").replace('"r2"', '"r1"')
    path.write_text("".join(line for line in text.splitlines(True) if not line.startswith("r2")), encoding="utf-8")
    assert problems(load_record(folder)) == ((), True)
