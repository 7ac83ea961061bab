"""Sets whose equations turn with what is given: what one of them says of an unknown, all of them say everywhere."""

import pytest
import sympy

from assur.derivation.linear import ONE
from assur.derivation.linear_span import LinearSpan
from assur.derivation.sets import next_set
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

C, S, X, Y, A = sympy.symbols("c s x y a", real=True)
L = sympy.Symbol("l", positive=True)
ALONG_A_LINE = {"e1": {X: C * L, ONE: -A * C * L}, "e2": {X: S * L, ONE: -A * S * L}}
"""L (x - a) times a direction that turns."""


@pytest.fixture
def witness():
    own = ModularWitness()
    own.on_circle(C, S)
    return own


def test_an_unknown_along_a_line_that_turns_is_divided_by_nothing_that_vanishes(witness):
    crank = UnknownDirection("circle", "crank", (Y, X), ("crank",))
    (chosen,), equations = next_set([*ALONG_A_LINE.values()], [crank], witness)
    assert chosen is crank
    assert equations == [{X: ONE, ONE: -A}]


def test_what_follows_by_components_of_a_direction_follows_without_a_division(witness):
    span = LinearSpan(ALONG_A_LINE, [X], witness)
    assert span.multipliers({X: L, ONE: -A * L}) == {"e1": C, "e2": S}
