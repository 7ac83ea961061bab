"""The audit of a paper and its rows by address."""

import pytest

from audits import audited


@pytest.fixture
def found(request):
    """The audit of the mechanism after which the test's folder is named."""
    return audited(request.path.parent.name)


@pytest.fixture
def at(found):
    """Address -> {quantity: row}; an address that the audit does not have fails."""

    def rows(source):
        chosen = {row.quantity: row for row in found.rows if row.source == source}
        assert chosen, f"no row at {source}"
        return chosen

    return rows
