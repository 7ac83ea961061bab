import numpy as np
import pytest

from assur.synthesis import limb_motions
from assur.synthesis.isomorphism import limb_key
from assur.synthesis.limb_motions import verdict
from assur.synthesis.limbs import LimbType
from assur.synthesis.positions import positions
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain
from assur.topology.symbolic.union import serial

SPACE, TURNING, PLANE = (MOTIONS[name] for name in ("3T", "3T1R", "2T1R"))


def judged(text, motion=SPACE, driven=(0,)):
    chain = parse_chain(text)
    limb = LimbType(chain, driven, limb_key(chain, motion, driven))
    return verdict(limb, motion, positions(motion, motion.dim))


@pytest.mark.parametrize(
    ("text", "t", "r"),
    [
        ("P[x] P[y] P[z]", 3, 0),
        ("P[x] P(4R)[y] P(4R)[z]", 3, 0),
        ("R[x] R[x] P(4R)[y] R[x]", 3, 1),
        ("P[x] R[x] R[x] R[x]", 3, 1),
        ("C[x] R[x] R[x]", 3, 1),
        ("R[x] R[x] R[x] R[y] R[y]", 3, 2),
        ("U[x,y] P[x] U[y,x]", 3, 2),
        ("P[x] U[x,y] U[y,x]", 3, 2),
        ("R[x] U[x,y] U[y,x]", 3, 2),
        ("U[x,y] P[x] S", 3, 3),
    ],
)
def test_limbs_of_the_theory(text, t, r):
    """poc-theory: Schoenflies X(u), the 5-R limbs, U-P-U in translation, U-P-S; both routes answer and agree."""
    found = judged(text).limb
    assert (found.known.poc.t, found.known.poc.r, found.known.poc.dim) == (t, r, t + r)
    assert found.known.route == "both"
    assert len(found.chains) == len(found.motions) == len(found.edges) == 3


@pytest.mark.parametrize(
    ("text", "motion", "reason"),
    [
        ("R[x] R[x] R[x] P[y]", SPACE, "a passive freedom"),
        ("R[x] R[x] R[x] R[x]", SPACE, "a passive freedom"),
        ("P[x] P[y] R[z] R[z]", SPACE, "a passive freedom"),
        ("R[x] R[x] R[x]", SPACE, "not the motion"),
        ("P[x] P[y] P[z]", TURNING, "not the motion"),
        ("R[x] R[x] R[x] C[x]", SPACE, "a passive freedom"),
        ("P[x] P[y] P[z] R[x]", SPACE, "an idle joint"),
        ("P[x] S C[x]", SPACE, "a passive freedom"),
        ("P[x] P[y] C[z]", PLANE, "an idle joint"),
    ],
)
def test_limbs_of_no_use(text, motion, reason):
    found = judged(text, motion)
    assert (found.limb, found.reason, found.disagreement) == (None, reason, "")


def test_a_ball_joint_may_turn_about_fewer_axes_than_it_could():
    assert judged("R[x] C[x] S").limb is not None


def test_idle_in_one_motion_and_not_in_another():
    assert judged("P[x] P[y] P[z] R[z]", TURNING).limb is not None
    assert judged("P[x] P[y] P[z] R[z]", SPACE).reason == "an idle joint"


def test_each_position_has_its_own_directions_and_lengths():
    found = judged("R[x] R[x] P(4R)[y] R[x]").limb
    assert [chain.text.split()[0] for chain in found.chains] == ["R[x]", "R[y]", "R[z]"]
    twists = [edge.twists for (edge,) in found.edges]
    for axis, placed in enumerate(twists):
        assert placed[:, :3, 0] == pytest.approx(np.tile(np.eye(3)[axis], (3, 1)))
    assert not np.allclose(twists[0][:, 3:, 1], np.roll(twists[1][:, 3:, 1], -1, axis=1))


@pytest.mark.parametrize(("text", "needs"), [("C[x] R[x] R[x]", False), ("U[x,y] P[x] U[y,x]", True)])
def test_a_limb_may_need_the_platform_not_to_turn(text, needs):
    assert judged(text).limb.needs_mode == needs


def test_a_disagreement_names_the_chain(monkeypatch):
    """The rules are made to speak of another chain."""
    monkeypatch.setattr(limb_motions, "serial", lambda *_: serial(parse_chain("R[x] R[x] R[x]"), "translation"))
    found = judged("P[x] R[x] R[x] R[x]")
    assert found.limb is None
    assert found.disagreement == "P[x] R[x] R[x] R[x]: the rules say not the motion, the twists the motion"


def test_a_disagreement_on_the_poc_set_alone_names_the_chain_too(monkeypatch):
    monkeypatch.setattr(limb_motions, "serial", lambda *_: serial(parse_chain("C[x] R[x] R[x]"), "translation"))
    found = judged("P[x] P[y] P[z]")
    assert found.limb is None
    assert found.disagreement.startswith("P[x] P[y] P[z]: the rules say t3 r1 with dim 4, the twists t3 r0 with dim 3")
