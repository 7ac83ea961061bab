"""One thickness for everything that is drawn: asked for, the companion's, or what joints leave room for."""

import dataclasses
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import MechanismFileError, UsageError
from assur.export.cad.stl import stl_files
from assur.figures.context import Context
from assur.kinematics.home import home_values
from assur.page.content import content
from assur.scene.bodies import bodies
from assur.scene.collisions import collisions
from assur.scene.companion import companion
from assur.scene.parts import model, parts
from assur.scene.shapes import Ball, Bar, Cylinder
from assur.scene.sizes import MOST, USUAL, automatic, limits, thickness, with_thickness
from assur.scene.skeleton import skeleton
from assur.view.drawing import drawing


def test_the_usual_thickness_leaves_room_between_the_joints_of_a_link(every):
    found = automatic(every.record, every.companion)
    assert 0 < found <= USUAL * every.skeleton.size * (1 + 1e-12)
    assert all(found <= limit * (1 + 1e-12) for _, limit in limits(every.skeleton))


def test_balls_that_lie_apart_do_not_overlap(every):
    """Directly of what is drawn: no two balls of one configuration share room."""
    balls = [item for item in parts(every.skeleton, every.companion) if isinstance(item.shape, Ball)]
    placed = [item.shape.moved(*every.skeleton.frames[item.link]) for item in balls]
    for one, other in combinations(placed, 2):
        apart = float(np.linalg.norm(one.centre - other.centre))
        assert apart < 1e-9 * every.skeleton.size or apart > one.radius + other.radius


def test_links_that_share_no_joint_do_not_meet_at_home_but_those_of_which_the_file_says_why(every):
    found = collisions(every.record, home_values(every.record)[None])
    meeting = {frozenset(item.links) for item in found.meeting}
    assert meeting == {frozenset(item.links) for item in every.companion.meets}


def test_what_is_asked_for_comes_first_then_the_companion(tmp_path):
    record = dataclasses.replace(assur.load("delta_4s"), folder=tmp_path)
    (tmp_path / "figures.toml").write_text('thickness = "h/50"')
    assert thickness(record) == pytest.approx(0.131 / 50)
    changed = dataclasses.replace(assur.load("delta_4s").with_parameters(h=0.1), folder=tmp_path)
    assert thickness(changed) == pytest.approx(0.1 / 50)
    assert thickness(with_thickness(record, 0.004)) == 0.004


@pytest.mark.parametrize("text", ["0", "h - 1", "nothing"])
def test_a_thickness_of_the_companion_that_is_none_is_a_fault_of_the_file(tmp_path, text):
    record = dataclasses.replace(assur.load("delta_4s"), folder=tmp_path)
    (tmp_path / "figures.toml").write_text(f'thickness = "{text}"')
    with pytest.raises(MechanismFileError, match=r"figures\.toml:1: thickness"):
        companion(record)


def test_the_docs_say_how_thick_the_delta_robot_is():
    text = (Path(__file__).parents[2] / "docs" / "export.md").read_text(encoding="utf-8")
    assert f"{1e3 * thickness(assur.load('delta_4s')):.1f} mm in the Delta robot" in " ".join(text.split())


def test_other_dimensions_keep_it():
    record = with_thickness(assur.load("fivebar"), 3.0)
    assert record.with_parameters(l1=110).thickness == 3.0


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf, 1e6])
def test_one_that_is_none_is_refused_with_what_it_is_if_left_out(value):
    with pytest.raises(UsageError, match=r"fivebar: a thickness of .* mm; it must be above 0 and at most") as caught:
        with_thickness(assur.load("fivebar"), value)
    assert "left out it is" in caught.value.hint


def test_the_largest_one_is_drawn(every):
    largest = MOST * every.skeleton.size
    thick = with_thickness(every.record, largest)
    mesh = model(skeleton(thick, every.companion, home_values(thick)))
    assert np.all(np.isfinite(mesh.corners))


def test_figures_page_view_and_prototypes_draw_the_same_one():
    """A bar that is drawn three times as thick is so everywhere."""
    thin = with_thickness(assur.load("fivebar"), 2.0)
    thick = with_thickness(thin, 6.0)
    for record, wanted in ((thin, 2.0), (thick, 6.0)):
        names = companion(record)
        drawn = {item.name: item.shape for item in parts(Context(record).skeleton, names)}
        assert isinstance(drawn["bar A1 B1"], Bar)
        assert drawn["bar A1 B1"].thickness == pytest.approx(wanted)
        assert isinstance(drawn["B1 pin"], Cylinder)
        assert drawn["B1 pin"].radius == pytest.approx(0.7 * wanted)
        page = next(item for item in content(record, ())["parts"] if item["name"] == "bar A1 B1")
        assert page["shape"]["thickness"] == pytest.approx(wanted)
        body = next(item for item in bodies(record) if item.link == "crank1")
        assert body.fused[0].shape.thickness == pytest.approx(wanted)
    tall = [
        np.ptp(
            np.concatenate([item.vertices for item in drawing(r, home_values(r)).solids if item.link == "crank2"])[:, 2]
        )
        for r in (thin, thick)
    ]
    assert tall[1] == pytest.approx(3 * tall[0], rel=1e-6)
    assert stl_files(thin)["crank1.stl"] != stl_files(thick)["crank1.stl"]
