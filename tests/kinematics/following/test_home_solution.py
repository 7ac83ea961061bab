"""Which solution is marked as home's: by signs, by following, and where that is not decided."""

import dataclasses
import json

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.geometry import joint_scales
from assur.kinematics.answers.answer import answer
from assur.kinematics.border import inputs_of
from assur.kinematics.following.following import follow
from assur.kinematics.following.home_solution import home_solution
from assur.kinematics.position import direct, inverse
from assur.mechanism import load

CHAINS = ("R[z] R[z]", "P[x] R[z]")


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A slider-crank, whose modes have no names."""
    path = str(tmp_path_factory.mktemp("drafts") / "crank.toml")
    assert main(["new", path, *(word for chain in CHAINS for word in ("--chain", chain))]) == 0
    return path


def test_solutions_are_marked_by_following(path):
    record = load(path)
    found = inverse(record, [100.0])
    home = home_solution(found)
    end = follow(record, record.home_values, poses=[100.0]).joints[-1]
    apart = np.max(np.abs(np.sin((found.joints[found.exists] - end) / 2)), axis=1)
    assert len(home.marks) == 4
    assert list(home.marks) == (apart < 1e-6).tolist()
    label = found.labels[found.exists][home.marks.index(True)]
    assert home.words == f"home: mode {label}, followed straight from home"


def test_where_home_folds_back_no_solution_is_marked(path):
    record = load(path)
    beyond = home_solution(inverse(record, [240.0]))
    assert beyond.marks == (False, False)
    assert beyond.words.startswith("home: none of these, which is proved")


def test_home_is_followed_through_singularities_at_which_its_assemblies_do_not_merge(path):
    """The crank passes a serial singularity on the way; its assemblies in small steps say which is home's, too."""
    record = load(path)
    end = np.radians(120.0)
    behind = home_solution(direct(record, [end]))
    assert behind.words == "home: mode +, followed from home, with serial singularities let through"
    followed, scales = record.home_values, joint_scales(record)
    for angle in np.linspace(inputs_of(record, followed)[0], end, 300):
        joints = direct(record, [angle]).joints
        followed = joints[np.argmin(np.max(np.abs((joints - followed) / scales), axis=1))]
    last = direct(record, [end])
    assert list(behind.marks) == [bool(np.allclose(row, followed)) for row in last.joints[last.exists]]


def test_signs_and_following_mark_the_same_solution():
    """With a closed form by signs, without it by following."""
    record = load("fivebar")
    bare = dataclasses.replace(record, closed_form=None)
    for pose in ([0.0, 200.0], [30.0, 220.0]):
        by_signs, followed = (inverse(item, pose) for item in (record, bare))
        first, second = home_solution(by_signs), home_solution(followed)
        assert first.words.endswith("by its signs")
        assert second.words.endswith("followed straight from home")
        rows = [
            found.inputs[found.exists][home.marks.index(True)]
            for found, home in ((by_signs, first), (followed, second))
        ]
        assert np.allclose(*rows, atol=1e-9)


def test_roots_that_share_signs_are_told_apart_by_following():
    record = load("planar_3rpr")
    found = direct(record, [300.0, 300.0, 300.0])
    home = home_solution(found)
    labels = found.labels[found.exists]
    assert sorted(labels) == ["+a", "+b", "-a", "-b"]
    assert [str(label) for label, mark in zip(labels, home.marks, strict=True) if mark] == ["+a"]


def test_another_mode_alone_is_not_home():
    found = direct(load("zeng2019"), [162.6907, -143.3209, -24.6776], "++-")
    assert home_solution(found).marks == (False,)
    assert home_solution(found).words == "home: none of these, by their signs"
    data = answer(direct(load("zeng2019"), [162.6907, -143.3209, -24.6776]))
    assert [item.home for item in data.solutions] == [True, False, False, False]
    nothing = home_solution(direct(load("zeng2019"), [900.0, -143.3209, -24.6776]))
    assert (nothing.marks, nothing.words) == ((), "")


def test_commands_mark_it_in_text_and_in_json(path, capsys):
    assert main(["inverse", path, "100"]) == 0
    lines = capsys.readouterr().out.splitlines()
    titles, rows = lines[3], lines[5:9]
    assert titles.split()[:5] == ["mode", "q1", "[deg]", "assembly", "home"]
    assert [" yes " in row for row in rows].count(True) == 1
    assert any(line.endswith("followed straight from home") for line in lines)
    assert main(["inverse", path, "100", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert [item["home"] for item in data["solutions"]].count(True) == 1
    assert data["home_by"].endswith("followed straight from home")
