"""What has passed is kept by the files it was, and nothing else is taken for it."""

import json
import os

import pytest

from assur import load
from assur.errors import MechanismFileError
from assur.kinematics.contract import admission, check
from assur.kinematics.contract.kept import FOLDER


@pytest.fixture
def counted(monkeypatch):
    """How often a closed form was checked."""
    calls = []
    kept = check.problems.__wrapped__
    monkeypatch.setattr(check, "problems", lambda *given: calls.append(given) or kept(*given))
    return calls


@pytest.fixture
def entry():
    """The one entry of the cache."""

    def result():
        (path,) = (__import__("pathlib").Path(os.environ["ASSUR_CACHE"]) / FOLDER).iterdir()
        return path

    return result


def test_a_form_is_checked_once(copied, counted, entry):
    folder = copied("biglide")
    for _ in range(3):
        load(folder)
    assert len(counted) == 1
    assert not [path.name for path in folder.iterdir() if path.name not in ("mechanism.toml", CLOSED)]
    kept = json.loads(entry().read_text())
    assert (kept["passed"], kept["dimensions"], sorted(kept["files"])) == (True, "any", [CLOSED, "mechanism.toml"])


CLOSED = "closed_form.py"


def test_any_dimensions_pass_with_those_of_the_file(copied, counted):
    folder = copied("biglide")
    load(folder)
    load(folder, r2=230)
    load(folder).with_parameters(r1=170)
    assert len(counted) == 1


def test_a_changed_file_is_another_form(copied, counted):
    folder = copied("biglide")
    load(folder)
    path = folder / CLOSED
    path.write_text(path.read_text(encoding="utf-8").replace("arm1 = sign.s1", "arm1 = -sign.s1"), encoding="utf-8")
    with pytest.raises(MechanismFileError, match="mode sign s1"):
        load(folder)
    assert len(counted) == 2


@pytest.mark.parametrize("damage", ["empty", "cut", "other", "list", "deep", "writable", "link", "folder"])
def test_a_damaged_or_forged_entry_is_computed_again(copied, counted, entry, damage, tmp_path):
    folder = copied("biglide")
    load(folder)
    path = entry()
    text = path.read_text(encoding="utf-8")
    content = {"empty": "", "cut": text[:50], "other": text.replace('"biglide"', '"zeng2019"'), "list": "[1, 2]",
               "deep": "[" * 9000}.get(damage, text)  # fmt: skip
    path.write_text(content, encoding="utf-8")
    if damage == "writable":
        path.chmod(0o666)
    if damage in ("link", "folder"):
        path.unlink()
        (tmp_path / "elsewhere.json").write_text(text, encoding="utf-8")
        path.symlink_to(tmp_path / "elsewhere.json") if damage == "link" else path.mkdir()
    load(folder)
    assert len(counted) == 2


def test_an_entry_never_lets_a_wrong_form_pass(copied, entry):
    """What another form earned does not count for this one, under whatever name it lies."""
    folder = copied("biglide")
    load(folder)
    kept = entry().read_bytes()
    path = folder / CLOSED
    path.write_text(path.read_text(encoding="utf-8").replace("arm1 = sign.s1", "arm1 = -sign.s1"), encoding="utf-8")
    from assur.kinematics.contract.kept import _entry, _name
    from assur.model.registry import load_record

    entry().with_name(_name(_entry(load_record(folder), admission.AT_LOAD, "any"))).write_bytes(kept)
    with pytest.raises(MechanismFileError, match="mode sign s1"):
        load(folder)


def test_a_cache_that_cannot_be_written_is_no_fault(copied, counted, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "file"))
    folder = copied("biglide")
    load(folder)
    load(folder)
    assert len(counted) == 2


def test_a_built_in_form_is_not_checked(counted):
    load("zeng2019", l2=300)
    assert counted == []


@pytest.mark.parametrize("file", [CLOSED, "mechanism.toml"])
def test_a_file_that_is_changed_between_reading_and_check_has_not_passed(copied, counted, file):
    """A check is of what was read; an editor, or an enemy, may have written another file meanwhile."""
    from assur.model.registry import load_record

    folder = copied("biglide")
    path = folder / file
    text = path.read_text(encoding="utf-8")
    read = load_record(folder)
    path.write_text(text.replace("arm1 = sign.s1", "arm1 = -sign.s1") + "# another file\n", encoding="utf-8")
    admission.check_closed_form(read)
    assert len(counted) == 1
    if file == CLOSED:
        with pytest.raises(MechanismFileError, match="mode sign s1"):
            load(folder)
    else:
        load(folder)
    assert len(counted) == 2


def test_a_form_that_was_read_is_not_excused_by_the_file_that_stands_there_now(copied):
    from assur.model.registry import load_record

    folder = copied("biglide")
    path = folder / CLOSED
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("arm1 = sign.s1", "arm1 = -sign.s1"), encoding="utf-8")
    wrong = load_record(folder)
    path.write_text(text, encoding="utf-8")
    load(folder)
    with pytest.raises(MechanismFileError, match="mode sign s1"):
        admission.check_closed_form(wrong)
