"""Letters of signs: at the joints that they are about, clear of other labels, and said in captions."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.figures.catalogue import drawing, spec
from assur.figures.context import Context
from assur.figures.letters import letter
from assur.figures.mode_letters import shown_signs
from assur.kinematics.naming import described_signs
from assur.mechanism import load

OWN = ("3-RPS", "6-RUS")


@pytest.fixture(scope="module", params=OWN)
def drafted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("letters") / "own.toml"
    assert main(["new", str(path), request.param]) == 0
    return Context(load(str(path)))


@pytest.fixture(scope="module")
def texts(drafted):
    """Text -> frame (left, bottom, right, top) in pixels of every framed letter, and the boxes of all other labels."""
    figure = drawing(drafted.record, "model", drafted).figure
    figure.canvas.draw()
    shown = [text for text in figure.axes[0].texts if text.get_text()]
    boxes = [(text, (text.get_bbox_patch() or text).get_window_extent().extents) for text in shown]
    framed = {text.get_text(): box for text, box in boxes if text.get_bbox_patch() is not None}
    return framed, [box for text, box in boxes if text.get_bbox_patch() is None]


def test_every_sign_has_its_letter_in_the_model_once(drafted, texts):
    signs = [sign for problem in ("inverse", "direct") for sign in described_signs(drafted.record, problem)]
    letters = [sign.letter for sign in signs]
    assert len({*letters}) == len(letters) > 3
    assert {*texts[0]} == {letter(name) for name in letters}


def test_no_letter_of_a_sign_covers_another_label(texts):
    framed, others = texts
    every = [*framed.values(), *others]
    for box in framed.values():
        shared = [np.minimum(box[2:], rest[2:]) - np.maximum(box[:2], rest[:2]) for rest in every if rest is not box]
        assert not any(np.all(sides > 0) for sides in shared)


def test_the_letter_of_a_limb_bears_its_colour(drafted):
    """So that of two limbs that cross on paper it is clear which one is meant."""
    figure = drawing(drafted.record, "model", drafted).figure
    colours = {text.get_text(): text.get_color() for text in figure.axes[0].texts if text.get_bbox_patch()}
    for problem in ("inverse", "direct"):
        for sign in described_signs(drafted.record, problem):
            limbs = {name.rpartition(".")[0] for name in sign.places}
            own = [other for other in colours.values() if other == colours[letter(sign.letter)]]
            assert len(own) == 1 if len(limbs) == 1 else colours[letter(sign.letter)] == "#1a1a1a"


def test_a_loop_through_two_limbs_bears_no_limbs_colour(tmp_path):
    """The coupler of a four-bar closes over a joint between base and platform, which is no part of its crank's limb."""
    path = tmp_path / "own.toml"
    assert main(["new", str(path), "four-bar"]) == 0
    record = load(str(path))
    (sign,) = described_signs(record, "direct")
    texts = {text.get_text(): text for text in drawing(record, "model").figure.axes[0].texts}
    assert texts[letter(sign.letter)].get_color() == "#1a1a1a"


def test_captions_say_what_each_plus_means(drafted):
    model, solutions = (spec(drafted.record, name, drafted).caption for name in ("model", "solutions"))
    for problem in ("inverse", "direct"):
        for sign in described_signs(drafted.record, problem):
            assert f"{letter(sign.letter)} is + where " in model
            assert (f"{letter(sign.letter)} is + where " in solutions) == (problem == "direct")
    assert "leg1." not in model
    assert "leg1." not in solutions


def test_the_table_of_solutions_names_the_signs_of_its_modes(drafted):
    figure = drawing(drafted.record, "solutions", drafted).figure
    letters = ", ".join(letter(sign.letter) for sign in described_signs(drafted.record, "direct"))
    assert f"mode ({letters})" in [text.get_text() for text in figure.axes[0].texts]


def test_quantities_of_a_closed_form_bear_no_letters():
    assert shown_signs(load("zeng2019")) == ()
    assert [sign.letter for sign in shown_signs(load("planar_3rpr"))] == ["s1", "s2", "s3"]


def test_quantities_of_a_file_without_closed_form_stand_at_their_joints(tmp_path):
    path = tmp_path / "own.toml"
    assert main(["new", str(path), "3-RRR", "planar"]) == 0
    found = drawing(load(str(path)), "model").data["signs"]
    assert found["k1"] == ("leg1.A", "leg1.B", "leg1.C")
