import json
import shutil

import pytest

from assur.certificates.certificate import certificate
from assur.certificates.recorded import at_hand, differences, with_dimensions
from assur.errors import UnknownNameError, UsageError
from assur.model.registry import load_record


def record_of(document, name_or_path=None):
    return with_dimensions(document, at_hand(document, name_or_path))


def test_a_certificate_is_that_of_its_mechanism(case, made_of):
    document = json.loads(made_of(case).text)
    assert differences(document, record_of(document)) == ()


def test_other_dimensions_are_part_of_it():
    document = certificate(load_record("zeng2019", l2=300), most=1).to_json()
    assert differences(document, record_of(document)) == ()
    found = differences(document, load_record("zeng2019"))
    assert found[0] == "parameters: l2 = 300.0 there, none here"
    assert "number l2 is 300.0 there, 280.0 here" in found[1]


def test_another_mechanism_is_told(made_of):
    document = made_of("box").to_json()
    assert differences(document, load_record("fivebar")) == ("mechanism: zeng2019 there, fivebar here",)


def test_another_version_of_the_files_is_told(made_of, tmp_path):
    folder = load_record("zeng2019").file.parent
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(folder / name, tmp_path)
    document = made_of("box").to_json()
    assert differences(document, record_of(document, tmp_path / "mechanism.toml")) == ()
    text = (tmp_path / "closed_form.py").read_text()
    changed = text.replace("m12 = p.l2 * p.l2 - w * w", "m12 = -(w * w - p.l2 * p.l2)")
    assert changed != text
    (tmp_path / "closed_form.py").write_text(changed)
    found = differences(document, record_of(document, tmp_path / "mechanism.toml"))
    assert found[0] == "files: closed_form.py not as they were"
    assert found[1].startswith("formulas: ")


@pytest.mark.parametrize("key", ["mode", "strokes", "held"])
def test_a_statement_that_the_formulas_do_not_make_is_told(made_of, key):
    document = json.loads(made_of("strokes").text)
    other = {"mode": "+++++", "strokes": {}, "held": {"y": (100.0).hex()}}[key]
    document["statement"][key] = other
    assert differences(document, load_record("zeng2019"))
    document["statement"][key] = {"mode": "no", "strokes": {"q": None}, "held": {"q": (0.0).hex()}}[key]
    assert differences(document, load_record("zeng2019"))[0].startswith("statement: ")


def test_constants_may_be_those_of_another_machine(made_of):
    """Their bounds must enclose what is recorded here, to some units in the last place either way."""
    document = json.loads(made_of("angular strokes").text)
    record = load_record("fivebar")
    places = [
        k for k, item in enumerate(document["program"]["operations"]) if item[0] == "number" and "constant" in item[3]
    ]
    assert places
    for k in places:
        item = document["program"]["operations"][k]
        low, high = (float.fromhex(text) for text in item[1:3])
        for shift, same in ((0.02 * (high - low), True), (high - low, False)):
            item[1:3] = [(low + shift).hex(), (high + shift).hex()]
            assert (differences(document, record) == ()) is same
        item[1:3] = [low.hex(), high.hex()]


def test_a_mechanism_that_is_not_here_is_told(made_of):
    document = json.loads(made_of("box").text)
    document["statement"]["mechanism"] = "zeng2020"
    assert at_hand(document) is None
    with pytest.raises(UnknownNameError):
        at_hand(document, "zeng2020")


@pytest.mark.parametrize(("name", "value"), [("l_2", 280.0), ("record", 1.0), ("l2", 0.0), ("l2", -1.0)])
def test_dimensions_that_the_mechanism_cannot_have_are_an_error_and_never_a_mechanism_not_at_hand(made_of, name, value):
    document = json.loads(made_of("box").text)
    document["statement"]["parameters"] = {name: value.hex()}
    record = at_hand(document)
    assert record.name == "zeng2019"
    with pytest.raises(UsageError):
        with_dimensions(document, record)
    other = load_record("fivebar")
    assert with_dimensions(document, other) is other


def test_a_mechanism_that_lost_its_closed_form_is_told(made_of, tmp_path):
    shutil.copy(load_record("zeng2019").file, tmp_path)
    document = json.loads(made_of("box").text)
    found = differences(document, record_of(document, tmp_path / "mechanism.toml"))
    assert found[0] == "files: closed_form.py not as they were"
    assert "closed form" in found[1]


def test_a_certificate_makes_nobody_run_the_files_that_it_names(made_of, tmp_path):
    """Its name is a text that anyone can write: a path in it is no mechanism, unless the reader says so."""
    folder = load_record("zeng2019").file.parent
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(folder / name, tmp_path)
    ran = tmp_path / "ran"
    with (tmp_path / "closed_form.py").open("a") as stream:
        stream.write(f"\nfrom pathlib import Path\nPath({str(ran)!r}).touch()\n")
    document = json.loads(made_of("box").text)
    for name in (str(tmp_path), str(tmp_path / "mechanism.toml"), 5, None, ["zeng2019"]):
        document["statement"]["mechanism"] = name
        assert at_hand(document) is None
    assert not ran.exists()
