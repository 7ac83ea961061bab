"""Where the closure of a derived form loses rank: what is only small at a place says nothing against it."""

import pytest

from assur.derivation.derivation import derive
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated


@pytest.mark.deep
def test_rods_parallel_to_one_plane_are_a_constraint_singularity_of_three_that_slide(tmp_path):
    """Six rods in three parallelograms: where their directions are coplanar they hold one rotation less."""
    path = tmp_path / "own.toml"
    path.write_text(drafted(repeated("P[x] P(4S)[y]", 3), path).text, encoding="utf-8")
    text = derive(load_record(path)).closed_form()
    assert "are parallel to one plane" in text
    assert "constraint_singular=(('f1',),)" in text
