"""Faults put into a copy of the source on purpose: each is noticed by the test that is named for it.

The list is tests/mutations.toml. That it fits the source is tested always; that every fault is noticed takes minutes,
so it is asked for: `make mutations`.
"""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ROOT = TESTS.parent
MUTATIONS = tomllib.loads((TESTS / "mutations.toml").read_text(encoding="utf-8"))["mutation"]
NAMES = [item["name"] for item in MUTATIONS]
PLACES = ("numerics/intervals", "kinematics/certified", "certificates", "verifier", "workspace/certified", "solver")
FAILED = 1
"""Exit code of pytest, and of node, where tests ran and failed; others say that none ran."""


def in_node(test):
    return re.fullmatch(r"(\S+\.js): (.+)", test)


@dataclass(frozen=True)
class Copy:
    """A copy of what is tested, in a folder of its own; the tests are those of this checkout."""

    folder: Path

    def run(self, *tests):
        """The exit code of tests against the copy, and what they said."""
        if found := in_node(tests[0]):
            command = ["node", "--test", "--test-name-pattern", re.escape(found[2]), f"test/{found[1]}"]
            return self._ran(command, self.folder / "web")
        cache = self.folder / "cache"
        shutil.rmtree(cache, ignore_errors=True)
        ids = [str(TESTS / test) for test in tests]
        words = ["-q", "-x", "-p", "no:cacheprovider", "--no-header", *ids]
        return self._ran(
            [sys.executable, "-m", "pytest", *words], ROOT, PYTHONPATH=self.folder / "src", ASSUR_CACHE=cache
        )

    def _ran(self, command, folder, **extra):
        known = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **{name: str(value) for name, value in extra.items()}}
        known.pop("ASSUR_EXTRAS", None)
        ran = subprocess.run(command, cwd=folder, env=known, capture_output=True, text=True, timeout=1500, check=False)
        return ran.returncode, ran.stdout[-3000:] + ran.stderr[-1000:]


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """The source as it is."""
    folder = tmp_path_factory.mktemp("copy")
    without = shutil.ignore_patterns("__pycache__", "node_modules")
    shutil.copytree(ROOT / "src" / "assur", folder / "src" / "assur", ignore=without)
    shutil.copytree(ROOT / "web", folder / "web", ignore=without)
    return Copy(folder)


@pytest.fixture
def mutated(copy, request):
    """The copy with one fault in it."""
    item = request.param
    path = copy.folder / item["file"]
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(item["old"], item["new"]), encoding="utf-8")
    later = path.stat().st_mtime + 10 * (1 + MUTATIONS.index(item))  # so that no compiled file is taken for it
    os.utime(path, (later, later))
    yield copy
    path.write_text(text, encoding="utf-8")


# ---- the list ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("item", MUTATIONS, ids=NAMES)
def test_an_entry_fits_the_source(item):
    """Its text stands there once, what becomes of it differs, and its test is there."""
    assert set(item) == {"name", "file", "old", "new", "test"}
    assert (ROOT / item["file"]).read_text(encoding="utf-8").count(item["old"]) == 1
    assert item["new"] != item["old"]
    if found := in_node(item["test"]):
        assert found[2] in (ROOT / "web" / "test" / found[1]).read_text(encoding="utf-8")
    else:
        path, name = item["test"].split("[")[0].split("::")
        assert f"def {name}(" in (TESTS / path).read_text(encoding="utf-8")


def test_every_place_has_its_faults():
    assert len(NAMES) == len(set(NAMES)) >= 30
    for place in PLACES:
        assert sum(f"/{place}/" in item["file"] for item in MUTATIONS) >= 5, place


# ---- and what comes of it ----------------------------------------------------------------------------------


@pytest.mark.mutation
@pytest.mark.node
def test_without_a_fault_every_named_test_passes(copy):
    here = sorted({item["test"].split("[")[0] for item in MUTATIONS if not in_node(item["test"])})
    code, said = copy.run(*here)
    assert code == 0, said
    for test in sorted({item["test"] for item in MUTATIONS if in_node(item["test"])}):
        code, said = copy.run(test)
        assert code == 0, said
        assert not re.search(r"^# pass 0$|^ℹ pass 0$", said, re.MULTILINE), test


@pytest.mark.mutation
@pytest.mark.node
@pytest.mark.parametrize("mutated", MUTATIONS, ids=NAMES, indirect=True)
def test_a_fault_is_noticed_by_its_test(mutated, request):
    item = MUTATIONS[NAMES.index(request.node.callspec.id)]
    code, said = mutated.run(item["test"])
    assert code == FAILED, said
