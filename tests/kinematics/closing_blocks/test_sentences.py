"""What a + means is true at home, in the letters of the joints."""

from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.points import point
from assur.kinematics.home import home_values
from assur.kinematics.naming import sign_meanings
from assur.mechanism import load
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
    name, meaning = next(iter(sign_meanings(drafted, "direct").items()))
    assert f"mode: the signs of {name}" in said
    assert f"{name} is +: {meaning}" in said
