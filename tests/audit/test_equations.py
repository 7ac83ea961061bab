"""Equations on random configurations: what holds holds, a small change is found out, rates are derivatives."""

import numpy as np
import pytest

from assur.audit.configurations import configurations
from assur.audit.equations import PrintedEquation, equation_rows, evaluate, rates_of
from assur.errors import UnknownNameError, UsageError
from assur.model.formula import parse
from assur.model.registry import load_record

RECORD = load_record("zeng2019")


def verdict(left, right, unit=1, letters=None):
    entry = PrintedEquation(source="S", printed="p", left=left, right=right, unit=unit, erratum="E1")
    (row,) = equation_rows(RECORD, entry, letters or {})
    return row


def test_a_right_equation_is_ok():
    row = verdict("D1.y", "D3.y")
    assert (row.verdict, row.erratum) == ("ok", "")


@pytest.mark.parametrize("change", ["0.001", "-0.00001"])
def test_a_small_change_is_wrong(change):
    row = verdict("D1.y", f"D3.y + {change}")
    assert (row.verdict, row.erratum) == ("wrong", "E1")
    assert row.computed == pytest.approx(abs(float(change)), rel=1e-3)


def test_components_are_all_looked_at():
    assert verdict(["C1.z", "C1.x"], ["C2.z", "b"]).verdict == "wrong"
    assert verdict(["C1.z", "C1.x"], ["C2.z", "-b"]).verdict == "ok"


def test_both_sides_have_as_many_components():
    with pytest.raises(UsageError, match="2 formulas on the left, 1 on the right"):
        verdict(["C1.z", "C1.x"], "C2.z")


def test_letters_are_formulas():
    letters = {"y": parse("O'.y"), "twice": parse("2*y")}
    assert verdict("twice", "P1 + P2", letters=letters).verdict == "ok"


def test_rates_are_derivatives():
    assert verdict("rate.O'.y", "(rate.P1 + rate.P2)/2").verdict == "ok"
    assert verdict("rate.O'.y", "rate.P1").verdict == "wrong"


def test_a_joint_rate_is_the_rate_itself():
    here = configurations(RECORD)
    index = next(item.index for item in RECORD.coordinates if item.joint == "D1")
    found = evaluate(RECORD, parse("rate.D1"), here.values, here.rates, {})
    np.testing.assert_allclose(found, here.rates[:, index], rtol=1e-9, atol=1e-9)
    one = rates_of(RECORD, ("D1",), here.values[0], here.rates[0])
    assert one == pytest.approx([here.rates[0, index]], rel=1e-9)


def test_an_unknown_quantity_is_refused():
    with pytest.raises(UnknownNameError, match="nothing"):
        verdict("nothing", "0")
