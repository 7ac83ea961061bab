import re
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import assur
from assur.report.sections import provenance
from assur.results.kinds import Table

CITATION = Path(__file__).parents[3] / "CITATION.cff"


def test_the_citation_is_that_of_the_project():
    text = CITATION.read_text(encoding="utf-8")
    entries = dict(re.findall(r'^(\w+): "?(.*?)"?$', text, re.MULTILINE))
    assert (entries["title"], entries["license"], entries["version"]) == (
        provenance.TITLE,
        provenance.LICENSE,
        assur.__version__,
    )
    assert provenance.AUTHORS in text


def test_versions_are_those_installed():
    found = provenance.provenance(SimpleNamespace(record=assur.load("fivebar")))
    versions = dict(next(item for item in found.results if isinstance(item, Table)).rows)
    assert versions["assur"] == assur.__version__
    assert versions["numpy"] == metadata.version("numpy")
    assert set(provenance.PACKAGES) < set(versions)
