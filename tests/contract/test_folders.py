"""Laws of a mechanism's folder: it is complete, and the page of the catalogue says what it claims."""

import re
from pathlib import Path

import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.validation.check import doubts, faults
from assur.model.closed_form import Eliminant

ROOT = Path(__file__).parents[2]
CATALOGUE = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
FOLDERS = ROOT / "src" / "assur" / "mechanisms"


def test_a_folder_has_all_that_a_mechanism_needs(mechanism):
    folder = FOLDERS / mechanism.name
    assert {"mechanism.toml", "closed_form.py", "figures.toml", "reference"} <= {path.name for path in folder.iterdir()}
    assert list((folder / "reference").glob("*.toml"))
    assert mechanism.source


def test_a_mechanism_is_sound(mechanism):
    assert faults(mechanism) == ()
    assert doubts(mechanism) == ()


def test_every_pose_coordinate_has_an_interval_in_the_box(mechanism):
    assert set(mechanism.platform.pose) <= set(mechanism.box)


def test_what_a_reduced_model_leaves_out_is_said(mechanism):
    form = mechanism.closed_form
    assert bool(form.reduced_because) == (form.complete_for == "reduced")


def rows():
    """The table of mechanisms: name -> its other cells."""
    lines = [line.strip().strip("|") for line in CATALOGUE.splitlines() if line.startswith("| `")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)] for line in lines]
    return {row[0].strip("`"): row[1:] for row in cells if len(row) == 5}


def direct_problem(mechanism):
    """How the direct problem is solved, in the words of the catalogue."""
    kernel = mechanism.closed_form.direct
    if kernel is None:
        return "loops in turn" if at_home(mechanism).complete else "a search on the joint graph"
    if callable(kernel):
        return f"closed form, {2 ** len(mechanism.modes.assembly)} branches"
    if isinstance(kernel, Eliminant):
        one = f"polynomial of degree {kernel.roots}"
        return f"a {one} for each of {2 ** len(kernel.signs)} choices of sign" if kernel.signs else f"one {one}"
    return f"a homotopy, {kernel.degree} complex solutions"


def at_home(mechanism):
    return mechanism.direct(inputs_of(mechanism, home_values(mechanism)))


def test_the_catalogue_says_what_the_closed_form_claims(mechanism):
    form = mechanism.closed_form
    model = form.complete_for if form.direct else at_home(mechanism).complete_for
    *said, whole = rows()[mechanism.name][:3]
    assert said == [mechanism.title, direct_problem(mechanism)]
    more = (
        {"joint graph"} if mechanism.file.parent != FOLDERS / mechanism.name else set()
    )  # derived forms leave out less
    assert model.replace("_", " ") in {whole, *more}


def test_the_catalogue_has_no_other_mechanism():
    assert rows().keys() == set(assur.names())


POSES = {
    "three spheres": (
        2,
        ["delta_4s", "linear_delta_4s", "linear_delta_4r", "three_p2us", "orthoglide", "tsai_platform"],
    ),
    "three spheres, legs": (2, ["three_upu"]),
    "linear": (1, ["tripteron", "three_crr"]),
    "three cylinders": (8, ["three_rrc"]),
    "H4": (8, ["h4_robot"]),
    "3-RPS": (16, ["three_rps"]),
    "planar": (6, ["planar_3rrr", "planar_3rpr"]),
    "five-bar": (2, ["fivebar"]),
    "Gough-Stewart": (40, ["gough_stewart"]),
}
"""How many poses the literature knows at given inputs, over complex numbers."""


@pytest.mark.parametrize(("count", "name"), [(count, name) for count, names in POSES.values() for name in names])
def test_there_are_as_many_poses_as_the_literature_says(count, name):
    """Where passive knees make further branches of one pose, only poses are counted."""
    mechanism = assur.load(name)
    kernel = mechanism.closed_form.direct
    branches = 2 ** len(mechanism.modes.assembly) if callable(kernel) else kernel.degree
    knees = {*map(str, mechanism.modes.working.values())} & {*map(str, mechanism.modes.assembly.values())}
    assert branches // 2 ** len(knees) == count
