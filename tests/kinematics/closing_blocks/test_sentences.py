"""What a + means is true at home, in the letters of the joints."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.joint_graph.points import point
from assur.kinematics.closing_blocks.columns import assemblies_by_chance
from assur.kinematics.home import home_values
from assur.kinematics.naming import described_signs, sign_meanings, signs_at
from assur.mechanism import load
from assur.model.mechanism import Modes
from assur.model.registry import load_record


@pytest.fixture(scope="module")
def drafted(tmp_path_factory):
    """Two limbs of hinges and slides, without names of the direct problem's modes."""
    path = tmp_path_factory.mktemp("drafts") / "m2.toml"
    assert main(["new", str(path), "--chain", "P[y] R[x] R[x]", "--chain", "P[y] R[x] R[x]"]) == 0
    return load(str(path))


def test_a_dyad_says_on_which_side_its_middle_joint_lies(drafted):
    (meaning,) = sign_meanings(drafted, "direct").values()
    middle, first, last = meaning.split(" ")[0], meaning.split(" ")[-3], meaning.split(" ")[-1]
    a, b, c = (point(drafted, name, home_values(drafted)) for name in (first, middle, last))
    axis = drafted.joints[first].axes[0]  # of the first, seen from where it points to
    assert meaning == f"{middle} lies on the {'left' if np.cross(c - a, b - a) @ axis > 0 else 'right'} of " \
        f"the line from {first} to {last}"  # fmt: skip


def test_a_stroke_says_which_end_lies_ahead():
    meanings = list(sign_meanings(load_record("gough_stewart"), "inverse").values())
    assert len(meanings) == 6
    assert all(" lies ahead of " in text or " > 0" in text for text in meanings)


def test_every_sign_has_a_name_of_its_own_and_a_sentence(drafted):
    for name in ("gough_stewart", "planar_3rpr", "three_rps"):
        for problem in ("direct", "inverse"):
            meanings = sign_meanings(load_record(name), problem)
            assert all(text for text in meanings.values())
    assert Path(drafted.file).name == "m2.toml"


def test_answers_print_what_a_plus_means(drafted, capsys):
    assert main(["direct", str(drafted.file), "0", "10", "0"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    (sign,) = described_signs(drafted, "direct")
    assert f"mode: the signs of {sign.name}" in said
    assert f"{sign.name} ({sign.letter}) is +: {sign.meaning}" in said


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_what_is_said_of_dyads_holds_of_every_assembly_by_its_sign(drafted, problem):
    """The words are about places of joints, the signs about determinants of screws."""
    nameless = dataclasses.replace(drafted, modes=Modes())
    assert held_by_every_assembly(nameless, problem) == {"direct": 1, "inverse": 2}[problem]


@pytest.mark.parametrize("arrangement", [["3-RPS"], pytest.param(["6-RUS"], marks=pytest.mark.deep)])
def test_what_is_said_of_a_limb_in_space_holds_of_every_assembly_by_its_sign(arrangement, tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), *arrangement]) == 0
    mine = load(str(path))
    assert held_by_every_assembly(dataclasses.replace(mine, modes=Modes()), "inverse") == int(arrangement[0][0])


def held_by_every_assembly(nameless, problem):
    """How many sentences about places there are, each of which is true where its sign is +, false where it is -."""
    values = assemblies_by_chance(nameless)
    signs = signs_at(nameless, problem, values)
    meanings = list(sign_meanings(nameless, problem).values())
    about_places = [meaning for meaning in meanings if " lies " in meaning]
    for meaning, own in zip(meanings, signs.T, strict=True):
        if meaning not in about_places:
            continue
        words = meaning.partition(",")[0].split(" ")
        if " along " in meaning:
            middle, first, slide = words[0], words[-3], words[-1]
            along = frames(nameless, values)[nameless.joints[slide].parent][0] @ nameless.joints[slide].axes[0]
            across = point(nameless, middle, values) - point(nameless, first, values)
            side = np.einsum("ni,ni->n", across, np.broadcast_to(along, across.shape))
            positive = "ahead of" in meaning
        else:
            middle, first, last = words[0], words[-3], words[-1]
            a, b, c = (point(nameless, name, values) for name in (first, middle, last))
            axis = frames(nameless, values)[nameless.joints[first].parent][0] @ nameless.joints[first].axes[0]
            side = np.einsum("ni,ni->n", np.cross(c - a, b - a), np.broadcast_to(axis, a.shape))
            positive = " left " in meaning
        clear = np.abs(side) > 1e-3
        assert np.array_equal(own[clear] > 0, (side > 0)[clear] == positive)
    return len(about_places)


def test_a_draft_says_what_the_signs_mean_that_it_does_not_name(drafted):
    text = Path(drafted.file).read_text(encoding="utf-8")
    for problem, name in (("inverse", "working mode"), ("direct", "assembly mode")):
        if not (drafted.modes.working if problem == "inverse" else drafted.modes.assembly):
            for sign in described_signs(drafted, problem):
                assert f"#     {name}, {sign.name} ({sign.letter}): {sign.meaning}" in text
