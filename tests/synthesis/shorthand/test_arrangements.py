"""Standard arrangements: their facts are derived anew, their drives determine them, and each is drafted."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.validation.check import faults
from assur.model.file.reader import read_text
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.inputs import inputs_for
from assur.synthesis.shorthand.arrangements import arranged, arrangements
from assur.synthesis.shorthand.shorthand import read_shorthand
from assur.topology.notation import parse_chains

PATH = Path("my.toml")
ALL = [pytest.param(entry, id=entry.shown) for entry in arrangements()]


@pytest.mark.parametrize("entry", ALL)
def test_an_arrangement_has_the_motion_that_the_table_says_and_is_determined_by_its_drives(entry):
    _, topology = inputs_for(entry.chains, entry.actuate, entry.mode)
    assert f"t{topology.poc.t} r{topology.poc.r}" == entry.motion
    assert topology.dof - topology.internal_freedoms == entry.dof
    assert len(entry.actuate) - entry.dof == (1 if entry.of == "2UPR-2RPU" else 0)


@pytest.mark.parametrize("entry", [entry for entry in ALL if entry.values[0].of])
def test_its_limbs_have_the_joints_of_its_shorthand(entry):
    limbs = [limb for limb in read_shorthand(entry.of) for _ in range(limb.count)]
    for limb, chain in zip(limbs, entry.chains, strict=True):
        written = "".join(getattr(joint, "kind", "") or joint.type.letter for joint in chain.joints)
        expected = "".join(joint.removeprefix("P(").removesuffix(")") for joint in limb.joints)
        assert written in (expected, expected.replace("U", "RR"))


def test_no_two_have_one_name():
    shown = [entry.shown for entry in arrangements()]
    titles = [title.casefold() for entry in arrangements() for title in entry.also]
    assert len(set(shown)) == len(shown)
    assert len(set(titles)) == len(titles)


@pytest.mark.parametrize(
    "entry",
    [
        entry
        if entry.values[0].shown in ("3-RPS 'tangential'", "2UPR-SPR 'collinear axes'")
        else pytest.param(*entry.values, id=entry.id, marks=pytest.mark.deep)
        for entry in ALL
    ],
)
def test_it_is_drafted_sound_and_driven_as_it_says(entry):
    record = read_text(drafted(entry.chains, PATH, actuate=entry.actuate, mode=entry.mode).text, PATH)
    assert faults(record) == ()
    assert len(record.inputs) == entry.dof


@pytest.mark.parametrize("text", ["3-RRR", "3-PRS", "3-UPU", "3-PUU", "3-PRPaR"])
def test_what_could_be_several_is_refused_with_all_of_them_in_full(text):
    with pytest.raises(UsageError, match="several standard arrangements") as caught:
        arranged(text)
    known = [entry for entry in arrangements() if entry.of == text]
    assert len(known) > 1
    for entry in known:
        assert entry.options in caught.value.message
        assert arranged(text, entry.name) == entry
    with pytest.raises(UnknownNameError, match="unknown arrangement of"):
        arranged(text, "nowhere")


@pytest.mark.parametrize(
    ("text", "near"),
    [("3-PRC", "3-RRC"), ("Tripteronn", "Tripteron"), ("4-RPS", "3-RPS"), ("Orthoglyde", "Orthoglide")],
)
def test_what_is_unknown_names_the_near_ones(text, near):
    with pytest.raises(UnknownNameError) as caught:
        arranged(text)
    assert near in caught.value.hint
    assert near in caught.value.message


@pytest.mark.parametrize("text", ["Par4", "bennett"])
def test_what_chains_cannot_say_is_told_so(text):
    with pytest.raises(UsageError, match="not made of chains") as caught:
        arranged(text)
    assert caught.value.hint


@pytest.mark.parametrize(
    ("text", "driven"),
    [
        ("3-RPS", "1.2 2.2 3.2"),
        ("3-_R_PS", "1.1 2.1 3.1"),
        ("3UPS&UP", "1.2 2.2 3.2"),
        ("2UPR-SPR", "1.3 2.3 3.2"),
        ("2UP_R_-_S_PR", "1.4 2.4 3.1"),
        ("SPR-2_U_PR", "1.1 2.1"),
        ("Delta", "1.1 2.1 3.1"),
        ("3-UPS&UP", "1.2 2.2 3.2"),
        ("hexapod", "1.2 2.2 3.2 4.2 5.2 6.2"),
        ("6-R_U_S", "1.2 2.2 3.2 4.2 5.2 6.2"),
    ],
)
def test_what_is_underlined_is_driven_else_what_is_usual(text, driven):
    assert arranged(text).actuate == tuple(driven.split())


def test_limbs_of_six_freedoms_are_taken_as_general():
    assert arranged("3-UPS-3-RUS").options == '--chain "U P S" ' * 3 + '--chain "R U S" ' * 2 + '--chain "R U S"'
    assert arranged("6-UCU").options == '--limb "U C U" --count 6'
    assert arranged("6-PUS").name == "upright rails"


@pytest.mark.parametrize(
    ("chains", "inputs"),
    [
        (["U P S"] * 3 + ["U[x,y] P[z]"], ("P1", "P2", "P3")),
        (["U[x,y] P[z]"] + ["U P S"] * 3, ("P2", "P3", "P4")),
        (["U P S"] * 2 + ["U[x,y] P[z]"], ("P1", "P2", "P3")),
    ],
)
def test_a_limb_that_is_there_to_hold_the_platform_is_not_driven_where_the_others_do(chains, inputs):
    assert inputs_for(parse_chains(chains), None, "home")[0] == inputs
    assert assur.topology(chains).inputs == inputs


@pytest.mark.parametrize(
    "words",
    [
        *(("Orthoglide", ""), ("3-RRPaR", "")),
        *(pytest.param(words, marks=pytest.mark.deep) for words in (("Tsai", ""), ("3-PRPaR", "upright rails"))),
    ],
    ids=" ".join,
)
def test_limbs_with_parallelograms_keep_points_on_spheres_so_that_two_poses_belong_to_any_inputs(words):
    entry = arranged(*words)
    record = read_text(drafted(entry.chains, PATH, actuate=entry.actuate, mode=entry.mode).text, PATH)
    values = home_values(record)
    answer = direct(record, inputs_of(record, values) + 0.03)
    assert answer.complete
    assert len(np.unique(pose_of(record, answer.joints[answer.exists]).round(6), axis=0)) == 2
    assert inverse(record, pose_of(record, values) + 3.0).complete
