"""Pitches: a chain that translates along a helix's axis at will need not do so as written."""

import pytest

import assur
from assur.topology.notation import parse_chain
from assur.topology.symbolic.elementary import elementary
from assur.topology.symbolic.helices import coupled
from assur.topology.symbolic.motion import motion_at_home
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spans import ALL, Span
from assur.topology.symbolic.union import serial


@pytest.mark.parametrize(
    ("text", "refused"),
    [("H[z] R[x]", True), ("H[z] R[z]", True), ("H[z] P[z] R[x]", False), ("P[x] H[z] R[z] P[z]", False)],
)
def test_a_pitch_matters_where_nothing_slides_along_it(text, refused):
    chain = elementary(parse_chain(text).elements, None)
    assert isinstance(coupled(chain, Span()), Refusal) == refused
    assert coupled(chain, ALL) is None


def test_as_written_the_pitch_may_matter_although_it_does_not_after_a_displacement():
    found = serial(parse_chain("H[z] P[x] S R[z]"))
    assert found.poc.dim == 6
    assert "the pitch of H1" in motion_at_home(found.limb).reason


def test_six_freedoms_each_leave_the_platform_six():
    """Its H was once taken for an R as written, and the rules said t2 r1."""
    found = assur.topology(
        ["H[z] P[-x] S R[z]", "H[z] P[0.5,-0.8660254037844386,0] S R[z]", "H[z] P[0.5,0.8660254037844386,0] S R[z]"]
    )
    assert (found.poc.t, found.poc.r, found.poc.dim) == (3, 3, 6)
