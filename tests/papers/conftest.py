"""The audit of a paper, run once, and its rows by address."""

from __future__ import annotations

from functools import lru_cache

import pytest

import assur
from assur.audit.audit import audit


@lru_cache(maxsize=8)
def _audit(name):
    return audit(assur.load(name))


@pytest.fixture
def found(request):
    """The audit of the mechanism after which the test's folder is named."""
    return _audit(request.path.parent.name)


@pytest.fixture
def at(found):
    """Address -> {quantity: row}; an address that the audit does not have fails."""

    def rows(source):
        chosen = {row.quantity: row for row in found.rows if row.source == source}
        assert chosen, f"no row at {source}"
        return chosen

    return rows
