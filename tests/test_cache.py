import os

import pytest

from assur import cache
from assur.errors import UsageError


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    monkeypatch.delenv("ASSUR_CACHE_LIMIT", raising=False)
    return tmp_path


def put(name, size, age):
    path = cache.keep("loops", name, b"x" * size)
    os.utime(path, (1e9 - age, 1e9 - age))
    return path


def test_files_of_one_name_are_one_entry(folder):
    put("a.py", 100, 50)
    made = folder / "loops" / "__pycache__" / "a.loop.nbi"
    made.parent.mkdir()
    made.write_bytes(b"x" * 11)
    (entry,) = cache.kept()
    assert (entry.name, entry.size, len(entry.files)) == ("a", 111, 2)


def test_the_oldest_goes_first_and_what_is_new_stays(folder, monkeypatch):
    for name, age in (("old.py", 3), ("older.py", 7), ("young.py", 1)):
        put(name, 400_000, age)
    monkeypatch.setenv("ASSUR_CACHE_LIMIT", "1")
    cache.keep("loops", "new.py", b"x" * 500_000)
    assert [entry.name for entry in cache.kept()] == ["young", "new"]
    cache.keep("loops", "large.py", b"x" * 3_000_000)  # larger than all that may be kept: it is used now
    assert [entry.name for entry in cache.kept()] == ["large"]


def test_what_is_used_is_not_old(monkeypatch):
    first, _ = put("a.py", 10, 10), put("b.py", 10, 5)
    assert [entry.name for entry in cache.kept()] == ["a", "b"]
    cache.mark_used(first)
    assert [entry.name for entry in cache.kept()] == ["b", "a"]


def test_clearing_leaves_what_is_not_ours(folder):
    put("a.py", 10, 1)
    for other in ("thesis.tex", "pictures/a.png"):
        (folder / other).parent.mkdir(exist_ok=True)
        (folder / other).write_text("another's")
    (folder / "loops" / "link.py").symlink_to(folder / "thesis.tex")
    assert [entry.name for entry in cache.clear()] == ["a"]
    assert cache.kept() == ()
    assert (folder / "thesis.tex").is_file()
    assert (folder / "pictures" / "a.png").is_file()


@pytest.mark.parametrize("text", ["", "-1", "1.5", "many", "\u0665"])
def test_a_limit_is_a_whole_number_of_megabytes(monkeypatch, text):
    monkeypatch.setenv("ASSUR_CACHE_LIMIT", text)
    with pytest.raises(UsageError, match="ASSUR_CACHE_LIMIT"):
        cache.limit()
