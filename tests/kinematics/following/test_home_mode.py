"""Home's mode is what home is followed to; another assembly at the same pose is never taken for it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.kinematics.following.following import follow
from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.kinematics.status import Status
from assur.mechanism import load
from assur.performance.indices import indices
from assur.singularity.verdict import verdict

M2 = Path(__file__).with_name("m2.toml")  # an inner loop of mirrored halves
REACHED, UNREACHED = np.array([10.0, 300.0, 0.0]), np.array([10.0, 300.0, np.radians(5)])


@pytest.fixture(scope="module")
def path():
    return str(M2)


@pytest.fixture(scope="module")
def drafted(path):
    return load(path)


def turned_over(record, joints):
    """Whether the platform's own vertical points down: the assembly that no path from home leads to."""
    rotation = frames(record, joints)[record.platform.link][0]
    return float(rotation[0, 0]) < 0


def test_where_a_path_leads_the_verdict_is_that_of_its_end(drafted):
    there = home_mode_at(drafted, REACHED)
    assert np.allclose(pose_of(drafted, there.joints), REACHED, atol=1e-6)
    assert not turned_over(drafted, there.joints)
    back = follow(drafted, there.joints, poses=pose_of(drafted, drafted.home_values))
    assert np.allclose(back.joints[-1], drafted.home_values, atol=1e-6)
    here = verdict(drafted, REACHED)
    assert (here.kind, here.home, here.home_by) == ("regular", True, "home's mode, followed straight from home")
    found = drafted.inverse(REACHED)
    own = next(k for k in np.flatnonzero(found.exists) if there.is_home(drafted, found.joints[k]))
    assert str(found.labels[own]).startswith(mode_names(drafted, drafted.home_values)[0])
    assert verdict(drafted, REACHED, str(found.labels[own])).home


def test_where_only_another_assembly_is_the_answer_it_is_unreachable(drafted):
    found = drafted.inverse(UNREACHED)
    assert (len(found), found.complete) == (8, True)
    assert all(turned_over(drafted, joints) for joints in found.joints[found.exists])
    here = verdict(drafted, UNREACHED)
    assert (here.kind, here.home) == ("unreachable", False)
    assert "how the platform is turned stays as at home" in here.home_by
    index = indices(drafted, np.stack([REACHED, UNREACHED]))
    assert index.status.tolist() == [Status.regular, Status.unreachable]
    assert np.isnan(index["condition"][1])
    named = verdict(drafted, UNREACHED, str(found.labels[found.exists][0]))
    assert (named.kind, named.home) == ("regular", False)
    assert "another assembly than that of home" in named.home_by


def test_a_mode_of_a_closed_form_is_the_one_that_following_keeps():
    """A second route: without its closed form the five-bar's indices are those of the default mode."""
    record = load("fivebar")
    bare = dataclasses.replace(record, closed_form=None)
    poses = np.array([[0.0, 200.0], [20.0, 210.0], [-30.0, 190.0]])
    for name in ("condition", "transmission"):
        assert np.allclose(indices(bare, poses)[name], indices(record, poses)[name], rtol=1e-6)


def test_a_working_mode_is_followed_through_parallel_singularities_to_what_its_closed_form_names():
    """Branches of the inverse problem do not merge there; every command answers of the same configuration."""
    record, pose = load("planar_3rrr"), [-8.3, 10.4, 1.2]
    bare = dataclasses.replace(record, closed_form=None)
    found = home_mode_at(bare, pose)
    assert (found.reached, found.through, found.stopped.kind) == (True, "parallel", "parallel")
    named = record.inverse(pose, record.modes.default_working).joints[0]
    assert np.allclose(np.exp(1j * found.joints), np.exp(1j * named), atol=1e-6)
    here = verdict(bare, pose)
    assert (here.kind, here.home) == ("regular", True)
    assert "with parallel singularities let through" in here.home_by
    assert indices(bare, pose).status == Status.regular


@pytest.mark.parametrize("command", ["indices", "singularity"])
def test_commands_say_by_what_it_is_home_and_exit_4_where_it_is_not_reached(path, command, capsys):
    assert main([command, path, "--pose", "10", "300", "0"]) == 0
    assert "home's mode, followed straight from home" in capsys.readouterr().out
    assert main([command, path, "--pose", "10", "300", "5"]) == 4
    assert "how the platform is turned stays as at home" in " ".join(capsys.readouterr().out.split())
    found = load(path).inverse(UNREACHED)
    assert main([command, path, "--pose", "10", "300", "5", f"--mode={found.labels[found.exists][0]}"]) == 0
    assert "another assembly than that of home" in capsys.readouterr().out


def test_a_path_does_not_begin_in_another_assembly(path, capsys):
    assert main(["follow", path, "--from", "10", "300", "5", "--to", "10", "300", "6"]) == 4
    assert "is not reached in home's mode" in " ".join(capsys.readouterr().out.split())
    assert main(["follow", path, "--from", "10", "300", "0", "--to", "12", "300", "0"]) == 0
