"""A law of every closed form: nothing is divided by what may vanish unnoticed, no root drawn of what is no margin.

Kernels never decide anything, so where a divisor is zero a status must say so; `assur.kinematics.contract.algebra` says
by which rules that is seen, of any dimensions. Nor is anything a margin that is not a radicand, a divisor or a factor.
"""

from dataclasses import replace

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.kernel import questions, recorded
from assur.kinematics.contract.undeclared import own_ends

ENDS = {("h4_robot", "direct"): ("near",), ("three_rps", "direct"): ("heights", "tilt")}
"""Margins without signs, by which a reduced model ends branches: roots of a polynomial that are no poses."""
RAILS = "linear_delta_4s"
"""Its rails have a direction that is a formula of its dimensions."""


@pytest.mark.parametrize(
    ("name", "question"), [(name, question) for name in assur.names() for question in questions(assur.load(name))]
)
def test_radicands_and_divisors_are_declared_and_margins_are_nothing_else(name, question):
    kernel = recorded(assur.load(name), question)
    known = Algebra(kernel, general=name != RAILS)
    doubtful = (*known.doubtful_divisors(), *known.doubtful_radicands())
    assert [kernel.text(k) for k in doubtful] == []
    assert tuple(item.name for item in known.untied()) == ENDS.get((name, question), ())
    assert own_ends(kernel, known) == ENDS.get((name, question), ())


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
