"""Solutions that have one name, where names are left out."""

import numpy as np
import pytest

from assur.kinematics.closing_blocks.by_name import sorted_by_name
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
from assur.kinematics.closing_blocks.namesakes import namesakes
from assur.model.registry import load_record


@pytest.mark.parametrize(
    ("name", "problem"),
    [("fivebar", "direct"), ("fivebar", "inverse"), pytest.param("zeng2019", "direct", marks=pytest.mark.deep)],
)
def test_without_one_of_its_names_solutions_are_namesakes_and_with_all_none_are(name, problem):
    record = sorted_by_name(load_record(name))
    signs, near = distinguishing_signs(record, problem), ScrewColumns(record, assemblies_by_chance(record))
    every = range(len(signs))
    assert not len(namesakes(problem, signs, near, every))
    for left in every:
        unlike = namesakes(problem, signs, near, [own for own in every if own != left])
        assert len(unlike)
        assert np.array_equal(np.unique(unlike, axis=0), np.equal(every, left)[None])
