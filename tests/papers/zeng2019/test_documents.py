"""ERRATA.md and CONFORMANCE.md at the root are those that the audit generates."""

from pathlib import Path

import pytest

from assur.audit.documents import documents

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("name", ["ERRATA.md", "CONFORMANCE.md"])
def test_document_is_not_stale(found, name):
    committed = (ROOT / name).read_text(encoding="utf-8")
    assert committed == documents(found)[name], "run: assur audit zeng2019 --documents ."
