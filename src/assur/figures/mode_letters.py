"""Letters of signs: each in a frame at the joints that it is about, and what its + means for the caption."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from assur.figures.canvas import View
from assur.figures.letters import letter
from assur.figures.placing import Letters
from assur.figures.sketch import chain_colours
from assur.figures.style import INK, PAPER, TEXT
from assur.kinematics.modes import Problem
from assur.kinematics.naming import DescribedSign, described_signs
from assur.model.mechanism import MechanismRecord
from assur.scene.skeleton import Skeleton

BOTH: tuple[Problem, ...] = ("inverse", "direct")


def shown_signs(record: MechanismRecord, problems: Sequence[Problem] = BOTH) -> tuple[DescribedSign, ...]:
    """Signs that figures show: those of the joint graph, and a file's quantities where no closed form explains them.

    >>> from assur.model.registry import load_record
    >>> [sign.letter for sign in shown_signs(load_record("gough_stewart"))]
    ['s1', 's2', 's3', 's4', 's5', 's6', 'e1']
    >>> shown_signs(load_record("fivebar"))
    ()
    """
    every = [sign for problem in problems for sign in described_signs(record, problem)]
    return tuple(sign for sign in every if not sign.written or (sign.places and not record.closed_form))


def add_signs(view: View, skeleton: Skeleton, letters: Letters, signs: Sequence[DescribedSign]) -> None:
    """The letter of each sign at the middle of its joints, or between it and one of them; of a limb in its colour.

    That of a sign of the platform's place, which is about no joint, stands at the platform's point.
    """
    platform = skeleton.record.platform
    turn, origin = skeleton.frames[platform.link]
    shown = {**skeleton.points, **{mark.joint.name: mark.shown for mark in skeleton.marks}}
    for sign in signs:
        joints = np.array([shown[name] for name in sign.places] or [turn @ platform.point + origin])
        middle = joints.mean(axis=0)
        anchors = np.concatenate([middle[None], (middle + joints) / 2])
        colour = _colour(skeleton, sign)
        frame = {"boxstyle": "round,pad=0.15", "facecolor": PAPER, "edgecolor": colour, "linewidth": 0.5}
        letters.add(view(anchors), letter(sign.letter), clear=2.0, fontsize=TEXT, color=colour, bbox=frame)


def _colour(skeleton: Skeleton, sign: DescribedSign) -> str:
    """That of the limb that has all places of the sign; of several limbs, or none, that of letters."""
    record, colours = skeleton.record, chain_colours(skeleton)
    every = []
    for name in sign.places:
        joint = record.joints.get(name)
        links = (joint.parent, joint.child) if joint else (record.points[name].link,)
        every.append({colours[link] for link in links if link in colours} or {INK})
    own = set().union(*every)
    return own.pop() if len(own) == 1 else INK


def signs_said(signs: Sequence[DescribedSign]) -> str:
    """What the + of each means, for a caption; "" without signs.

    >>> from assur.model.registry import load_record
    >>> print(signs_said(shown_signs(load_record("gough_stewart"), ["inverse"])[:1]))
    $s_{1}$ is + where $B_{1}$ lies ahead of $A_{1}$ along $P_{1}$
    """
    written = [letter(sign.letter) for sign in signs if sign.written]
    said = [f"{letter(sign.letter)} is + where {_sentence(sign)}" for sign in signs if not sign.written]
    if written:
        verb, noun = ("is", "a quantity") if len(written) == 1 else ("are", "quantities")
        said.insert(0, f"{', '.join(written)} {verb} {noun} of the mechanism's file")
    return "; ".join(said)


def _sentence(sign: DescribedSign) -> str:
    """Its meaning with joints as figures write them."""
    names = "|".join(re.escape(name) for name in sorted(sign.places, key=len, reverse=True))
    return re.sub(rf"(?<![\w.])(?:{names})(?![\w.])", lambda name: letter(name[0]), sign.meaning)
