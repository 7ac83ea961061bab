"""Dependence of pose coordinates on inputs: found where it is, and not where it is not."""

import pytest

from assur.audit.decoupling import Dependence, dependence_rows
from assur.errors import UnknownNameError
from assur.model.registry import load_record

RECORD = load_record("zeng2019")


def verdict(quantity, on):
    entry = Dependence(source="S", quantity=quantity, printed="p", on=on, erratum="E1")
    return dependence_rows(RECORD, entry)[0].verdict


@pytest.mark.parametrize(
    ("on", "expected"), [(("yA1", "yA2"), "ok"), (("yA1", "yA2", "yA3"), "wrong"), (("yA1",), "wrong")]
)
def test_y_depends_on_two_inputs(on, expected):
    assert verdict("y", on) == expected


def test_unknown_names_are_refused():
    with pytest.raises(UnknownNameError, match="yA4"):
        verdict("y", ("yA4",))
    with pytest.raises(UnknownNameError, match="phi"):
        verdict("phi", ("yA1",))
