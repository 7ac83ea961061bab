"""Scales of a closed form are multiples of a length that has a name."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.sizes import Sizes
from assur.model.registry import load_record


def test_dimensions_without_names_are_refused():
    record = replace(load_record("fivebar"), parameters={})
    sizes = Sizes(SimpleNamespace(symbols=SimpleNamespace(record=record)), frozenset())
    with pytest.raises(NotDerivedError, match="no parameter is a length"):
        str(sizes.reference)
