"""Scales of a closed form are multiples of a length that has a name."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.sizes import Sizes
from assur.model.registry import load_record


def test_dimensions_without_names_are_refused():
    record = replace(load_record("fivebar"), parameters={})
    sizes = Sizes(SimpleNamespace(symbols=SimpleNamespace(record=record)), frozenset())
    with pytest.raises(NotDerivedError, match="no parameter is a length"):
        str(sizes.reference)


def test_the_unit_of_a_sum_is_that_of_its_lengths_whatever_plain_numbers_stand_in_it():
    x, y, cosine = sympy.symbols("x y cosine", real=True)
    record = load_record("fivebar")
    symbols = SimpleNamespace(record=record, parameters={name: sympy.Symbol(name) for name in record.parameters})
    sizes = Sizes(SimpleNamespace(symbols=symbols, loops=SimpleNamespace(lengths={})), frozenset())
    formulas = [x - 1000, x * (y - 3) * cosine + 5, sympy.sqrt(x**2 + y**2 - 16), cosine - 2, (x - 1) / (y * x)]
    assert [sizes.unit(own) for own in formulas] == [1, 2, 1, 0, -1]
