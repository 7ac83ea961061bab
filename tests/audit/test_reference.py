"""Reference files: digits stay text, and every fault is refused with its place."""

import dataclasses
import shutil

import pytest

from assur.audit.audit import FORMS, audit, reference_of
from assur.audit.errata import errata
from assur.audit.reference import read_reference
from assur.errors import MechanismFileError, UnknownNameError, UsageError
from assur.model.consent import leave
from assur.model.registry import load_record

COUNT = """
[[count]]
source = "S"
quantity = "q"
problem = "direct"
given = ["1", "2"]
of = "real"
printed = "2"
"""


@pytest.fixture
def record(tmp_path):
    original = load_record("fivebar")
    shutil.copytree(original.folder, tmp_path / "copy")
    return dataclasses.replace(original, folder=tmp_path / "copy")


def add(record, text, name="more.toml"):
    (record.folder / "reference" / name).write_text(text, encoding="utf-8")
    return record


def faults(record):
    with pytest.raises(MechanismFileError) as caught:
        read_reference(record, FORMS)
    return str(caught.value)


def test_digits_are_kept_as_printed():
    table = reference_of(load_record("zeng2019")).entries["direct"][0]
    assert table.rows[1].values[0].text == "-128.8290"


def test_a_number_without_quotes_is_refused(record):
    text = faults(add(record, COUNT.replace('"1", "2"', '1.0, "2"')))
    assert "more.toml" in text
    assert "the printed digits in quotes" in text


def test_an_unknown_key_is_refused_with_its_line(record):
    text = faults(add(record, "[parameters]\n[definitions]\n[[count]]\nsorce = 'S'\n"))
    assert "more.toml:3" in text
    assert "unknown key" in text


def test_an_unknown_kind_is_refused(record):
    assert "unknown key" in faults(add(record, "[[tabel]]\nsource = 'S'\n"))


def test_every_fault_is_reported_at_once(record):
    assert "2 problems" in faults(add(record, COUNT.replace('"1", "2"', "1.0, 2.0")))


def test_a_formula_that_cannot_be_read_is_refused(record):
    text = faults(add(record, "[[equation]]\nsource = 'S'\nprinted = 'p'\nleft = 'x^2'\nright = '0'\n"))
    assert "there are no powers" in text


@pytest.mark.parametrize("definitions", ["u = 'u + 1'", "u = 'v'\nv = '1'"])
def test_a_letter_may_need_those_before_it_only(record, definitions):
    assert "definitions.u" in faults(add(record, f"[definitions]\n{definitions}\n"))


def test_two_abouts_are_refused(record):
    assert "2 tables [about]" in faults(add(record, "[about]\norigin = 'derived'\ntext = ''\n"))


def test_a_parameter_that_the_mechanism_lacks_is_refused(record):
    with pytest.raises(UsageError, match="differ in the parameters: l9"):
        read_reference(add(record, "[parameters]\nl9 = '1'\n"), FORMS)


def test_a_quantity_that_does_not_exist_is_refused(record):
    broken = add(record, "[[equation]]\nsource = 'S'\nprinted = 'p'\nleft = 'Q.x'\nright = '0'\n")
    with pytest.raises(UnknownNameError, match=r"Q\.x"):
        audit(broken)


def test_an_erratum_without_its_evidence_is_refused(record):
    text = "[E1]\nwhere = 'w'\nprinted = 'p'\nfinding = 'f'\nevidence = 'direct.nothing'\n"
    with pytest.raises(MechanismFileError, match=r"E1\.evidence.*no function 'direct\.nothing'"):
        errata(add(record, text, "errata.toml"))


def test_evidence_that_is_no_evidence_is_refused(record):
    text = "[E1]\nwhere = 'w'\nprinted = 'p'\nfinding = 'f'\nevidence = 'direct.five'\n"
    folder = record.folder / "reference" / "evidence"
    folder.mkdir()
    (folder / "direct.py").write_text("def five(record):\n    return 5\n", encoding="utf-8")
    with leave(given=True), pytest.raises(MechanismFileError, match="returns no Evidence"):
        errata(add(record, text, "errata.toml"))


def test_a_row_whose_erratum_does_not_exist_is_refused(record):
    wrong = COUNT.replace('given = ["1", "2"]', 'given = ["100", "80"]\nerratum = "E9"').replace('= "2"\n', '= "3"\n')
    with pytest.raises(UnknownNameError, match="E9"):
        audit(add(record, wrong))


def test_a_mechanism_without_errata_has_none(record):
    assert errata(record) == ()
