import numpy as np
import pytest

import assur
from assur.synthesis.inner_loops import INNER_LOOPS


def test_every_loop_has_its_own_name():
    assert len({row.name for row in INNER_LOOPS}) == len({row.text for row in INNER_LOOPS}) == len(INNER_LOOPS) <= 25


@pytest.mark.parametrize("row", INNER_LOOPS, ids=lambda row: row.name)
def test_what_the_output_link_does_is_what_the_topology_derives(row):
    """The branches side by side as a mechanism of their own, by its two routes."""
    text = row.text.strip("{}").split("|")
    found = assur.topology([branch.strip() for branch in text])
    assert found.poc.dim == row.freedoms
    assert found.poc.r == (1 if row.turns else 0)
    if row.plane:
        assert found.poc.t == row.freedoms


def test_a_word_goes_on_from_the_loop_as_it_is_turned():
    row = INNER_LOOPS[0]
    begun = row.turned_by(np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]))
    assert begun.blocks == (("y", 3),)
    assert begun.known == {"y", "z"}
    assert begun.word == begun.slides == ()
