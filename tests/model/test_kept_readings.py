"""What is kept of a file is what was read of it, and nothing else is taken for it."""

import os
from dataclasses import fields, is_dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from assur.cache import KINDS
from assur.joints.joint_type import JointType
from assur.mechanism import load
from assur.model import kept_readings
from assur.model.dimensions import with_parameters
from assur.model.file.reader import read_mechanism, read_text
from assur.model.kept_readings import KIND, keep_reading, kept_reading
from assur.model.registry import file_of, load_record, names


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / KIND


@pytest.fixture
def fresh(monkeypatch):
    """How often a file was read anew."""
    calls = []
    monkeypatch.setattr("assur.model.file.reader.read_text", lambda *given: calls.append(given) or read_text(*given))
    return calls


@pytest.fixture
def own(tmp_path):
    """A user's own file of the five-bar: a built-in one is read once in a process."""
    path = tmp_path / "own.toml"
    path.write_text(file_of("fivebar").read_text(encoding="utf-8"), encoding="utf-8")
    return path


def parts(value):
    """A record as plain data, with the class of each part and every bit of each float."""
    if isinstance(value, JointType):
        return value.name
    if isinstance(value, np.ndarray):
        return value.shape, str(value.dtype), value.tobytes()
    if is_dataclass(value):
        return type(value), {item.name: parts(getattr(value, item.name)) for item in fields(value)}
    if isinstance(value, dict):
        return [(key, parts(part)) for key, part in value.items()]
    if isinstance(value, tuple):
        return tuple(parts(part) for part in value)
    return float(value).hex() if isinstance(value, float) else value


@pytest.mark.parametrize("name", names())
def test_what_is_kept_is_what_was_read(name):
    read = read_mechanism(file_of(name))
    text = read.description.text
    assert kept_reading(text, read.file) is None
    keep_reading(read)
    kept = kept_reading(text, read.file)
    assert kept.description.text == text
    assert kept.description.path == read.file
    assert parts(replace(kept, description=None)) == parts(replace(read, description=None))


def test_a_file_is_read_once_wherever_it_lies(own, fresh, tmp_path):
    load_record(own)
    load_record(own)
    copy = tmp_path / "other.toml"
    copy.write_text(own.read_text(encoding="utf-8"), encoding="utf-8")
    assert load_record(copy).file == copy
    assert len(fresh) == 1
    copy.write_text(copy.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    load_record(copy)
    assert len(fresh) == 2


def test_other_dimensions_come_from_the_file():
    load_record("fivebar")
    again = with_parameters(load_record("fivebar"), l2=210)
    assert parts(again.joints) == parts(with_parameters(read_mechanism(file_of("fivebar")), l2=210).joints)


@pytest.mark.parametrize("damage", ["digit", "short", "empty", "others", "not a record"])
def test_what_is_damaged_or_not_of_the_user_is_read_anew(cache, own, fresh, damage):
    load_record(own)
    (path,) = cache.iterdir()
    content = path.read_bytes()
    if damage == "digit":
        path.write_bytes(content.replace(b"0.", b"1.", 1))
    elif damage == "others":
        os.chmod(path, 0o666)  # noqa: PTH101
    else:
        path.write_bytes({"short": content[:-9], "empty": b"", "not a record": b"no digest\n{}"}[damage])
    load_record(own)
    assert len(fresh) == 2


def test_another_version_and_another_reader_read_anew(own, fresh, monkeypatch):
    load_record(own)
    monkeypatch.setattr(kept_readings, "VERSION", "another")
    load_record(own)
    monkeypatch.setattr(kept_readings, "_readers", lambda: "changed since")
    load_record(own)
    assert len(fresh) == 3


def test_a_file_with_faults_is_not_kept(cache, tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(file_of("fivebar").read_text(encoding="utf-8").replace("l1", "l0", 1), encoding="utf-8")
    with pytest.raises(Exception, match="fault"):
        load_record(path)
    assert not cache.exists()


def test_a_cache_that_cannot_be_written_is_no_fault(own, fresh, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "file"))
    load_record(own)
    load_record(own)
    assert len(fresh) == 2


def test_a_built_in_mechanism_is_one_object_and_a_file_of_ones_own_is_read_again(own):
    assert load_record("fivebar") is load_record("fivebar")
    assert load("fivebar") is load("fivebar")
    assert load("fivebar", l2=210).values.l2 != load("fivebar").values.l2
    assert load_record(own) is not load_record(own)


def test_it_is_of_the_kinds_that_the_cache_knows():
    assert KIND in KINDS
    assert Path(kept_readings.__file__).parent.name in kept_readings.READERS
