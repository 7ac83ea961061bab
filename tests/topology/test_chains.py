"""Chains as data: what they refuse, and how they are walked through."""

import pytest

from assur.errors import UsageError
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import Chain, ChainJoint, InnerLoop, Parallelogram

X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
R = ChainJoint(REVOLUTE, (X,), name="R1")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ChainJoint(REVOLUTE, ()), "0 axes for R; expected 1"),
        (lambda: ChainJoint(REVOLUTE, (X, Y)), "2 axes for R; expected 1"),
        (lambda: ChainJoint(UNIVERSAL, (X,)), "1 axes for U; expected 2"),
        (lambda: ChainJoint(SPHERICAL, (X,)), "1 axes for S; expected 0"),
        (lambda: ChainJoint(REVOLUTE, ((1.0, 1.0, 0.0),)), "unit vector"),
        (lambda: ChainJoint(REVOLUTE, ((float("nan"), 0.0, 0.0),)), "unit vector"),
        (lambda: ChainJoint(UNIVERSAL, (X, (-1.0, 0.0, 0.0))), "parallel axes"),
        (lambda: ChainJoint(PRISMATIC, (X,), "A"), "a translation has no place"),
        (lambda: Parallelogram("5R", X), "unknown parallelogram '5R'"),
        (lambda: Parallelogram("4R", (0.0, 0.0, 0.0)), "unit vector"),
        (lambda: InnerLoop(((R,),)), "two branches or more"),
        (lambda: InnerLoop(((R,), ())), "none empty"),
    ],
)
def test_what_is_refused(make, words):
    with pytest.raises(UsageError, match=words):
        make()


def test_joints_in_the_order_of_the_text():
    names = iter("abcdef")

    def joint():
        return ChainJoint(REVOLUTE, (X,), name=next(names))

    inner = InnerLoop(((joint(),), (joint(),)), "inner")
    outer = InnerLoop(((inner, joint()), (joint(),)), "outer")
    chain = Chain((outer, Parallelogram("4R", Y, "Pa1"), joint()))
    assert [item.name for item in chain.joints] == ["a", "b", "c", "d", "Pa1", "e"]
    assert [item.freedoms for item in chain.joints] == [1] * 6
