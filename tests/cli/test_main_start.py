"""`import assur` is light, and what it names is found where it lives."""

import os
import subprocess
import sys

import pytest

import assur
import assur.errors
import assur.mechanism
from assur.derivation import derivation


@pytest.mark.parametrize("name", assur.__all__)
def test_public_names_are_found_and_offered(name):
    home = assur.errors if name.endswith("Error") else assur.mechanism
    home = derivation if name == "derive" else home
    assert getattr(assur, name) is getattr(home, name)
    assert name in dir(assur)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'assur' has no attribute 'laod'"):
        assur.laod  # noqa: B018


def test_import_alone_loads_no_numpy():
    code = "import sys, assur; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60, check=False).returncode == 0


@pytest.mark.parametrize(("own", "threads"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_a_command_uses_one_thread_for_small_matrices_unless_told(own, threads):
    """It is said before NumPy is there, which reads it when it is loaded."""
    code = """
import os, sys
from assur.cli.main import main
early = "numpy" not in sys.modules
sys.argv = ["assur", "--version"]
main()
print(early, os.environ["OPENBLAS_NUM_THREADS"])
"""
    given = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"} | own
    answer = subprocess.run(
        [sys.executable, "-c", code], env=given, capture_output=True, text=True, timeout=60, check=True
    )
    assert answer.stdout.splitlines()[-1] == f"True {threads}"
