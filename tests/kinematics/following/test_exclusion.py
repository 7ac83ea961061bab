"""What proves that home's mode does not reach a place, by routes of its own: trigonometry, and the closed form."""

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.following import home_mode
from assur.kinematics.following.exclusion import of_other_signs
from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.joint_graph_solutions import JointGraphSolutions
from assur.kinematics.named_signs import named_signs
from assur.kinematics.position import inverse
from assur.kinematics.status import Status
from assur.kinematics.still import otherwise
from assur.mechanism import load
from assur.performance.indices import indices
from assur.singularity.verdict import verdict, verdict_at
from assur.work import where

SLIDER_CRANK = ["R[z] R[z]", "P[x] R[z]"]


def drafted(folder, name, chains):
    path = str(folder / f"{name}.toml")
    assert main(["new", path, "--coordinates", *(word for chain in chains for word in ("--chain", chain))]) == 0
    return path


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return drafted(tmp_path_factory.mktemp("drafts"), "crank", SLIDER_CRANK)


@pytest.fixture(scope="module")
def record(path):
    return load(path)


@pytest.fixture(scope="module")
def bare():
    """The mechanism of the paper without its closed form."""
    return dataclasses.replace(load("zeng2019"), closed_form=None)


def branch(record):
    """x of the platform along home's branch, by trigonometry: crank angles by small steps, until x turns back."""
    known = vars(record.values)
    a, b, d = (np.array([known[f"{name}_x"], known[f"{name}_y"]]) for name in "ABD")
    rod = d - b

    def x_at(angle):
        cosine, sine = np.cos(angle), np.sin(angle)
        pin = a + np.array([[cosine, -sine], [sine, cosine]]) @ (b - a)
        slider = np.array([pin[0] + np.sign(rod[0]) * np.sqrt(rod @ rod - (d[1] - pin[1]) ** 2), d[1]])
        turn = np.arctan2(*(slider - pin)[::-1]) - np.arctan2(*rod[::-1])
        return pin[0] - np.cos(turn) * b[0] + np.sin(turn) * b[1]

    ends = []
    for sense in (1, -1):
        values = np.array([x_at(sense * angle) for angle in np.arange(0.0, 3.0, 1e-3)])
        turned = int(np.argmax(np.diff(values) * np.sign(values[1] - values[0]) < 0))
        ends.append(values[turned])
    return min(ends), max(ends)


def test_one_coordinate_folds_back_where_trigonometry_says(record):
    low, high = branch(record)
    for x in (low + 0.5, 0.0, high - 0.5):
        assert home_mode_at(record, [x]).reached
    beyond = home_mode_at(record, [high + 0.5])
    assert (beyond.reached, beyond.status) == (False, Status.unreachable)
    assert "folds back at a serial singularity" in beyond.words
    there = inverse(record, [high + 0.5])
    assert there.complete
    assert beyond.others == tuple(there.labels[there.exists])
    assert len(beyond.others) == 2


def test_where_there_is_no_solution_at_all_the_words_say_so(record):
    low, _ = branch(record)
    nowhere = home_mode_at(record, [low - 0.5])
    assert nowhere.status is Status.unreachable
    assert nowhere.words.endswith("which is proved: there is no solution in any mode")


@pytest.mark.parametrize("command", ["singularity", "indices"])
def test_commands_exit_4_and_name_the_other_modes(path, record, command, capsys):
    beyond = f"{branch(record)[1] + 20:.3f}"
    assert main([command, path, "--pose", beyond]) == 4
    said = " ".join(capsys.readouterr().out.split())
    assert "home's mode does not reach it, which is proved" in said
    assert "the solutions in other modes: -, +" in said
    assert main([command, path, "--pose", beyond, "--json"]) == 4
    assert json.loads(capsys.readouterr().out)["known_modes"] == ["-", "+"]
    assert main(["follow", path, "--from", beyond, "--to", "0"]) == 4
    assert "does not reach it, which is proved" in " ".join(capsys.readouterr().out.split())


def test_signs_exclude_what_the_closed_form_says_is_not_there(bare):
    pose = [2.752, -17.475, -8.507]
    whole = load("zeng2019")
    found = home_mode_at(bare, pose)
    assert found.status is Status.unreachable
    assert "none of all 16 has its signs ++-++" in found.words
    by_formulas = inverse(whole, pose)
    assert sorted(found.others) == sorted(by_formulas.labels[by_formulas.exists])
    assert verdict(bare, pose).kind == verdict(whole, pose).kind == "unreachable"
    assert sorted(verdict(bare, pose).known_modes) == sorted(verdict(whole, pose).known_modes)
    assert indices(bare, pose).status == Status.unreachable


def test_where_the_way_meets_a_parallel_singularity_the_mode_is_still_that_of_the_closed_form(bare):
    """Home's own signs are there; branches of the inverse problem do not merge where the straight way stops."""
    pose = [-90.0, 10.0, 118.0]
    whole = load("zeng2019")
    there = inverse(bare, pose)
    assert there.complete
    assert not np.all(of_other_signs(bare, "inverse", there.joints[there.exists]))
    assert np.array_equal(named_signs(bare, "inverse", bare.home_values), [1, 1, -1, 1, 1])
    found = home_mode_at(bare, pose, detours=0, known=there)
    assert (found.through, found.stopped.kind, found.never) == ("parallel", "parallel", "")
    assert found.words == "home's mode, followed from home, with parallel singularities let through"
    by_formulas = inverse(whole, pose, "++-++").joints[0]
    assert np.allclose(np.exp(1j * found.joints[3:]), np.exp(1j * by_formulas[3:]), atol=1e-6)
    assert np.allclose(found.joints[:3], by_formulas[:3], atol=1e-6)
    assert verdict_at(bare, found.joints).kind == verdict(whole, pose, "++-++").kind == "regular"


def test_who_is_ended_among_detours_is_told_where_the_straight_path_stopped(bare, monkeypatch):
    def ended(*_):
        raise KeyboardInterrupt(where())
        yield

    monkeypatch.setattr(home_mode, "_other_ways", ended)
    with pytest.raises(KeyboardInterrupt, match=r"\(1 of 7, the straight path stopped at .* parallel singularity"):
        home_mode_at(bare, [-90.0, 10.0, 118.0])


def test_a_platform_that_home_never_turns_over_is_in_another_mode_where_it_is():
    """The proof wants all solutions: what a search met is turned over too, but may not be all."""
    turning = load(Path(__file__).with_name("m2.toml"))
    pose = np.array([10.0, 300.0, np.radians(5)])
    there = inverse(turning, pose)
    assert there.complete
    joints = there.joints[there.exists]
    assert otherwise(turning, joints) == ["how the platform is turned"] * len(joints)
    moved = inverse(turning, [10.0, 300.0, 0.0])
    upright = moved.joints[moved.exists][0]
    assert otherwise(turning, np.stack([turning.home_values, upright])) == ["", ""]
    met = dataclasses.replace(there, all_known=False)
    assert isinstance(met, JointGraphSolutions)
    assert home_mode_at(turning, pose, detours=0, known=met).status is Status.undecided
    found = home_mode_at(turning, pose, detours=0, known=there)
    assert found.status is Status.unreachable
    assert "how the platform is turned stays as at home" in found.words
