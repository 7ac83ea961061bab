"""A law of every closed form: nothing is divided by what may vanish unnoticed, nor a root drawn of what is no margin.

Kernels never decide anything, so where a divisor is zero a status must say so; `assur.kinematics.contract.algebra` says
by which rules that is seen. What is seen by none of them, and yet not zero or no harm, is told in `EXPLAINED`: how many
divisors, how many radicands, and why.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.kernel import questions, recorded

CURVE = "a curve is worked out only where two centres coincide: then the axis has a length, and is not along X"
QUADRICS = "quadratic forms of a root that solves three quadrics: that they have their values is what it solves"
EXPLAINED = {
    ("h4_robot", "inverse"): (1, 1, "the quantity t, on which nothing else depends, is that of the direct problem"),
    ("h4_robot", "direct"): (1, 1, QUADRICS),
    ("three_rps", "direct"): (13, 2, "squares of units, and det Jp of poses between two steps of Newton's method: if "
                                     "one is zero, `upright` is not finite, so that a double root is undecided"),
    ("three_rrc", "direct"): (2, 0, "det(A A^T + eps 1) is at least eps^3"),
    ("delta_4s", "self_motion"): (2, 0, CURVE),
    ("linear_delta_4s", "self_motion"): (2, 0, CURVE),
    ("orthoglide", "self_motion"): (2, 0, CURVE),
    ("tsai_platform", "self_motion"): (2, 0, CURVE),
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "question"), [(name, question) for name in assur.names() for question in questions(assur.load(name))]
)
def test_nothing_is_divided_by_what_may_vanish_unnoticed(name, question):
    kernel = recorded(assur.load(name), question)
    known = Algebra(kernel)
    divisors, radicands = known.doubtful_divisors(), known.doubtful_radicands()
    expected = EXPLAINED.get((name, question), (0, 0, ""))[:2]
    assert (len(divisors), len(radicands)) == expected, [kernel.text(k) for k in (*divisors, *radicands)]


def test_rails_without_a_direction_are_refused():
    with pytest.raises(UsageError, match="lean = 0, rise = 0"):
        assur.load("linear_delta_4s", lean=0.0, rise=0.0)


@pytest.mark.parametrize(("name", "question"), [("distance1", "inverse"), ("gap", "direct")])
def test_a_division_that_is_not_declared_is_found(name, question):
    """The five-bar without the margin that says where its legs have no direction."""
    record = assur.load("fivebar")
    form = record.closed_form
    kept = {
        f"{kind}_margins": tuple(item for item in getattr(form, f"{kind}_margins") if item.name != name)
        for kind in ("inverse", "direct")
    }
    factors = tuple(item for item in form.factor_list if item.kind != "other")
    changed = replace(record, closed_form=replace(form, **kept, factor_list=factors))
    assert Algebra(recorded(changed, question)).doubtful_divisors()


def test_a_root_of_what_is_no_margin_is_found():
    """The five-bar without the margin that says where its rods meet."""
    record = assur.load("fivebar")
    form = record.closed_form
    margins = tuple(item for item in form.direct_margins if item.name != "meeting")
    changed = replace(record, closed_form=replace(form, direct_margins=margins))
    assert Algebra(recorded(changed, "direct")).doubtful_radicands()
