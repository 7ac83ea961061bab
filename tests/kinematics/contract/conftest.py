"""Copies of closed forms, right and wrong ones, each in a folder of its own and with an empty cache."""

import shutil
from pathlib import Path

import pytest

from assur.model.registry import CLOSED_FORM, load_record

BUILT_IN = Path(load_record("fivebar").file).parents[1]
OWN = Path(__file__).parent


@pytest.fixture(autouse=True)
def _own_cache(tmp_path_factory, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path_factory.mktemp("cache")))


@pytest.fixture
def copied(tmp_path):
    """The folder of a mechanism, built in or of these tests, copied; `changes` are texts to exchange in its kernels."""

    def result(name, *changes):
        source = OWN / name if (OWN / name).is_dir() else BUILT_IN / name
        folder = tmp_path / name
        shutil.copytree(source, folder, ignore=shutil.ignore_patterns("__pycache__"))
        path = folder / CLOSED_FORM
        text = path.read_text(encoding="utf-8")
        for before, after in changes:
            assert text.count(before) >= 1, before
            text = text.replace(before, after)
        path.write_text(text, encoding="utf-8")
        return folder

    return result
