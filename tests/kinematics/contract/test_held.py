"""Claims that only the full check looks at: curves, groups of factors, systems; and what the three checks look at."""

import itertools

import pytest

from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import AT_LOAD, EXTENTS, IN_FULL
from assur.kinematics.contract.held import at_other_dimensions, at_places
from assur.model.registry import load_record

WRONG = {
    "a curve of self-motion": ("zeng2019", ("u1 = p.l2 * cos_gamma", "u1 = 0.9 * p.l2 * cos_gamma"), "self-motion"),
    "a curve that is not there": ("zeng2019", ("- y_a3\n    v_squared = p.l6", "- y_a3\n    v_squared = p.l8"), "self"),
    "poses of a curve": ("fivebar", ("pose = (x1 + p.l2 * rod[0]", "pose = (x1 + p.l1 * rod[0]"), "self-motion"),
    "a direct problem that moves everywhere": (
        "zeng2019", ("y, -big_b / 2, big_b / 2", "y, big_b / 2, big_b / 2"), ""),
    "a constraint singularity that is not named": (
        "zeng2019", ('singular=(("v",), ("sin_beta",), ', 'singular=(("sin_beta",), '), "factor v"),
    "one that is none": (
        "zeng2019", ('constraint_singular=(("v",), ', 'constraint_singular=(("w",), ("v",), '), "status w"),
    "a system that poses do not solve": (
        "gough_stewart", ("+ 2 * dot(b, on_platform)", "+ dot(b, on_platform)"), "branch"),
    "unknowns that do not come back": (
        "gough_stewart", ("moved = subtract(subtract(", "moved = subtract(add("), "branch"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_claim_is_refused(copied, what):
    name, change, told = WRONG[what]
    found, _ = problems(load_record(copied(name, change)), IN_FULL)
    assert found
    assert found[0].path.startswith(told)
    assert found[0].line


def test_a_wider_check_looks_at_more():
    for less, more in itertools.pairwise(EXTENTS):
        assert all(getattr(less, name) <= getattr(more, name) for name in vars(less) if name != "name")


def test_the_same_places_are_drawn_each_time(copied):
    record = load_record(copied("biglide", ("arm1 = sign.s1 *", "arm1 = -sign.s1 *")))
    assert at_places(record, AT_LOAD) == at_places(record, AT_LOAD)
    assert at_places(record, AT_LOAD) != []


def test_a_linkage_of_special_dimensions_has_no_others(copied):
    """A rail that lies in the plane of the linkage only where both rods are equally long."""
    record = load_record(copied("zeng2019"))
    assert at_other_dimensions(record, AT_LOAD) == ([], True)
    folder = copied("biglide")
    path = folder / "mechanism.toml"
    text = path.read_text(encoding="utf-8").replace(
        'S2 = { type = "prismatic", parent = "base", child = "slider2", axis = "x" }',
        'S2 = { type = "prismatic", parent = "base", child = "slider2", axis = ["1", "0", "r1 - r2"] }',
    )
    path.write_text(text, encoding="utf-8")
    assert at_other_dimensions(load_record(folder), AT_LOAD) == ([], False)
