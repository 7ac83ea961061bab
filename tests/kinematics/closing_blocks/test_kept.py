"""Signs are found once for each file; what is damaged is found again."""

import re

import numpy as np
import pytest

from assur.cache import cache_folder
from assur.kinematics.closing_blocks import kept
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
from assur.model.registry import load_record


@pytest.fixture
def record(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    kept.kept_signs.cache_clear()
    yield load_record("gough_stewart")
    kept.kept_signs.cache_clear()


def signs(record, listed):
    screws = ScrewColumns(record, assemblies_by_chance(record)[:20])
    return np.array([sign.signs(screws) for sign in listed])


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_what_is_kept_is_what_was_found(record, problem, monkeypatch):
    expected = signs(record, distinguishing_signs(record, problem))
    assert np.array_equal(signs(record, kept.kept_signs(record, problem)), expected)
    kept.kept_signs.cache_clear()
    monkeypatch.setattr(kept, "distinguishing_signs", lambda *_: pytest.fail("found again"))
    assert np.array_equal(signs(record, kept.kept_signs(record, problem)), expected)


@pytest.mark.parametrize("damage", [lambda data: data[:-2], lambda data: data.replace(b"1", b"2"), lambda _: b""])
def test_what_is_damaged_is_found_again(record, damage):
    expected = signs(record, kept.kept_signs(record, "inverse"))
    (path,) = (cache_folder() / kept.KIND).iterdir()
    path.write_bytes(damage(path.read_bytes()))
    kept.kept_signs.cache_clear()
    assert np.array_equal(signs(record, kept.kept_signs(record, "inverse")), expected)


def test_what_a_mechanism_is_called_decides_no_sign(record, tmp_path, monkeypatch):
    path = tmp_path / "own.toml"
    text = re.sub(r"(?m)^(name|title)(\s*)=.*$", r'\1\2= "own"', record.description.text, count=2)
    path.write_text(text, encoding="utf-8")
    own = load_record(path)
    assert (own.name, own.title) == ("own", "own")
    expected = signs(record, kept.kept_signs(record, "inverse"))
    monkeypatch.setattr(kept, "distinguishing_signs", lambda *_: pytest.fail("found again"))
    assert np.array_equal(signs(own, kept.kept_signs(own, "inverse")), expected)
