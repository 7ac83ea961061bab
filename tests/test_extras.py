"""Continuous integration leaves out nothing: with ASSUR_EXTRAS=required a run fails in which a test was skipped."""

from __future__ import annotations

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
MUTATES = "import pytest\n\n\n@pytest.mark.mutation\ndef test_three():\n    assert False\n"
OUTCOMES = [
    ("passes", (PASSES,), "required", 0),
    ("skips a test", (PASSES, SKIPS), "required", 1),
    ("skips a file", (PASSES, LACKS), "required", 1),
    ("skips a test at a desk", (PASSES, SKIPS, LACKS), "", 0),
    ("leaves out faults", (PASSES, MUTATES), "required", 0),
]


@pytest.mark.parametrize("together", [False, True], ids=["alone", "in workers"])
@pytest.mark.parametrize(("files", "extras", "code"), [row[1:] for row in OUTCOMES], ids=[row[0] for row in OUTCOMES])
def test_nothing_is_skipped_silently(tmp_path, files, extras, code, together):
    (tmp_path / "conftest.py").write_text(CONFTEST.format(path=str(Path(__file__).with_name("conftest.py"))))
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers =\n  mutation: a fault\n")
    for k, text in enumerate(files):
        (tmp_path / f"test_{k}.py").write_text(text)
    words = ["-q", "-p", "no:cacheprovider", *(["-n", "1"] if together else [])]
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", *words],
        cwd=tmp_path,
        env={**os.environ, "ASSUR_EXTRAS": extras},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == code, ran.stdout + ran.stderr
    assert ("SKIPPED, though" in ran.stdout) == bool(code)
