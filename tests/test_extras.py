"""Continuous integration leaves out nothing: with ASSUR_EXTRAS=required a run fails in which a test was skipped."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CONFTEST = """
import importlib.util
spec = importlib.util.spec_from_file_location("shared", {path!r})
shared = importlib.util.module_from_spec(spec)
spec.loader.exec_module(shared)
shared.MISSING.clear()  # what this machine lacks is another matter
globals().update({{name: value for name, value in vars(shared).items() if name.startswith("pytest_")}})
"""
PASSES = "def test_one():\n    assert True\n"
SKIPS = "import pytest\n\n\ndef test_two():\n    pytest.skip('no registry')\n"
LACKS = "import pytest\n\npytest.importorskip('no_such_package')\n"
DIGS = "import pytest\n\n\n@pytest.mark.deep\ndef test_four():\n    assert False\n"
DRAWS = """
import sys
sys.path.insert(0, {helpers!r})
from examples import examples
from hypothesis import given
from hypothesis import strategies as st

SEEN = []


@examples(8)
@given(st.integers())
def test_five(n):
    SEEN.append(n)


def test_six():
    print("drew", len(SEEN))


@given(st.integers())
def test_seven(n):
    assert n < 1000
""".format(helpers=str(Path(__file__).parent / "helpers"))
MUTATES = "import pytest\n\n\n@pytest.mark.mutation\ndef test_three():\n    assert False\n"
OUTCOMES = [
    ("passes", (PASSES,), "required", 0),
    ("skips a test", (PASSES, SKIPS), "required", 1),
    ("skips a file", (PASSES, LACKS), "required", 1),
    ("skips a test at a desk", (PASSES, SKIPS, LACKS), "", 0),
]


def lay(folder, files):
    (folder / "conftest.py").write_text(CONFTEST.format(path=str(Path(__file__).with_name("conftest.py"))))
    (folder / "pytest.ini").write_text("[pytest]\nmarkers =\n  mutation: a fault\n  deep: a long walk\n")
    for k, text in enumerate(files):
        (folder / f"test_{k}.py").write_text(text)


def run(folder, *words, extras=""):
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *words],
        cwd=folder,
        env={**os.environ, "ASSUR_EXTRAS": extras},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize(
    ("files", "extras", "code", "together"),
    [pytest.param(*row, False, id=name) for name, *row in OUTCOMES]
    + [pytest.param((PASSES, SKIPS), "required", 1, True, id="skips a test, in workers")],
)
def test_nothing_is_skipped_silently(tmp_path, files, extras, code, together):
    lay(tmp_path, files)
    words = ["-n", "1"] if together else []
    ran = run(tmp_path, *words, extras=extras)
    assert ran.returncode == code, ran.stdout + ran.stderr
    assert ("SKIPPED, though" in ran.stdout) == bool(code)


@pytest.mark.parametrize("words", [(), ("-n", "2")], ids=["alone", "in workers"])
def test_what_was_left_out_is_counted_and_the_slowest_files_are_named(tmp_path, words):
    lay(tmp_path, [DIGS, DIGS.replace("four", "five"), MUTATES, *[PASSES] * 11])
    ran = run(tmp_path, *words, extras="required")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "NOT RUN: 1 tests marked mutation; they run with make mutations" in ran.stdout
    assert "NOT RUN: 2 tests marked deep; they run with make test-deep" in ran.stdout
    assert "the 10 slowest of 11 files" in ran.stdout
    assert ran.stdout.count(" s  test_") == 10


def test_deep_tests_run_where_the_expression_names_them(tmp_path):
    lay(tmp_path, [PASSES, DIGS])
    ran = run(tmp_path, "-m", "deep or hypothesis", "--hypothesis-profile=deep")
    assert "1 failed, 1 deselected" in ran.stdout
    assert "NOT RUN" not in ran.stdout.replace("NOT RUN: the tests", "")


@pytest.mark.parametrize(("profile", "drawn"), [("quick", 4), ("deep", 160)])
def test_the_profile_says_how_many_examples_are_drawn_and_a_failure_how_to_replay_it(tmp_path, profile, drawn):
    lay(tmp_path, [DRAWS])
    ran = run(tmp_path, "-s", f"--hypothesis-profile={profile}", "--hypothesis-seed=1")
    assert f"drew {drawn}\n" in ran.stdout
    assert "@reproduce_failure(" in ran.stdout
