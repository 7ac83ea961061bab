"""Of which assemblies it is asked that a closed form has them."""

import numpy as np
import pytest

from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.contract.completeness import _clear
from assur.kinematics.home import home_values
from assur.kinematics.rates.motions import motions
from assur.model.registry import load_record
from assur.singularity.examples import singular_examples


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_an_assembly_whose_platform_could_nearly_turn_is_not_asked_for(problem):
    """Couples of a Delta that are nearly parallel to one plane: inputs and pose tell it apart, but for rounding."""
    record = load_record("delta_4s")
    example = next(own for own in singular_examples(record) if own.factor.name == "couples")
    shifts = 1e-4 * np.random.default_rng(0).normal(size=(4, len(example.joints)))
    closed = assemble(record, example.joints + shifts)
    values = np.concatenate([home_values(record)[None], closed.values[closed.closed]])
    motion = motions(record, values, RANK_GAP)
    assert len(values) == 5
    assert len({*motion.ranks.closure.tolist()}) == 1, "none has lost rank for good"
    assert _clear(record, problem, motion).tolist() == [True, *4 * [False]]
