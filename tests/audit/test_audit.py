"""The audit of every mechanism: complete, with an erratum for whatever is not ok, and as plain data."""

import json
import shutil

import pytest

import assur
from assur.audit.audit import audit, reference_entry, reference_of, rows_of
from assur.audit.reference import reference_folder
from assur.audit.rows import Audit, Erratum, Evidence, Row
from assur.errors import UnknownNameError, UsageError
from assur.results.json_text import json_text
from audits import audited

KEYS = ["source", "quantity", "printed", "computed", "verdict", "erratum", "tolerance", "off_by", "unit", "note"]


@pytest.fixture(params=assur.names())
def found(request):
    return audited(request.param)


# ---- completeness ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", assur.names())
def test_every_mechanism_has_reference_data(name):
    assert sorted(reference_folder(assur.load(name)).glob("*.toml"))


def test_every_mechanism_is_audited_and_our_claims_hold(found):
    assert len(found.rows) > 5
    assert found.claims_hold
    assert found.ok + found.wrong + found.missing == len(found.rows)


def test_whatever_is_not_ok_has_an_erratum(found):
    assert [(row.source, row.quantity) for row in found.rows if row.verdict != "ok" and not row.erratum] == []


def test_every_erratum_that_an_entry_names_shows_in_a_row(found):
    reference = reference_of(assur.load(found.mechanism))
    named = {
        entry.erratum for entries in reference.entries.values() for entry in entries if getattr(entry, "erratum", "")
    }
    named |= {
        line.erratum
        for kind in ("direct", "inverse")
        for entry in reference.entries[kind]
        for line in entry.rows
        if line.erratum
    }
    assert named == {row.erratum for row in found.rows if row.erratum}


def test_addresses_are_unique(found):
    addresses = [(row.source, row.quantity, row.printed) for row in found.rows]
    assert len(set(addresses)) == len(addresses)


def test_ok_rows_agree_within_their_tolerance(found):
    for row in found.rows:
        if row.tolerance is not None and row.off_by is not None and not row.quantity.endswith(("low", "high")):
            assert (abs(row.off_by) <= row.tolerance) == (row.verdict == "ok"), row


def test_what_asks_a_closed_form_is_refused_before_the_work(tmp_path, monkeypatch):
    """The reference data of the five-bar beside a file without formulas: no evidence is looked at before."""
    shutil.copytree(assur.load("fivebar").folder, tmp_path / "fivebar")
    (tmp_path / "fivebar" / "closed_form.py").unlink()
    monkeypatch.delattr("assur.audit.audit.errata")
    with pytest.raises(UsageError, match="has no closed form"):
        audit(assur.load(tmp_path / "fivebar"))


# ---- plain data ------------------------------------------------------------------------------------------------


def test_data_has_the_shape_that_others_rely_on(found):
    data = json.loads(json_text(found))
    assert data["mechanism"] == found.mechanism
    assert (data["ok"], data["wrong"], data["missing"]) == (found.ok, found.wrong, found.missing)
    assert all(list(row) == KEYS for row in data["rows"])
    assert {row["verdict"] for row in data["rows"]} <= {"ok", "wrong", "missing"}
    assert [item["id"] for item in data["errata"]] == [item.id for item in found.errata]


def test_an_audit_is_the_same_twice():
    again = audit(assur.load("fivebar"))
    assert [row.computed for row in again.rows] == [row.computed for row in audited("fivebar").rows]


# ---- claims ----------------------------------------------------------------------------------------------------


def an_audit(origin, verdict, *, holds):
    row = Row("Table 1 row 1", "x", "1.0", 2.0, verdict, "E1")
    erratum = Erratum("E1", "Table 1", "x", "wrong", "direct.x", Evidence(holds, "because"))
    return Audit("m", "paper", origin, (row,), (erratum,))


def test_a_wrong_paper_is_no_failed_claim():
    assert an_audit("printed", "wrong", holds=True).claims_hold


def test_evidence_that_does_not_hold_is_a_failed_claim():
    assert not an_audit("printed", "wrong", holds=False).claims_hold


def test_a_wrong_row_of_derived_data_is_a_failed_claim():
    assert not an_audit("derived", "wrong", holds=True).claims_hold
    assert an_audit("derived", "ok", holds=True).claims_hold


# ---- misuse ----------------------------------------------------------------------------------------------------


def test_another_dimension_is_refused():
    with pytest.raises(UsageError, match=r"l2 = 300.*l2 = 280"):
        audit(assur.load("zeng2019", l2=300))


def test_a_mechanism_without_reference_data_is_refused(tmp_path):
    source = assur.load("fivebar").file
    copy = tmp_path / "lone.toml"
    copy.write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(UsageError, match="no reference data"):
        audit(assur.load(copy))


def test_an_unknown_entry_lists_those_that_exist():
    with pytest.raises(UnknownNameError, match="Table 1"):
        reference_entry(assur.load("zeng2019"), "direct", "Table 7")


def test_rows_of_some_kinds_only():
    rows = rows_of(assur.load("fivebar"), ("poc", "count"))
    assert {row.quantity for row in rows} == {"POC set", "direct solutions", "inverse solutions"}
