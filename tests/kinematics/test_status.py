import numpy as np
import pytest

from assur.kinematics.status import allows, exists, tolerance, vanishes
from assur.model.closed_form import Margin
from assur.model.registry import load_record

RECORD = load_record("fivebar")
RADICAND = Margin("w", "l2*l2", "reach", unit=2)
GAP = Margin("gap", "l2*l2", "the formulas degenerate", unit=2, zero="degenerate")


@pytest.mark.parametrize(
    ("margin", "times", "allowed"),
    [
        (RADICAND, (-2.0, -0.5, 0.0, 0.5, 2.0), (False, True, True, True, True)),
        (GAP, (-2.0, -0.5, 0.0, 0.5, 2.0), (True, False, False, False, True)),
    ],
)
def test_a_margin_is_judged_within_its_tolerance(margin, times, allowed):
    values = tolerance(RECORD, margin) * np.array(times)
    assert allows(RECORD, margin, values).tolist() == list(allowed)
    assert vanishes(RECORD, margin, values).tolist() == [False, True, True, True, False]


@pytest.mark.parametrize("margin", [RADICAND, GAP], ids=lambda margin: margin.name)
def test_what_is_no_number_allows_nothing(margin):
    assert not allows(RECORD, margin, np.nan)


def test_a_branch_exists_where_every_margin_allows_it():
    values = {"w": np.array([1.0, -1.0, 1.0, 1.0]), "gap": np.array([1.0, 1.0, 0.0, -1.0])}
    assert exists(RECORD, [RADICAND, GAP], values).tolist() == [True, False, False, True]
