"""Modes bear the file's names where it has them, else those of closing blocks."""

import dataclasses
import re

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.errors import UnknownNameError
from assur.kinematics.home import home_values
from assur.kinematics.modes import is_of_mode, lettered, without_letter
from assur.kinematics.named_signs import named_signs
from assur.kinematics.naming import described_signs, mode_names, sign_meanings, signs_at
from assur.kinematics.position import direct, inverse
from assur.model.mechanism import Modes
from assur.model.registry import load_record


@pytest.fixture(scope="module")
def nameless():
    record = load_record("planar_3rrr")
    return dataclasses.replace(record, closed_form=None, modes=Modes())


def test_a_files_names_override(nameless):
    record = load_record("planar_3rrr")
    home = home_values(record)[None]
    assert np.array_equal(signs_at(record, "inverse", home), named_signs(record, "inverse", home))
    assert list(sign_meanings(record, "inverse")) == list(record.modes.working)
    assert list(sign_meanings(nameless, "inverse")) == ["leg1", "leg2", "leg3"]


def test_names_of_closing_blocks_agree_with_those_that_were_written_but_for_the_sign_at_home(nameless):
    """The elbows of three limbs: written as quantities of the file, and found in the joint graph."""
    record = load_record("planar_3rrr")
    solutions = inverse(nameless, [0.1, 0.05, 0.05])
    joints = solutions.joints[solutions.exists]
    written = named_signs(record, "inverse", joints) * named_signs(record, "inverse", home_values(record))
    assert np.array_equal(signs_at(nameless, "inverse", joints), written)


def test_home_is_plus(nameless):
    assert mode_names(nameless, home_values(nameless)) == ("+++", "+")


def test_a_mode_can_be_asked_by_its_name_and_a_number_names_none(nameless):
    every = inverse(nameless, [0.1, 0.05, 0.05])
    one = inverse(nameless, [0.1, 0.05, 0.05], "+-+")
    assert [solution.mode for solution in one] == ["+-+"]
    assert {"+-+"} < {str(label) for label in every.labels[every.exists]}
    with pytest.raises(UnknownNameError) as told:
        inverse(nameless, [0.1, 0.05, 0.05], "3")
    assert "one sign + or - for each of: leg1, leg2, leg3" in told.value.hint


def test_a_mode_without_letter_means_all_that_share_its_signs(nameless):
    found = direct(load_record("planar_3rpr"), [300.0, 300.0, 300.0], "+")
    assert [solution.mode for solution in found] == ["+a", "+b"]


def test_letters_go_on_after_z():
    labels = lettered(np.array(["+"] * 30), np.ones(30, dtype=bool))
    assert list(labels[[0, 25, 26, 29]]) == ["+a", "+z", "+aa", "+ad"]
    assert without_letter("+ad~Pa1") == "+~Pa1"
    assert is_of_mode(labels, "+").all()


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_a_mode_that_is_given_by_a_number_is_refused_with_its_name(problem):
    """Numbers counted solutions from the nearest to home on, of all or of those that share signs."""
    record = load_record("planar_3rpr")
    given = [300.0, 300.0, 300.0] if problem == "direct" else [10.0, 20.0, 0.1]
    solve = direct if problem == "direct" else inverse
    solutions = solve(record, given, method="search")
    labels = [str(label) for label in solutions.labels[solutions.exists]]
    for number, label in enumerate(labels, 1):
        with pytest.raises(UnknownNameError, match=rf"number {number} is now {re.escape(label)}$"):
            solve(record, given, str(number), method="search")
    alike = [label for label in labels if label.startswith("-")]
    assert len(alike) > 1
    for number, label in enumerate(alike, 1):
        with pytest.raises(UnknownNameError, match=rf"number -/{number} is now {re.escape(label)}$"):
            solve(record, given, f"-/{number}", method="search")
    with pytest.raises(UnknownNameError, match="of 99 there is none"):
        solve(record, given, "99", method="search")
    with pytest.raises(UnknownNameError, match="a number is no name: at home"):
        solve(record, [given, given], "3", method="search")


def test_letters_of_signs_are_no_names_of_the_file(nameless):
    """An offset e1, as drafts have, leaves e1 to itself."""
    free = [sign.letter for sign in described_signs(nameless, "direct")]
    own = nameless.parameters["l1"] if "l1" in nameless.parameters else next(iter(nameless.parameters.values()))
    other = dataclasses.replace(nameless, parameters={**nameless.parameters, "e1": own})
    assert free == ["e1"]
    assert [sign.letter for sign in described_signs(other, "direct")] == ["epsilon1"]
    assert [sign.letter for sign in described_signs(other, "inverse")] == ["s1", "s2", "s3"]


def test_a_quantity_of_the_file_names_itself_and_the_joints_that_it_reads():
    (first, *_) = described_signs(load_record("zeng2019"), "direct")
    assert (first.letter, first.written, first.places) == ("e1", True, ("B1", "C1"))


def test_a_solution_in_which_the_platform_is_turned_says_so(tmp_path):
    """Tsai's 3-UPU translates at home; of its sixteen assemblies at nearly equal legs two are in that mode."""
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "3-UPU", "tangential"]) == 0
    mechanism = assur.load(path)
    legs = np.array([320.0, 317.0, 318.0])
    solutions = list(mechanism.direct(legs))
    turns = [from_home(mechanism, own.joints) for own in solutions]
    assert [own.mode.endswith("~turned") for own in solutions] == [turn > 0.1 for turn in turns]
    assert sorted(own.mode for own, turn in zip(solutions, turns, strict=True) if turn < 1e-6) == ["+", "-"]
    assert len({own.mode for own in solutions}) == len(solutions) == 16
    for own in solutions:
        (asked,) = mechanism.direct(legs, mode=own.mode)
        np.testing.assert_allclose(asked.pose, own.pose, rtol=0, atol=1e-6)


def from_home(mechanism, joints):
    """By how much the platform is turned from home, as a distance of matrices."""
    first, second = (mechanism.frames(values)["platform"][0] for values in (mechanism.home_values, joints))
    return np.linalg.norm(second - first)
