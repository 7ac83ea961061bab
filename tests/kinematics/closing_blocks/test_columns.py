"""Screws of all joints seen from any link, and which assemblies are looked at."""

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance, open_freedoms
from assur.kinematics.closure import CLOSED, closure_error
from assur.model.registry import load_record


@pytest.mark.parametrize("name", ["zeng2019", "gough_stewart", "three_rps"])
def test_the_assemblies_close(name):
    record = load_record(name)
    assert np.max(closure_error(record, assemblies_by_chance(record))) < CLOSED * characteristic_length(record)


def test_what_stands_still_about_home_stands_in_all_of_them():
    record = load_record("delta_4s")
    rotation, _ = frames(record, assemblies_by_chance(record))[record.platform.link]
    assert np.allclose(rotation, np.eye(3), atol=1e-6)


@pytest.mark.parametrize("name", ["zeng2019", "gough_stewart", "three_rps"])
def test_motions_keep_the_loops_closed_seen_from_any_link(name):
    record = load_record(name)
    screws = ScrewColumns(record, assemblies_by_chance(record)[:5])
    graph = joint_graph(record)
    owners = [item.joint for item in record.coordinates]
    for link in (record.base, record.platform.link):
        columns = screws.seen_from(link)[:, :, : len(owners)]
        for cut, loop in zip(graph.cut, graph.loops, strict=True):
            senses = [{cut.name: 1, **loop}.get(name, 0) for name in owners]
            assert np.max(np.abs((columns * senses) @ screws.motions[:, : len(owners)])) < 1e-7


def test_what_a_pose_leaves_free_moves_as_the_platform_does():
    """A five-bar's pose is a point: how fast the platform turns meanwhile, against differences of its rotation."""
    record = load_record("fivebar")
    values, step = assemblies_by_chance(record)[1:6], 1e-6
    motions, count = ScrewColumns(record, values).motions, len(record.coordinates)
    for k in range(motions.shape[2]):
        way = step * motions[:, :count, k]
        before, after = (frames(record, own)[record.platform.link][0] for own in (values - way, values + way))
        turning = (after @ np.swapaxes(before, -1, -2))[:, 1, 0] / (2 * step)
        up, about_x, about_y, about_z = motions[:, count:, k].T
        assert about_z == pytest.approx(turning, abs=1e-8)
        assert np.max(np.abs([up, about_x, about_y])) < 1e-12


def test_what_limbs_hold_is_not_open():
    assert open_freedoms(load_record("zeng2019")) == ()
    assert open_freedoms(load_record("three_rps")) == ("x", "y", "phi")
    assert open_freedoms(load_record("gough_stewart")) == ()
